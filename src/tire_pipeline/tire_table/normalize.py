"""A whole tire table brought to one nominal load (thesis, Appendix B)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula.changes.nominal_load import changed_coefficients
from tire_pipeline.magic_formula.parameters.coefficients import family_of

_NOT_ZERO_BY_DEFAULT = {"QSY7": 1.0}


def normalize_table(table: pd.DataFrame, nominal_load: npt.ArrayLike) -> pd.DataFrame:
    """Write the same forces with one nominal load, all rows at once.

    The rules are those of :func:`tire_pipeline.magic_formula.changes.nominal_load.changed_coefficients`. A
    coefficient that a file lacks counts as what stands in for it, and stays without a value unless the
    change gives it one.

    Parameters
    ----------
    table : DataFrame
        A tire table; not changed.
    nominal_load : float or array_like, shape (rows,)
        N; an array gives every row its own, for example to bring each back to where it came from.

    Returns
    -------
    DataFrame
        The same rows and columns; ``FNOMIN`` is ``nominal_load``. A coefficient that no file had, and that
        the change brings about, gets a new column.

    Raises
    ------
    DomainError
        ``nominal_load`` or some ``FNOMIN`` is not positive, or a coefficient leaves the range of numbers.
    """
    wanted = np.broadcast_to(np.asarray(nominal_load, dtype=float), len(table))
    wrong = wanted[~(np.isfinite(wanted) & (wanted > 0))]
    if wrong.size:
        raise DomainError(f"a nominal load of {wrong[0]} N", todo="give a positive one")
    present = table["FNOMIN"].to_numpy(dtype=float)
    if not np.all(present > 0):
        file = table.loc[~(present > 0), "file"].iloc[0]
        raise DomainError("FNOMIN is not positive", where=str(file), todo="drop this file")
    result = table.copy()
    families = table["version"].map({version: family_of(version) for version in table["version"].unique()})
    for family in sorted(families.unique()):
        rows = (families == family).to_numpy()
        for name, values in _changed(table, rows, wanted[rows], int(family)).items():
            _check(name, values, table.loc[rows, "file"], wanted[rows])
            if name not in result.columns:
                result[name] = np.nan
            old = result[name].to_numpy(dtype=float, copy=True)
            absent = np.isnan(old[rows]) & (values == _NOT_ZERO_BY_DEFAULT.get(name, 0.0))
            old[rows] = np.where(absent, np.nan, values)
            result[name] = old
    return result.copy()  # in one piece again: pandas warns of columns that were put in one by one


def _changed(
    table: pd.DataFrame, rows: npt.NDArray[np.bool_], nominal_load: npt.NDArray[np.float64], family: int
) -> dict[str, npt.NDArray[np.float64]]:
    numbers = table.loc[rows].select_dtypes("number")
    columns = {
        str(name): numbers[name].fillna(_NOT_ZERO_BY_DEFAULT.get(str(name), 0.0)).to_numpy(dtype=float)
        for name in numbers.columns
    }
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        return changed_coefficients(columns, nominal_load, family)


def _check(
    name: str, values: npt.NDArray[np.float64], files: pd.Series, nominal_load: npt.NDArray[np.float64]
) -> None:
    finite = np.isfinite(values)
    if not finite.all():
        raise DomainError(
            f"{name} has no finite value at a nominal load of {nominal_load[~finite][0]:g} N",
            where=str(files[~finite].iloc[0]),
            todo="drop this file, or choose a nominal load nearer to its own",
        )
