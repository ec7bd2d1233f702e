"""The curves that translations are judged by, for many tires."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import TireForces, TireModel
from tire_pipeline.magic_formula.parameters.coefficients import COEFFICIENT_NAMES

# What a table must hold, without NaN, for each group of curves.
NEEDED_FOR_CURVES: tuple[str, ...] = ("FNOMIN", "PCY1", "PDY1", "PDY2", "PEY1", "PEY2", "PKY1", "PKY2")
NEEDED_FOR_CURVES += ("PHY1", "PHY2", "PVY1", "PVY2")


def _linspace(low: float, high: float, count: int) -> np.ndarray:
    return np.linspace(low, high, count)


@dataclass(frozen=True)
class EvaluationGrid:
    """Operating points of the curves.

    Attributes
    ----------
    slip_angles : ndarray
        rad; thesis, section 4.2.3: 100 in [-0.25, 0.25].
    loads : ndarray
        N; thesis: 4000, 6000, 8000.
    load_axis : ndarray
        N; loads of the curves of cornering stiffness and peak friction (thesis, Figures 5.14, 5.15).
    slip_ratios : ndarray
        For the longitudinal force.
    cambers : ndarray
        rad; for lateral force and aligning torque with camber.
    """

    slip_angles: np.ndarray = field(default_factory=lambda: _linspace(-0.25, 0.25, 100))
    loads: np.ndarray = field(default_factory=lambda: np.array([4000.0, 6000.0, 8000.0]))
    load_axis: np.ndarray = field(default_factory=lambda: _linspace(2000.0, 9000.0, 15))
    slip_ratios: np.ndarray = field(default_factory=lambda: _linspace(-0.2, 0.2, 61))
    cambers: np.ndarray = field(default_factory=lambda: np.array([-0.07, 0.07]))


@dataclass(frozen=True)
class Curves:
    """Curves of n tires. ``None``: not known (for example a decoded force curve alone).

    Attributes
    ----------
    fy : ndarray, shape (n, loads, slip angles)
        Lateral force at zero camber, N.
    cornering_stiffness : ndarray, shape (n, load axis)
        Size of the slope of the lateral force, N/rad.
    peak_friction : ndarray, shape (n, load axis)
        Largest size of lateral force over load within the slip angles.
    fy_camber : ndarray, shape (n, cambers, loads, slip angles)
    fx : ndarray, shape (n, 1 + cambers, loads, slip ratios)
        Longitudinal force at zero slip angle, zero camber first.
    mz : ndarray, shape (n, 1 + cambers, loads, slip angles)
        Aligning torque, zero camber first, N m.
    """

    fy: np.ndarray
    cornering_stiffness: np.ndarray | None = None
    peak_friction: np.ndarray | None = None
    fy_camber: np.ndarray | None = None
    fx: np.ndarray | None = None
    mz: np.ndarray | None = None

    def __len__(self) -> int:
        return len(self.fy)


def curves_of(
    table: pd.DataFrame, grid: EvaluationGrid | None = None, *, lateral_only: bool = False
) -> Curves:
    """Evaluate every tire of a table on the grid.

    Parameters
    ----------
    table : pandas.DataFrame
        n rows with coefficients by ``.tir`` name (SI) and, if there is one, ``version``; columns
        that a model of that version lacks stand at their neutral values.
    grid : EvaluationGrid, optional
    lateral_only : bool
        Only the thesis' three curves.

    Returns
    -------
    Curves

    Raises
    ------
    DomainError
        If a coefficient of the lateral force is missing: names the row and the coefficient.
    """
    grid = grid or EvaluationGrid()
    _check(table)
    names = [name for name in COEFFICIENT_NAMES if name in table.columns]
    versions = table["version"].astype(str).to_list() if "version" in table else ["5.2"] * len(table)
    rows = [
        _tire_curves(_model(record, version), grid, lateral_only)
        for record, version in zip(table[names].to_dict("records"), versions, strict=True)
    ]
    if not rows:
        raise DomainError("there is no tire to evaluate", where="evaluation", todo="give at least one")
    return Curves(**{name: np.stack([row[name] for row in rows]) for name in rows[0]})


def _check(table: pd.DataFrame) -> None:
    absent = [name for name in NEEDED_FOR_CURVES if name not in table.columns]
    if absent:
        raise DomainError(
            f"the table has no column {', '.join(absent)}",
            where="evaluation",
            todo="give all coefficients of the lateral force and FNOMIN",
        )
    empty = table[list(NEEDED_FOR_CURVES)].isna()
    if empty.any(axis=None):
        row, column = np.argwhere(empty.to_numpy())[0]
        name = table["file"].iloc[row] if "file" in table else table.index[row]
        raise DomainError(
            f"{name} has no value for {NEEDED_FOR_CURVES[column]}",
            where="evaluation",
            todo="drop it, or fill in the coefficient",
        )


def _model(record: Mapping[str, float], version: str) -> TireModel:
    known = {str(name): value for name, value in record.items() if value == value}
    return TireModel.from_coefficients(known, version=version)


def _tire_curves(tire: TireModel, grid: EvaluationGrid, lateral_only: bool) -> dict[str, np.ndarray]:
    """All curves of one tire."""

    def forces(outputs: list[str], **points: Any) -> TireForces:
        return tire.forces(limits="ignore", outputs=outputs, **points)

    loads, angles, axis = grid.loads[:, None], grid.slip_angles, grid.load_axis
    flat = forces(["fy"], normal_load=loads, slip_angle=angles)
    along = forces(["fy"], normal_load=axis[:, None], slip_angle=angles)
    slope = forces(["cornering_stiffness"], normal_load=axis)
    curves = {
        "fy": flat.fy,
        "cornering_stiffness": np.abs(slope.cornering_stiffness),
        "peak_friction": np.abs(along.fy).max(axis=1) / axis,
    }
    if lateral_only:
        return curves
    tilts = np.concatenate([[0.0], grid.cambers])[:, None, None]
    side = forces(["fy", "mz"], normal_load=loads, slip_angle=angles, camber=tilts)
    length = forces(["fx"], normal_load=loads, slip_ratio=grid.slip_ratios, camber=tilts)
    return {**curves, "fy_camber": side.fy[1:], "mz": side.mz, "fx": length.fx}


CURVE_NAMES: tuple[str, ...] = tuple(item.name for item in fields(Curves))
