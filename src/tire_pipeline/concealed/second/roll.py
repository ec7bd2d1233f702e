"""The tire rolled over a course in time: bristles, carcass, heat and wear, step by step."""

from typing import NamedTuple

import numpy as np
from numba import njit

from tire_pipeline.concealed.second import places as at
from tire_pipeline.concealed.second.bristles import sweep_strip
from tire_pipeline.concealed.second.carcass import BEND, LENGTH, MODES, SIDE, YAW, bend, stiffnesses
from tire_pipeline.concealed.second.contact import (
    ELEMENTS,
    STRIPS,
    half_length,
    pressure_profile,
    strip_shares,
)
from tire_pipeline.concealed.second.friction import modulus_factor, pressure_factor
from tire_pipeline.concealed.second.hub import loosen, shake
from tire_pipeline.concealed.second.thermal import depth_left, warm
from tire_pipeline.concealed.second.tire import Tire

SUBSTEPS = 5
FORCES = ("fx", "fy", "mz")


class Course(NamedTuple):
    """What the wheel is made to do, one row a sample, (n,) each: SI, ISO W axes."""

    time: np.ndarray  # s
    slip_angle: np.ndarray  # rad
    slip_ratio: np.ndarray
    camber: np.ndarray  # rad
    normal_load: np.ndarray  # N
    speed: np.ndarray  # m/s
    pressure: np.ndarray  # Pa
    turn_slip: np.ndarray  # 1/m
    surface: np.ndarray  # factor on friction


class Rolled(NamedTuple):
    """What came of it, (n,) each."""

    fx: np.ndarray  # N
    fy: np.ndarray  # N
    mz: np.ndarray  # N m
    tread_temperature: np.ndarray  # degC
    carcass_temperature: np.ndarray  # degC
    friction_power: np.ndarray  # W
    sliding_power: np.ndarray  # W, what the contact forces take from the wheel
    tread_depth: np.ndarray  # m


@njit(cache=True, error_model="numpy")
def _slip_over_length(
    out: np.ndarray, sideways: float, spin: float, rolling: float, shape: np.ndarray, half: float
) -> None:
    """Lateral slip speed along the contact, front to rear, into `out` (m/s).

    Belt speed to the side + spin x - V_r dw/dx of the carcass's yaw and parabola: Pacejka 2012, ch. 2.4, 3.3.
    """
    n = out.size
    for i in range(n):
        u = 1.0 - (2.0 * i + 1.0) / n
        slope = shape[YAW] + 2.0 * shape[BEND] * u / half
        out[i] = sideways + spin * u * half - rolling * slope


@njit(cache=True, error_model="numpy")
def _push(
    tire: np.ndarray,
    stress: np.ndarray,
    widths: np.ndarray,
    half: float,
    shape: np.ndarray,
    pushed: np.ndarray,
) -> float:
    """Contact forces on each mode, into `pushed` (4,), and the aligning moment, N m."""
    pushed[:] = 0.0
    moment = 0.0
    n = stress.shape[1]
    area = tire[at.WIDTH] / STRIPS * 2.0 * half / n
    for j in range(STRIPS):
        for i in range(n):
            u = 1.0 - (2.0 * i + 1.0) / n
            fx = -stress[j, i, 0] * area
            fy = -stress[j, i, 1] * area
            pushed[SIDE] += fy
            pushed[YAW] += fy * u * half
            pushed[BEND] += fy * (u * u - 1.0 / 3.0)
            pushed[LENGTH] += fx
            moment += fy * u * half - fx * (widths[j] + shape[SIDE])
    return moment


@njit(cache=True, error_model="numpy")
def _hold(stiffness: float, tire: np.ndarray, half: float, held: np.ndarray) -> None:
    """The tread's own stiffness in each mode, into `held`, (4,)."""
    whole = stiffness * tire[at.WIDTH] * 2.0 * half
    held[SIDE] = whole
    held[LENGTH] = whole
    held[YAW] = whole * half * half / 3.0
    held[BEND] = whole * 4.0 / 45.0


@njit(cache=True, error_model="numpy")
def _strips(
    tire: np.ndarray,
    states: tuple[np.ndarray, np.ndarray, np.ndarray],
    spread: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray],
    pressed: tuple[float, float],
    moved: tuple[float, float, float, float],
    rubber: tuple[float, float, float, float, float],
) -> float:
    """One step of all strips; friction power, W.

    `states`: stress, flash, room for the bound. `spread`: slip speed along the contact, places of the strips,
    shares of load, pressure profile. `pressed`: load over a strip's area, friction of the surface. `moved`:
    speed ahead, rolling speed, the carcass's, spin. `rubber`: stiffness, length, speed scale, temperature,
    time step.
    """
    stress, flash, bound = states
    slip_y, widths, shares, profile = spread
    ahead, rolling, carcass, spin = moved
    tread, length, speed_scale, bulk, step = rubber
    power = 0.0
    for j in range(STRIPS):
        pressure = shares[j] * pressed[0]
        factor = pressed[1] * pressure_factor(tire, pressure)
        for i in range(ELEMENTS):
            bound[i] = pressure * factor * profile[i]
        slip_x = ahead - rolling * (1.0 + tire[at.CONICITY] * widths[j] / tire[at.RADIUS])
        slip_x += carcass - spin * widths[j]
        lost = sweep_strip(
            tire, stress[j], flash[j], slip_x, slip_y, bound, tread, rolling, length, speed_scale, bulk, step
        )
        power += lost * tire[at.WIDTH] / STRIPS
    return power


