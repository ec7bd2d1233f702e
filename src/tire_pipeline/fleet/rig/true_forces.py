"""The true tire: a brush model with load saturation, sliding speed and temperature; no Magic Formula.

Bristles on a carcass, with a pressure distribution between uniform and parabolic (Pacejka, *Tire and
Vehicle Dynamics*, chapter 3, with the exponent 3 of the parabolic case left free). Friction falls with
sliding speed, with load and with distance from the compound's best temperature.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

REFERENCE_TEMPERATURE = 60.0


@dataclass(frozen=True)
class Contact:
    """What a tire meets in one case of a sweep; arrays of shape (n, cases) or broadcastable.

    Attributes
    ----------
    normal_load : ndarray
        N.
    camber : ndarray
        rad.
    pressure : ndarray
        Inflation pressure over the nominal one.
    wear : ndarray
        0 new to 1 worn.
    adhesion, hysteresis : ndarray
        The surface's factors on the two kinds of friction.
    curvature : ndarray
        Tire radius over drum radius; 0 for a flat surface.
    conditioning : ndarray
        0 fresh from the mould to 1 fully run in.
    """

    normal_load: np.ndarray
    camber: np.ndarray
    pressure: np.ndarray
    wear: np.ndarray
    adhesion: np.ndarray
    hysteresis: np.ndarray
    curvature: np.ndarray
    conditioning: np.ndarray


@dataclass(frozen=True)
class TrueTires:
    """Parameters of n tires in a given contact, all that does not change during a sweep.

    Attributes are arrays of shape (n, cases); see :func:`in_contact`.
    """

    tires: dict[str, np.ndarray]
    normal_load: np.ndarray
    camber: np.ndarray
    friction_y: np.ndarray
    friction_x: np.ndarray
    cornering_stiffness: np.ndarray
    slip_stiffness: np.ndarray
    slip_shift: np.ndarray
    force_shift: np.ndarray
    half_length: np.ndarray
    relaxation_length: np.ndarray
    residual_torque: np.ndarray


def in_contact(tires: pd.DataFrame, contact: Contact) -> TrueTires:
    """Work out stiffness, friction and contact length of each tire in each case.

    Parameters
    ----------
    tires : pandas.DataFrame
        n rows of :func:`.tire_population.draw_tires`.
    contact : Contact
        Arrays that broadcast to (n, cases).

    Returns
    -------
    TrueTires
    """
    t = {
        name: tires[name].to_numpy(dtype=float)[:, None]
        for name in tires.columns
        if name not in ("compound", "role")
    }
    load, camber = contact.normal_load, contact.camber
    x = load / (t["stiffness_peak"] * t["rated_load"] * contact.pressure**0.5)
    q = t["stiffness_shape"]
    stiffness = t["stiffness"] * t["rated_load"] * contact.pressure**-0.10
    stiffness = stiffness * x * np.exp((1.0 - x**q) / q)
    stiffness = stiffness * (1.0 + 0.14 * contact.wear) * (1.06 - 0.06 * contact.conditioning)
    stiffness = stiffness * (1.0 + contact.curvature) ** (-0.45 * t["carcass_softness"])
    share = t["hysteresis_share"]
    surface = (1.0 - share) * contact.adhesion + share * contact.hysteresis
    friction = t["friction"] * (load / (0.6 * t["rated_load"])) ** -t["friction_load"] * surface
    friction = friction * contact.pressure**-0.06 * (1.0 - 0.04 * contact.wear)
    friction = friction * (0.97 + 0.03 * contact.conditioning)
    length = t["contact_length"] * t["UNLOADED_RADIUS"] * 0.55
    length = length * np.sqrt(load / t["rated_load"]) * contact.pressure**-0.4
    length = length * (1.0 + contact.curvature) ** -0.5
    slip_stiffness = (
        t["slip_stiffness"] * load * np.exp(-t["slip_stiffness_load"] * (load / t["rated_load"] - 0.6))
    )
    return TrueTires(
        tires=t,
        normal_load=load,
        camber=camber,
        friction_y=friction * (1.0 - t["camber_friction"] * camber**2),
        friction_x=friction * t["friction_x_ratio"] * (1.0 - 2.0 * camber**2),
        cornering_stiffness=stiffness * (1.0 - t["camber_stiffness"] * np.abs(camber)),
        slip_stiffness=slip_stiffness * (1.0 + contact.curvature) ** -0.3,
        slip_shift=t["ply_steer"] * (1.0 + t["ply_steer_load"] * (x - 0.6))
        + t["camber_thrust"] * camber * (1.3 - 0.3 * x),
        force_shift=t["conicity"] * load * (0.6 * t["rated_load"] / load) ** t["conicity_load"],
        half_length=length,
        relaxation_length=stiffness / t["carcass_stiffness"] * contact.pressure**-0.3,
        residual_torque=t["residual_torque"] * load * t["UNLOADED_RADIUS"],
    )


def _temperature_factors(true: TrueTires, temperature: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Factors on friction and on stiffness; both 1 at the mean tire's reference."""
    t = true.tires
    bell = -(((temperature - t["best_temperature"]) / t["temperature_width"]) ** 2)
    softer = -t["stiffness_loss"] * (temperature - REFERENCE_TEMPERATURE)
    return np.exp(bell), np.exp(softer)


