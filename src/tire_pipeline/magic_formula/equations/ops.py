"""The few mathematical operations that the equations are written in.

The interpreter (and so the NumPy form) takes them from NumPy, on arrays. Compiled code takes the scalar
forms of :mod:`tire_pipeline.magic_formula.compiled.fast_math`.
"""

from __future__ import annotations

import numpy as np

TWO_OVER_PI = 0.6366197723675814

HUGE = 1e150
"""Bound for slopes times slips that may overflow: arctan of it is pi/2 to the last bit."""


def sin(x):
    """Return the sine."""
    return np.sin(x)


def cos(x):
    """Return the cosine."""
    return np.cos(x)


def arctan(x):
    """Return the arctangent."""
    return np.arctan(x)


def exp(x):
    """Return e to the power of x."""
    return np.exp(x)


def log(x):
    """Return the natural logarithm."""
    return np.log(x)


def sqrt(x):
    """Return the square root."""
    return np.sqrt(x)


def power(base, exponent):
    """Return ``base ** exponent`` for a base that is not negative."""
    return np.power(base, exponent)


def select(condition, yes, no):
    """Return ``yes`` where the condition holds, else ``no``."""
    return np.where(condition, yes, no)


def minimum(x, y):
    """Return the smaller of two numbers."""
    return np.minimum(x, y)


def maximum(x, y):
    """Return the larger of two numbers."""
    return np.maximum(x, y)


def absolute(x):
    """Return the magnitude."""
    return np.abs(x)
