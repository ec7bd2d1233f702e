"""Scalar sine, cosine, arctangent and exponential that a compiler can turn into vector instructions.

The C library's functions cannot be called on a vector register, so a loop that calls them runs one point at
a time. These are branch-free polynomials (benchmarks/fit_fast_math.py finds them): to 2 units in the last
place for arctan and exp, and an absolute error of 2e-16 for sin and cos up to 1e5; beyond 1e9 sin and cos
stay bounded but mean nothing, so the callers send such points to NumPy. Importing this module teaches them
to numba.
"""

from __future__ import annotations

import numpy as np
from numba import njit, types
from numba.extending import intrinsic, overload

from tire_pipeline.magic_formula.equations import ops
from tire_pipeline.magic_formula.equations.jit import OPTIONS

_PI_1, _PI_2, _PI_3 = 3.1415926218032837, 3.178650942459171e-08, 1.2246467864107189e-16
_PI_4 = 1.2736634327021899e-24
_LN2_HIGH, _LN2_LOW = 0.6931471803691238, 1.9082149292705877e-10
_LOG2_E = 1.4426950408889634
_ROUND = 6755399441055744.0
"""1.5 * 2^52: adding it leaves the nearest integer in the low bits."""


@intrinsic
def _bits_of(typingctx, x):
    def codegen(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], context.get_value_type(types.int64))

    return types.int64(types.float64), codegen


@intrinsic
def _float_of(typingctx, x):
    def codegen(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], context.get_value_type(types.float64))

    return types.float64(types.int64), codegen


@njit(**OPTIONS)
def _sine_of_rest(x, j):
    """Return sin(x - j pi) for a whole number j that leaves at most pi / 2."""
    r = ((x - j * _PI_1) - j * _PI_2) - j * _PI_3 - j * _PI_4
    z = r * r
    s = 2.73144475909634e-15
    s = s * z - 7.643970296165793e-13
    s = s * z + 1.6058977312444268e-10
    s = s * z - 2.5052107616995878e-08
    s = s * z + 2.755731921916323e-06
    s = s * z - 0.00019841269841254974
    s = s * z + 0.008333333333333316
    s = s * z - 0.16666666666666666
    return r + r * (z * s)


@njit(**OPTIONS)
def _is_odd_sign(j):
    """Return -1 for an odd whole number j, 1 for an even one."""
    half = 0.5 * j
    return 1.0 - 4.0 * (half - np.floor(half))


@njit(**OPTIONS)
def _bounded(x):
    return min(max(x, -1.0), 1.0)


@overload(ops.sin, jit_options=OPTIONS)
def _sin(x):
    def implementation(x):
        j = np.rint(x * 0.3183098861837907)
        return _is_odd_sign(j) * _bounded(_sine_of_rest(x, j))

    return implementation


@overload(ops.cos, jit_options=OPTIONS)
def _cos(x):
    def implementation(x):
        # cos x = sin(x + pi / 2): reduce by odd multiples of pi / 2
        j = np.rint(x * 0.3183098861837907 - 0.5)
        h = j + 0.5
        return -_is_odd_sign(j) * _bounded(_sine_of_rest(x, h))

    return implementation


@overload(ops.arctan, jit_options=OPTIONS)
def _arctan(x):
    def implementation(x):
        a = abs(x)
        steep = a > 2.414213562373095
        middle = (a > 0.4142135623730950) & (not steep)
        above = -1.0 if steep else (a - 1.0 if middle else a)
        below = a if steep else (a + 1.0 if middle else 1.0)
        base = 1.5707963267948966 if steep else (0.7853981633974483 if middle else 0.0)
        low = 6.123233995736766e-17 if steep else (3.061616997868383e-17 if middle else 0.0)
        t = above / below
        z = t * t
        s = -0.019176885636589053
        s = s * z + 0.039231657085083686
        s = s * z - 0.050854496960392584
        s = s * z + 0.05858148904795124
        s = s * z - 0.0666451144646022
        s = s * z + 0.07692183190760651
        s = s * z - 0.09090904578121085
        s = s * z + 0.11111111015256292
        s = s * z - 0.14285714284666542
        s = s * z + 0.1999999999999552
        s = s * z - 0.3333333333333333
        value = base + ((t * (z * s) + low) + t)
        return np.copysign(value, x)

    return implementation


@overload(ops.exp, jit_options=OPTIONS)
def _exp(x):
    def implementation(x):
        # callers keep x within -700 and 100
        shifted = x * _LOG2_E + _ROUND
        n = shifted - _ROUND
        r = (x - n * _LN2_HIGH) - n * _LN2_LOW
        s = 2.091467938417506e-09
        s = s * r + 2.510520638458724e-08
        s = s * r + 2.75572736613304e-07
        s = s * r + 2.7557255425720897e-06
        s = s * r + 2.4801587325533377e-05
        s = s * r + 0.00019841269874800512
        s = s * r + 0.0013888888888883752
        s = s * r + 0.008333333333326141
        s = s * r + 0.04166666666666667
        s = s * r + 0.1666666666666667
        s = s * r + 0.5
        scale = _float_of((_bits_of(shifted) + 1023) << 52)
        return (1.0 + (r + r * (r * s))) * scale

    return implementation


@overload(ops.sqrt, jit_options=OPTIONS)
def _sqrt(x):
    def implementation(x):
        return np.sqrt(x)

    return implementation


@overload(ops.log, jit_options=OPTIONS)
def _log(x):
    def implementation(x):
        return np.log(x)

    return implementation


@overload(ops.power, jit_options=OPTIONS)
def _power(base, exponent):
    def implementation(base, exponent):
        return base**exponent

    return implementation


@overload(ops.select, jit_options=OPTIONS)
def _select(condition, yes, no):
    def implementation(condition, yes, no):
        return yes if condition else no

    return implementation


@overload(ops.minimum, jit_options=OPTIONS)
def _minimum(x, y):
    def implementation(x, y):
        return y if y < x else x

    return implementation


@overload(ops.maximum, jit_options=OPTIONS)
def _maximum(x, y):
    def implementation(x, y):
        return y if y > x else x

    return implementation


@overload(ops.absolute, jit_options=OPTIONS)
def _absolute(x):
    def implementation(x):
        return abs(x)

    return implementation
