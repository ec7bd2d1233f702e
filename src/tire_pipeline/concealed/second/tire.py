"""A tire's physical constants, and passenger-car tires drawn at random."""

from typing import NamedTuple

import numpy as np


class Tire(NamedTuple):
    """Constants of one tire, SI; the defaults are a 205/55 R16 in the middle of what is drawn.

    Stiffness of the tread is shear modulus over depth of tread; of the carcass: one number a mode.
    What stands below `# what a cause changes` is neutral in a tire that nothing was done to.
    """

    radius: float = 0.317  # m
    width: float = 0.155  # m, of the contact
    nominal_load: float = 4000.0  # N
    nominal_pressure: float = 2.3e5  # Pa
    nominal_speed: float = 18.0  # m/s
    vertical_stiffness: float = 2.2e5  # N/m at nominal pressure
    contact_share: float = 0.60  # half length of contact over that of the undeflected circle's chord
    pressure_exponent: float = 4.0  # how full the pressure along the contact is: 2 is a parabola
    pressure_forward: float = 0.12  # shift of pressure to the front, from rolling
    shoulder_shift: float = 0.08  # share of load that leaves the shoulders per doubled inflation pressure
    camber_shift: float = 0.9  # share of load that moves to a shoulder per radian of camber
    camber_bending: float = 0.5  # part of the camber's curvature that the belt takes away
    shear_modulus: float = 0.95e6  # Pa
    tread_depth: float = 0.0085  # m
    friction_peak: float = 1.14  # of the master curve
    friction_floor: float = 0.66  # of the master curve, over its peak
    friction_speed: float = 0.18  # m/s, where the master curve peaks at `friction_temperature`
    friction_width: float = 0.36  # of the master curve, per decade
    friction_temperature: float = 45.0  # degC
    glass_shift: float = -10.0  # degC, the reference temperature of Williams, Landel and Ferry
    friction_pressure: float = 0.26  # power with which friction falls over pressure
    lateral_stiffness: float = 1.75e5  # N/m, carcass to the side
    longitudinal_stiffness: float = 4.2e5  # N/m
    yaw_stiffness: float = 7.0e3  # N m/rad
    bending_stiffness: float = 1.5e6  # N/m, of the parabolic mode
    carcass_time: float = 0.004  # s, damping over stiffness of the carcass
    carcass_pressure: float = 0.55  # part of the carcass stiffness that inflation gives
    ply_steer: float = 0.002  # rad
    conicity: float = 0.002  # rad, slope of the crown over the width
    tread_capacity: float = 9.0e3  # J/K
    carcass_capacity: float = 7.0e3  # J/K
    skin_capacity: float = 160.0  # J/m2/K, of the skin that the flash temperature heats
    # what a cause changes
    friction_scale: float = 1.0
    tread_scale: float = 1.0
    carcass_scale: float = 1.0
    lag: float = 0.0  # 1: the carcass's own relaxation; 0: the limit of a sweep without end
    temperature_gain: float = 0.0  # 1: bulk temperature acts on friction and modulus as it does
    speed_gain: float = 0.0  # 1: the sliding speed is that of the travelling speed; 0: of nominal speed
    load_gain: float = 0.0  # added to `friction_pressure`
    wear_rate: float = 0.0  # m per J/m2 of friction work
    drum_curvature: float = 0.0  # 1/m; 0 is a flat belt
    bushing: float = 0.0  # rad, half width of the slip angle's hysteresis
    vibration: float = 0.0  # m, amplitude of the hub in stick-slip
    vibration_rate: float = 130.0  # rad/s


def draw_tire(rng: np.random.Generator) -> Tire:
    """A passenger-car tire around the defaults: sizes 10%, stiffness and friction 12 to 20% either way.

    Parameters
    ----------
    rng
        Source of the draw; the same state gives the same tire.
    """
    middle = Tire()

    def spread(name: str, part: float) -> float:
        return float(getattr(middle, name) * np.exp(part * rng.uniform(-1.0, 1.0)))

    return middle._replace(
        radius=spread("radius", 0.06),
        width=spread("width", 0.12),
        nominal_load=float(rng.choice([3500.0, 4000.0, 4500.0, 5000.0])),
        nominal_speed=float(rng.uniform(15.0, 22.0)),
        vertical_stiffness=spread("vertical_stiffness", 0.12),
        contact_share=spread("contact_share", 0.05),
        pressure_exponent=float(rng.uniform(3.0, 6.0)),
        pressure_forward=float(rng.uniform(0.0, 0.2)),
        shear_modulus=spread("shear_modulus", 0.20),
        friction_peak=spread("friction_peak", 0.08),
        friction_floor=spread("friction_floor", 0.08),
        friction_speed=spread("friction_speed", 0.5),
        friction_width=spread("friction_width", 0.15),
        friction_temperature=float(rng.uniform(38.0, 55.0)),
        friction_pressure=float(rng.uniform(0.18, 0.33)),
        lateral_stiffness=spread("lateral_stiffness", 0.15),
        longitudinal_stiffness=spread("longitudinal_stiffness", 0.15),
        yaw_stiffness=spread("yaw_stiffness", 0.20),
        bending_stiffness=spread("bending_stiffness", 0.20),
        ply_steer=float(rng.normal(0.0, 0.002)),
        conicity=float(rng.normal(0.0, 0.002)),
        vibration_rate=float(2.0 * np.pi * rng.uniform(14.0, 24.0)),
    )
