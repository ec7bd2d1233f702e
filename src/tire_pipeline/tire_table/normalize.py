"""A whole tire table brought to one nominal load (thesis, Appendix B).

With r = F'z0 / Fz0 and e = r - 1, for every form in which the nominal load enters the equations:

====================================  ==============================================================
form                                  coefficients afterwards
====================================  ==============================================================
p1 + p2 dfz + p3 dfz^2                p1 + p2 e + p3 e^2;  (p2 + 2 p3 e) r;  p3 r^2
(p1 + p2 dfz) exp(s p3 dfz), s = +-1  (p1 + p2 e) exp(s p3 e);  p2 r exp(s p3 e);  p3 r
any of these divided by Fz0           the same, the factors in front times r
p Fz0;  p / Fz0;  p / sqrt(Fz0)       p / r;  p r;  p sqrt(r)
p1 (1 + p2 dfz)                       p1 (1 + p2 e);  p2 r / (1 + p2 e)
c (1 + p1 dfz + p2 dfz^2)             c k;  (p1 + 2 p2 e) r / k;  p2 r^2 / k;  k = 1 + p1 e + p2 e^2
Fz0 q (Fz / Fz0)^n                    q r^(n - 1)
====================================  ==============================================================
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pandas as pd

from tire_pipeline.errors import DomainError

Columns = dict[str, npt.NDArray[np.float64]]

_POLYNOMIALS = tuple(
    tuple(names.split())
    for names in (
        "PDX1 PDX2",
        "PEX1 PEX2 PEX3",
        "PHX1 PHX2",
        "PVX1 PVX2",
        "PDY1 PDY2",
        "PEY1 PEY2",
        "PHY1 PHY2",
        "PVY1 PVY2",
        "PVY3 PVY4",
        "PKY6 PKY7",
        "QBZ1 QBZ2 QBZ3",
        "QDZ1 QDZ2",
        "QDZ6 QDZ7",
        "QDZ8 QDZ9",
        "QDZ10 QDZ11",
        "QEZ1 QEZ2 QEZ3",
        "QHZ1 QHZ2",
        "QHZ3 QHZ4",
        "REX1 REX2",
        "REY1 REY2",
        "RHY1 RHY2",
        "RVY1 RVY2",
        "SSZ3 SSZ4",
        "PHYP2 PHYP3",
    )
)
_EXPONENTIALS = (("PKX1", "PKX2", "PKX3", 1.0), ("PTX1", "PTX2", "PTX3", -1.0))
_PRODUCTS = (("PDXP1", "PDXP2"), ("PDYP1", "PDYP2"), ("PECP1", "PECP2"))
_STIFFNESSES = (("LONGITUDINAL_STIFFNESS", "PCFX1", "PCFX2"), ("LATERAL_STIFFNESS", "PCFY1", "PCFY2"))
_ROLLING = ("QSY1", "QSY2", "QSY3", "QSY4", "QSY5", "QSY6")
_POWERS = {
    **dict.fromkeys(["PKY1", "PKY2", "PKY5", "PTY2"], -1.0),
    **dict.fromkeys(["QDZ1", "QDZ2", "PTX1", "PTX2"], 1.0),
    **dict.fromkeys(["SSZ2", "QSX3", "QSX6", "QSX9", "QSX11", "QSY2", "QSY6"], 1.0),
    "QCRP1": 0.5,
}
"""Coefficient -> power of r that it is multiplied by, after its polynomial if it has one."""


def normalize_table(table: pd.DataFrame, nominal_load: npt.ArrayLike) -> pd.DataFrame:
    """Write the same forces with one nominal load.

    A coefficient that a file lacks counts as 0, and stays without a value unless it no longer is 0.

    Parameters
    ----------
    table : DataFrame
        A tire table; not changed.
    nominal_load : float or array_like, shape (rows,)
        N; an array brings every row to its own, for example back to where it came from.

    Returns
    -------
    DataFrame
        The same rows and columns; ``FNOMIN`` is ``nominal_load``.

    Raises
    ------
    DomainError
        ``nominal_load`` or some ``FNOMIN`` is not positive, or a coefficient leaves the range of numbers.
    """
    wanted = np.broadcast_to(np.asarray(nominal_load, dtype=float), len(table))
    bad = wanted[~(np.isfinite(wanted) & (wanted > 0))]
    if bad.size:
        raise DomainError(f"a nominal load of {bad[0]} N", todo="give a positive one")
    present = table["FNOMIN"].to_numpy(dtype=float)
    if not np.all(present > 0):
        file = table.loc[~(present > 0), "file"].iloc[0]
        raise DomainError("FNOMIN is not positive", where=str(file), todo="drop this file")
    ratio = wanted / present
    is_61 = table["version"].str.startswith("6").to_numpy(dtype=bool)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        changed = _changed(_Table(table), ratio, is_61)
    result = table.copy()
    for name, values in changed.items():
        if not np.isfinite(values).all():
            row = int(np.flatnonzero(~np.isfinite(values))[0])
            file = table["file"].iloc[row]
            raise DomainError(
                f"{name} has no finite value at a nominal load of {wanted[row]:g} N",
                where=str(file),
                todo="drop this file, or choose a nominal load near to its own",
            )
        if name in table.columns:
            absent = table[name].isna().to_numpy() & (values == 0.0)
            result[name] = np.where(absent, np.nan, values)
        elif np.any(values != 0.0):
            result[name] = np.where(values == 0.0, np.nan, values)
    return result.assign(FNOMIN=wanted)


class _Table:
    """Columns by name; a missing one, and a missing value, is 0."""

    def __init__(self, table: pd.DataFrame) -> None:
        self.table = table

    def __getitem__(self, name: str) -> npt.NDArray[np.float64]:
        if name not in self.table.columns:
            return np.zeros(len(self.table))
        return np.nan_to_num(self.table[name].to_numpy(dtype=float), nan=0.0)

    def __contains__(self, name: str) -> bool:
        return name in self.table.columns


def _changed(p: _Table, r: npt.NDArray[np.float64], is_61: npt.NDArray[np.bool_]) -> Columns:
    e = r - 1.0
    new: Columns = {}
    for names in _POLYNOMIALS:
        if any(name in p for name in names):
            _polynomial(p, new, names, r, e)
    for one, two, three, sign in _EXPONENTIALS:
        if any(name in p for name in (one, two, three)):
            factor = np.exp(sign * p[three] * e)
            new[one] = (p[one] + p[two] * e) * factor
            new[two], new[three] = p[two] * r * factor, p[three] * r
    for one, two in _PRODUCTS:
        if one in p and two in p:
            at_load = 1.0 + p[two] * e
            new[one], new[two] = p[one] * at_load, p[two] * r / at_load
    for stiffness, one, two in _STIFFNESSES:
        if one in p or two in p:
            at_load = 1.0 + p[one] * e + p[two] * e * e
            new[stiffness] = p[stiffness] * at_load
            new[one], new[two] = (p[one] + 2.0 * p[two] * e) * r / at_load, p[two] * r * r / at_load
    for name in _ROLLING:
        if name in p and "QSY7" in p:
            exponent = p.table["QSY7"].fillna(1.0).to_numpy(dtype=float) - 1.0
            new[name] = p[name] * np.where(is_61, r**exponent, 1.0)
    for name, power in _POWERS.items():
        if name in p or name in new:
            new[name] = new.get(name, p[name]) * r**power
    return new


def _polynomial(
    p: _Table,
    new: Columns,
    names: tuple[str, ...],
    r: npt.NDArray[np.float64],
    e: npt.NDArray[np.float64],
) -> None:
    one, two = p[names[0]], p[names[1]]
    new[names[0]], new[names[1]] = one + two * e, two * r
    if len(names) == 3:
        three = p[names[2]]
        new[names[0]] += three * e * e
        new[names[1]] += 2.0 * three * e * r
        new[names[2]] = three * r * r
