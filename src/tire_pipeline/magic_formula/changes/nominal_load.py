"""The same tire with another nominal load (thesis, Appendix B, and the forms that it leaves out).

Every form in which Fz0 appears keeps its shape, so forces at any load stay as they are. With r = new / old
and dfz = r dfz' + (r - 1), a scale factor LFZO, which multiplies both nominal loads, changes nothing of this.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from tire_pipeline.errors import TirValueError
from tire_pipeline.magic_formula.parameters.tire_parameters import Tire

POLYNOMIALS: tuple[tuple[str, ...], ...] = (
    ("PDX1", "PDX2"),
    ("PEX1", "PEX2", "PEX3"),
    ("PHX1", "PHX2"),
    ("PVX1", "PVX2"),
    ("PDY1", "PDY2"),
    ("PEY1", "PEY2"),
    ("PHY1", "PHY2"),
    ("PVY1", "PVY2"),
    ("PVY3", "PVY4"),
    ("PKY6", "PKY7"),
    ("QBZ1", "QBZ2", "QBZ3"),
    ("QDZ6", "QDZ7"),
    ("QDZ8", "QDZ9"),
    ("QDZ10", "QDZ11"),
    ("QEZ1", "QEZ2", "QEZ3"),
    ("QHZ1", "QHZ2"),
    ("QHZ3", "QHZ4"),
    ("REX1", "REX2"),
    ("REY1", "REY2"),
    ("RHY1", "RHY2"),
    ("RVY1", "RVY2"),
    ("SSZ3", "SSZ4"),
    ("PHYP2", "PHYP3"),
)
"""Groups p1 + p2 dfz + p3 dfz^2."""

TIMES_R = ("SSZ2", "QSX3", "QSX6", "QSX9", "QSX11", "BREFF", "Q_FCX", "Q_FCY")
"""Factors of a force over Fz0: they grow as r."""
BY_R = ("PKY1", "PKY2", "PKY5", "PTY2", "DREFF")
"""Factors of Fz0, or of a load Fz0 p: they shrink as r."""
RELATIVE: tuple[tuple[str, str, str | None], ...] = (
    ("LONGITUDINAL_STIFFNESS", "PCFX1", "PCFX2"),
    ("LATERAL_STIFFNESS", "PCFY1", "PCFY2"),
)
PRODUCTS = (("PDXP1", "PDXP2"), ("PDYP1", "PDYP2"), ("PECP1", "PECP2"))
"""Groups p1 (1 + p2 dfz)."""


def changed_coefficients(coefficients: Mapping[str, Any], new: Any, family: int = 5) -> dict[str, Any]:
    """Return the coefficients that change when the nominal load becomes ``new``, ``FNOMIN`` among them.

    Parameters
    ----------
    coefficients : mapping of str to float or ndarray
        By ``.tir`` name; arrays (one value a tire) work as well. What is missing counts as 0.
    new : float or ndarray
        The new nominal load (N); an array with the coefficients' shape gives every tire its own.
    family : {5, 6}
        5: equations of MF 5.2; 6: of MF 6.1 and 6.2 (they differ in the rolling resistance).

    Returns
    -------
    dict of str to float or ndarray
        New values of those coefficients that are there, and of those that a change brings about.

    Raises
    ------
    TirValueError
        If ``new`` is not positive and finite.

    Notes
    -----
    Thesis, Appendix B: polynomials in dfz, the exponential form (``PKX``), p Fz0, and D_t. Beyond it:
    K_y = p Fz0 sin(2 arctan(Fz / (q Fz0))) keeps its values with p / r and q / r; forces over Fz0
    (``SSZ2``, ``QSX``, ``QSY2``) take a factor r.
    """
    if not np.all(np.isfinite(new) & (np.asarray(new) > 0)):
        raise TirValueError(
            f"the new nominal load {new!r} must be positive", key="FNOMIN", todo="state it in newtons"
        )
    r = new / _get(coefficients, "FNOMIN")
    changed: dict[str, Any] = {"FNOMIN": new + 0.0 * r}
    for group in POLYNOMIALS:
        changed.update(zip(group, _polynomial([_get(coefficients, n) for n in group], r), strict=True))
    changed.update(_exponential(coefficients, "PKX", r, 1.0, 1.0))
    changed.update(_exponential(coefficients, "PTX", r, -1.0, r))
    changed["QDZ1"], changed["QDZ2"] = (
        r * x for x in _polynomial([_get(coefficients, n) for n in ("QDZ1", "QDZ2")], r)
    )
    for name in TIMES_R:
        changed[name] = r * _get(coefficients, name)
    for name in BY_R:
        changed[name] = _get(coefficients, name) / r
    for base, *others in RELATIVE:
        changed.update(_relative(coefficients, base, [n for n in others if n], r))
    for first, second in PRODUCTS:
        changed.update(_product(coefficients, first, second, r))
    changed["QCRP1"] = _get(coefficients, "QCRP1") * np.sqrt(r)
    changed.update(_rolling(coefficients, r, family))
    return {name: value for name, value in changed.items() if name in coefficients or np.any(value != 0)}


def nominal_load_changed(model: Tire, new: float) -> Tire:
    """Return the same tire with another nominal load: the same forces and moments at every load.

    Parameters
    ----------
    model : TireParameters
    new : float
        The new ``FNOMIN`` (N).

    Returns
    -------
    TireParameters
        Of the class that came in.

    Raises
    ------
    TirValueError
        If ``new`` is not positive.
    """
    return model.replace(**changed_coefficients(model.coefficients, new, model.family))


def _get(coefficients: Mapping[str, Any], name: str) -> Any:
    return coefficients.get(name, 0.0)


def _polynomial(p: list[Any], r: Any) -> list[Any]:
    """p1 + p2 d + p3 d^2 with d = (r - 1) + r d'."""
    s = r - 1.0
    if len(p) == 2:
        return [p[0] + p[1] * s, p[1] * r]
    return [p[0] + p[1] * s + p[2] * s * s, (p[1] + 2.0 * p[2] * s) * r, p[2] * r * r]


