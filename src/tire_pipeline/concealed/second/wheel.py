"""Causes in the tire and in what the wheel does: each function puts a size into place."""

import numpy as np

from tire_pipeline.concealed.second.draws import Draw
from tire_pipeline.concealed.second.roll import Course
from tire_pipeline.concealed.second.tire import Tire


def _along(size: float, draw: Draw) -> np.ndarray | float:
    """The size all along with its sign, or after the sections' levels, (n,)."""
    return draw.sign * size * (1.0 if draw.constant else draw.levels)


def inflate(course: Course, size: float, draw: Draw) -> Course:
    """Inflation pressure off by a part of it."""
    return course._replace(pressure=course.pressure * (1.0 + _along(size, draw)))


def lean(course: Course, size: float, draw: Draw) -> Course:
    """Camber off by an angle in rad."""
    return course._replace(camber=course.camber + _along(size, draw))


def turn(course: Course, size: float, draw: Draw) -> Course:
    """Path curvature in 1/m."""
    return course._replace(turn_slip=course.turn_slip + _along(size, draw))


def resurface(course: Course, size: float, draw: Draw) -> Course:
    """Friction of the surface off by a part of it."""
    return course._replace(surface=course.surface * (1.0 + _along(size, draw)))


def turn_encoder(course: Course, size: float, draw: Draw) -> Course:
    """The true slip angle is less than the recorded one by an angle in rad."""
    return course._replace(slip_angle=course.slip_angle - draw.sign * size)


def heat(tire: Tire, size: float, draw: Draw) -> Tire:
    """Temperature acts; 1 is what the cited papers have."""
    return tire._replace(temperature_gain=size)


def wear(tire: Tire, size: float, draw: Draw) -> Tire:
    """Depth lost a friction work per area, m per J/m2."""
    return tire._replace(wear_rate=size)


def relax(tire: Tire, size: float, draw: Draw) -> Tire:
    """Way that the carcass needs, over its own."""
    return tire._replace(lag=size)


def hasten(tire: Tire, size: float, draw: Draw) -> Tire:
    """Travelling speed's share in the speed at which friction is evaluated; 1 is all of it."""
    return tire._replace(speed_gain=size)


def press(tire: Tire, size: float, draw: Draw) -> Tire:
    """Power of friction over contact pressure, added."""
    return tire._replace(load_gain=draw.sign * size)


def stiffen_tread(tire: Tire, size: float, draw: Draw) -> Tire:
    """Shear modulus off by a part of it."""
    return tire._replace(tread_scale=1.0 + draw.sign * size)


def stiffen_carcass(tire: Tire, size: float, draw: Draw) -> Tire:
    """All modes of the carcass stiffer or softer, by the same factor up or down."""
    return tire._replace(carcass_scale=float((1.0 - size) ** -draw.sign))


def loosen(tire: Tire, size: float, draw: Draw) -> Tire:
    """Half width of the hysteresis in rad."""
    return tire._replace(bushing=draw.sign * size)


def roll_on_drum(tire: Tire, size: float, draw: Draw) -> Tire:
    """Curvature of the drum in 1/m."""
    return tire._replace(drum_curvature=size)


def vibrate(tire: Tire, size: float, draw: Draw) -> Tire:
    """Amplitude of the hub in m."""
    return tire._replace(vibration=size)
