"""The forms that every version of the Magic Formula is built of."""

from __future__ import annotations

from tire_pipeline.magic_formula.equations.jit import jitable
from tire_pipeline.magic_formula.equations.ops import (
    HUGE,
    TWO_OVER_PI,
    absolute,
    arctan,
    cos,
    maximum,
    minimum,
    select,
    sin,
    sqrt,
)


@jitable
def clamp(x, bound):
    """Return x, held within plus and minus the bound."""
    return minimum(maximum(x, -bound), bound)


@jitable
def divide(x, y):
    """Return x / y, and 0 where y is 0."""
    zero = y == 0.0
    return select(zero, 0.0, x / select(zero, 1.0, y))


@jitable
def sign(x):
    """Return -1, 0 or 1."""
    return select(x > 0.0, 1.0, select(x < 0.0, -1.0, 0.0))


@jitable
def cos_arctan(x):
    """Return cos(arctan(x)) without a transcendental function."""
    return 1.0 / sqrt(1.0 + x * x)


@jitable
def bend(b, e, x):
    """Return B x - E (B x - arctan(B x)), the argument of the outer arctangent.

    Written as (1 - E) B x + E arctan(B x): the same, and it stays right where B x is very large.
    """
    bx = clamp(b * x, HUGE)
    return (1.0 - e) * bx + e * arctan(bx)


@jitable
def sine_curve(b, c, d, e, x):
    """Return D sin[C arctan{B x - E (B x - arctan(B x))}] (A.4, A.16; 4.E9, 4.E19)."""
    return d * sin(c * arctan(bend(b, e, x)))


@jitable
def cosine_curve(b, c, e, x):
    """Return cos[C arctan{B x - E (B x - arctan(B x))}] (A.29, A.51, A.62; 4.E33, 4.E51, 4.E59)."""
    return cos(c * arctan(bend(b, e, x)))


@jitable
def weight(b, c, e, slip, shift):
    """Return the combined-slip weight G: the cosine curve at slip + shift over that at the shift."""
    return divide(cosine_curve(b, c, e, slip + shift), cosine_curve(b, c, e, shift))


@jitable
def equivalent_slip(alpha, ratio, kappa):
    """Return arctan(sqrt(tan^2 alpha + (Kx / Ky)^2 kappa^2)) sgn(alpha) (A.68, A.69)."""
    s, c = sin(alpha), cos(alpha)
    tangent = divide(s, c)
    k = clamp(ratio, HUGE) * kappa
    return arctan(sqrt(tangent * tangent + minimum(k * k, HUGE * HUGE))) * sign(alpha)


@jitable
def magnitude(x):
    """Return the magnitude of x."""
    return absolute(x)


@jitable
def trail_slip(p, alpha, gamma, dfz):
    """Return alpha_t = alpha + S_Ht, the slip angle that the trail follows."""
    return alpha + p.QHZ1 + p.QHZ2 * dfz + (p.QHZ3 + p.QHZ4 * dfz) * gamma


@jitable
def trail_stiffness_factor(p, gamma, dfz):
    """Return B_t, the stiffness factor of the trail."""
    return (
        (p.QBZ1 + p.QBZ2 * dfz + p.QBZ3 * dfz * dfz)
        * (1.0 + p.QBZ4 * gamma + p.QBZ5 * absolute(gamma))
        * p.LKY
        / p.LMUY
    )


@jitable
def trail_curvature_factor(p, bt, alpha_t, gamma, dfz):
    """Return E_t, the curvature factor of the trail, not yet bounded by 1."""
    return (p.QEZ1 + p.QEZ2 * dfz + p.QEZ3 * dfz * dfz) * (
        1.0 + (p.QEZ4 + p.QEZ5 * gamma) * TWO_OVER_PI * arctan(bt * p.QCZ1 * alpha_t)
    )