def _exponential(c: Mapping[str, Any], prefix: str, r: Any, sign: float, factor: Any) -> dict[str, Any]:
    """factor (p1 + p2 d) exp(sign p3 d)."""
    p1, p2, p3 = (_get(c, f"{prefix}{i}") for i in (1, 2, 3))
    first, second = _polynomial([p1, p2], r)
    scale = factor * np.exp(sign * p3 * (r - 1.0))
    return {f"{prefix}1": first * scale, f"{prefix}2": second * scale, f"{prefix}3": p3 * r}


def _relative(c: Mapping[str, Any], base: str, names: list[str], r: Any) -> dict[str, Any]:
    """Base (1 + p1 d + p2 d^2)."""
    a, *rest = _polynomial([1.0, *(_get(c, n) for n in names)], r)
    return {base: _get(c, base) * a, **{n: x / a for n, x in zip(names, rest, strict=True)}}


def _product(c: Mapping[str, Any], first: str, second: str, r: Any) -> dict[str, Any]:
    a, b = _polynomial([1.0, _get(c, second)], r)
    return {first: _get(c, first) * a, second: b / a}


def _rolling(c: Mapping[str, Any], r: Any, family: int) -> dict[str, Any]:
    if family == 5:
        return {"QSY2": _get(c, "QSY2") * r}
    # My = Fz0 (...) (Fz / Fz0)^QSY7: the load's power is what is left of Fz0
    factor = r ** (c.get("QSY7", 1.0) - 1.0)
    changed = {f"QSY{i}": _get(c, f"QSY{i}") * factor for i in (1, 3, 4, 5)}
    changed.update({f"QSY{i}": _get(c, f"QSY{i}") * factor * r for i in (2, 6)})
    return changed
