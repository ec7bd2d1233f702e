"""Four ways to turn a tire table into features and back: fit, encode, decode."""

from tire_pipeline.representations.base import (
    CURVE_LOADS,
    CURVE_SLIP_ANGLES,
    REPRESENTATIONS,
    Representation,
    make_representation,
    representation_from_state,
)

__all__ = [
    "CURVE_LOADS",
    "CURVE_SLIP_ANGLES",
    "REPRESENTATIONS",
    "Representation",
    "make_representation",
    "representation_from_state",
]