def lateral(
    true: TrueTires, slip_angle: np.ndarray, speed: np.ndarray | float, temperature: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Lateral force and aligning torque (ISO W: positive slip angle gives negative force).

    Parameters
    ----------
    true : TrueTires
    slip_angle : ndarray, shape (n, cases)
        rad.
    speed : float or ndarray
        m/s.
    temperature : ndarray, shape (n, cases)
        Tread temperature, degC.

    Returns
    -------
    fy, mz : ndarray, shape (n, cases)
        N, N m.
    """
    hot_friction, hot_stiffness = _temperature_factors(true, temperature)
    slip = np.tan(slip_angle + true.slip_shift)
    sliding = np.abs(slip) * speed / (np.abs(slip) * speed + 3.0 * true.tires["slide_speed"])
    friction = true.friction_y * hot_friction * (1.0 - true.tires["friction_drop"] * sliding)
    limit = friction * true.normal_load
    power = true.tires["pressure_shape"]
    adhering = true.cornering_stiffness * hot_stiffness * np.abs(slip) / (power * limit)
    left = np.maximum(1.0 - adhering, 0.0)
    size = limit * (1.0 - left**power)
    fy = -np.sign(slip) * size + true.force_shift
    trail = true.half_length * left**3 / (1.0 - 0.6 * (1.0 - left))
    torque = (
        true.residual_torque * (true.tires["conicity"] * 20.0 + 4.0 * true.camber) / (1.0 + (8.0 * slip) ** 2)
    )
    return fy, trail * np.sign(slip) * size + torque


def longitudinal(
    true: TrueTires, slip_ratio: np.ndarray, speed: np.ndarray | float, temperature: np.ndarray
) -> np.ndarray:
    """Longitudinal force at zero slip angle.

    Parameters
    ----------
    true : TrueTires
    slip_ratio : ndarray, shape (n, cases)
        Negative when braking.
    speed : float or ndarray
        m/s.
    temperature : ndarray, shape (n, cases)
        Tread temperature, degC.

    Returns
    -------
    fx : ndarray, shape (n, cases)
        N.
    """
    hot_friction, hot_stiffness = _temperature_factors(true, temperature)
    slip = slip_ratio / (1.0 + np.maximum(slip_ratio, -0.6) * 0.5)
    sliding = np.abs(slip) * speed / (np.abs(slip) * speed + 3.0 * true.tires["slide_speed"])
    friction = true.friction_x * hot_friction * (1.0 - true.tires["friction_drop"] * sliding)
    limit = friction * true.normal_load
    power = true.tires["pressure_shape_x"]
    adhering = true.slip_stiffness * hot_stiffness * np.abs(slip) / (power * limit)
    return np.sign(slip) * limit * (1.0 - np.maximum(1.0 - adhering, 0.0) ** power)