@njit(cache=True, error_model="numpy")
def _roll(tire: np.ndarray, course: Course, start: np.ndarray, out: np.ndarray, steps: int) -> None:
    """The loop over samples and the steps within; `out` is (8, n)."""
    n = course.time.size
    stress = np.zeros((STRIPS, ELEMENTS, 2))
    flash = np.zeros((STRIPS, ELEMENTS))
    modes, rates, pushed = np.zeros(MODES), np.zeros(MODES), np.zeros(MODES)
    stiffness, held, heat = np.zeros(MODES), np.zeros(MODES), start.copy()
    shares, profile = np.zeros(STRIPS), np.zeros(ELEMENTS)
    bound, slip_y = np.zeros(ELEMENTS), np.zeros(ELEMENTS)
    widths = np.array([-1.0, 0.0, 1.0]) * tire[at.WIDTH] / STRIPS
    hub = np.zeros(3)
    pressure_profile(tire, profile)
    depth, work, moment, power, taken = tire[at.TREAD_DEPTH], 0.0, 0.0, 0.0, 0.0
    force_x, force_y = 0.0, 0.0
    for k in range(n):
        gap = course.time[k] - course.time[k - 1] if k else 0.01
        step = gap / steps
        before = max(k - 1, 0)
        speed = max(course.speed[k], 0.5)
        inflation = course.pressure[k]
        camber = course.camber[k]
        load = max(course.normal_load[k], 1.0)
        half = half_length(tire, load, inflation)
        strip_shares(tire, camber, inflation, shares)
        stiffnesses(tire, inflation, stiffness)
        tread = tire[at.TREAD_SCALE] * tire[at.SHEAR_MODULUS] / depth * modulus_factor(tire, heat[0])
        bulk = tire[at.FRICTION_TEMPERATURE] + tire[at.TEMPERATURE_GAIN] * (
            heat[0] - tire[at.FRICTION_TEMPERATURE]
        )
        speed_scale = (tire[at.NOMINAL_SPEED] / speed) ** (1.0 - tire[at.SPEED_GAIN])
        _hold(tread, tire, half, held)
        spin = speed * course.turn_slip[k] + speed / tire[at.RADIUS] * np.sin(camber) * (
            1.0 - tire[at.CAMBER_BENDING]
        )
        for sub in range(steps):
            part = (sub + 1.0) / steps
            angle = course.slip_angle[before] + part * (course.slip_angle[k] - course.slip_angle[before])
            ratio = course.slip_ratio[before] + part * (course.slip_ratio[k] - course.slip_ratio[before])
            angle += loosen(tire, hub, force_y, load)
            ahead = speed * np.cos(angle)
            rolling = max(ahead * (1.0 + ratio), 0.3)
            sideways = speed * np.sin(angle) + rolling * tire[at.PLY_STEER] + tire[at.LAG] * rates[SIDE]
            sideways += shake(tire, hub, force_y, load, step)
            _slip_over_length(slip_y, sideways, spin + tire[at.LAG] * rates[YAW], rolling, modes, half)
            power = _strips(
                tire,
                (stress, flash, bound),
                (slip_y, widths, shares, profile),
                (load / (tire[at.WIDTH] / STRIPS * 2.0 * half), course.surface[k]),
                (ahead, rolling, tire[at.LAG] * rates[LENGTH], spin),
                (tread, 2.0 * half, speed_scale, bulk, step),
            )
            moment = _push(tire, stress, widths, half, modes, pushed)
            force_x, force_y = pushed[LENGTH], pushed[SIDE]
            bend(tire, modes, rates, stiffness, pushed, held, step)
            warm(tire, heat, power, load, speed, step)
            work += step * power / (2.0 * np.pi * tire[at.RADIUS] * tire[at.WIDTH])
            taken = -(force_x * (ahead - rolling) + force_y * (speed * np.sin(angle)) + moment * spin)
        depth = depth_left(tire, work)
        out[0, k] = force_x
        out[1, k] = force_y + hub[2]
        out[2, k] = moment
        out[3, k], out[4, k] = heat[0], heat[1]
        out[5, k], out[6, k], out[7, k] = power, taken, depth


def warm_state(tire: Tire, above: float = 0.0) -> np.ndarray:
    """Temperatures of tread and carcass to begin with, (2,) in degC: conditioned, and so much above it."""
    return np.array([tire.friction_temperature + above, tire.friction_temperature + 0.8 * above])


def roll(tire: Tire, course: Course, start: np.ndarray | None = None, steps: int = SUBSTEPS) -> Rolled:
    """Forces of a tire on a course.

    Parameters
    ----------
    tire, course
        A course of n samples.
    start
        Tread and carcass temperature at the first sample, (2,) in degC; the tire's own reference without it.
    steps
        Steps of time between two samples.
    """
    out = np.zeros((8, course.time.size))
    _roll(np.array(tire), course, warm_state(tire) if start is None else start, out, steps)
    return Rolled(*out)
