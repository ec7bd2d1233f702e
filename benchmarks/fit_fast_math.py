"""Find the polynomials of ``magic_formula/compiled/fast_math.py`` (needs mpmath, which comes with sympy).

Prints each polynomial's coefficients, highest power first, and its largest relative error.
"""

from mpmath import atan, chebyfit, exp, log, mp, mpf, pi, sin, sqrt, tan

mp.dps = 40
TINY = mpf("1e-20")


def arctan_part(z):
    """(arctan(s)/s - 1) / z with z = s^2."""
    z = mpf(z)
    if z < TINY:
        return mpf(-1) / 3 + z / 5
    s = sqrt(z)
    return (atan(s) / s - 1) / z


def sine_part(z):
    """(sin(s)/s - 1) / z with z = s^2."""
    z = mpf(z)
    if z < TINY:
        return mpf(-1) / 6 + z / 120
    s = sqrt(z)
    return (sin(s) / s - 1) / z


def exp_part(r):
    """(exp(r) - 1 - r) / r^2."""
    r = mpf(r)
    if abs(r) < mpf("1e-12"):
        return mpf(1) / 2 + r / 6 + r * r / 24
    return (exp(r) - 1 - r) / r**2


def show(name, function, interval, terms, scale):
    coefficients, error = chebyfit(function, interval, terms, error=True)
    print(f"{name}: error {float(error * scale):.1e}")
    print(*(repr(float(c)) for c in coefficients), sep="\n")


if __name__ == "__main__":
    margin = 1 + mpf("1e-7")
    top = tan(pi / 8) ** 2 * margin
    show("arctan", arctan_part, [0, top], 11, top)
    top = (pi / 2) ** 2 * margin
    show("sin", sine_part, [0, top], 8, top)
    top = log(2) / 2 * margin
    show("exp", exp_part, [-top, top], 11, top**2)
