"""Figures of a fit: what was measured, what was fitted, and the residual."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import SHOWN_UNITS, SLIP_OF_FORCE, axis_label, unit_of
from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula.fitting.report.statistics import LOAD_STEP
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import PURE_SLIP_ANGLE, PURE_SLIP_RATIO
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS, OperatingPoints
from tire_pipeline.pages.drawing import colour_of, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MOST_LOADS = 5
_MOST_DRAWN_POINTS = 3000
_FEWEST_DRAWN = 5
_FEW_DRAWN = 300


def draw_fit(model: TireModel, measured: pd.DataFrame | None) -> tuple[Figure, str]:
    """Draw measured points with the fitted curves, and the residuals, at pure slip.

    Parameters
    ----------
    model : TireModel
    measured : DataFrame
        Points and forces by canonical name, SI.

    Returns
    -------
    figure : matplotlib.figure.Figure
    caption : str

    Raises
    ------
    DomainError
        The points are not there, or none of them is at pure slip.
    """
    parts = {} if measured is None else {o: _pure(measured, o) for o in SLIP_OF_FORCE if o in measured}
    parts = {
        o: part for o, part in parts.items() if len(part) >= _FEWEST_DRAWN and _spread(part, SLIP_OF_FORCE[o])
    }
    if not parts:
        raise DomainError("there are no points at pure slip to draw", todo="draw result.model.plot() instead")
    figure, axes = new_figure(len(parts), 2, width=9.5, height=2.9 * len(parts), squeeze=False)
    for row, (output, part) in zip(np.asarray(axes), parts.items(), strict=True):
        _draw(row, model, output, part)
    caption = (
        "Points: measured at pure slip, grouped by load. Lines: the fitted model at each group's median load "
        "and pressure and its most frequent camber. Right: model minus measured at each point; a pattern "
        "there is misfit, scatter without one is noise."
    )
    return figure, caption


def _pure(measured: pd.DataFrame, output: str) -> pd.DataFrame:
    """Points at pure slip that have the output, thinned evenly."""
    other, limit = ("slip_angle", PURE_SLIP_ANGLE) if output == "fx" else ("slip_ratio", PURE_SLIP_RATIO)
    rows = measured[(measured[other].abs() <= limit) & np.isfinite(measured[output])]
    return rows.iloc[:: max(1, len(rows) // _MOST_DRAWN_POINTS)]


def _spread(part: pd.DataFrame, slip: str) -> bool:
    return bool(np.ptp(part[slip]) > 0.0)


def _draw(row: Any, model: TireModel, output: str, part: pd.DataFrame) -> None:
    slip, name = SLIP_OF_FORCE[output], output.capitalize()
    factor, unit = SHOWN_UNITS[slip].factor, unit_of(output)
    step = LOAD_STEP * model.value("FNOMIN")
    group = np.round(part["normal_load"] / step)
    largest = group.value_counts().index[:_MOST_LOADS]
    for i, number in enumerate(sorted(largest)):
        own = part[group == number]
        alike = own[_most_frequent(np.round(np.degrees(own["camber"])))]
        typical = {
            n: float(alike[n].median()) for n in POINT_CHANNELS if n not in ("slip_angle", "slip_ratio")
        }
        x = np.linspace(own[slip].min(), own[slip].max(), 200)
        label = f"{typical['normal_load']:,.0f} N, {round(np.degrees(typical['camber']), 1) + 0.0:.1f} deg"
        fitted = _forces(model, output, **{slip: x}, **typical)
        there = _forces(model, output, **{n: own[n].to_numpy() for n in POINT_CHANNELS})
        dots: Any = {"ls": "", "marker": ".", "color": colour_of(i), "mew": 0, **_size(len(part))}
        row[0].plot(own[slip] * factor, own[output], **dots)
        row[0].plot(x * factor, fitted, color=colour_of(i), lw=1.5, label=label)
        row[1].plot(own[slip] * factor, there - own[output], **dots)
    row[0].legend(title="load, camber", fontsize=7, title_fontsize=7)
    row[1].axhline(0.0, color="black", lw=0.8)
    for panel, text in zip(row, (f"{name} ({unit})", f"{name}, model - measured ({unit})"), strict=True):
        panel.set_xlabel(axis_label(slip))
        panel.set_ylabel(text)


def _size(points: int) -> dict[str, float]:
    """Few points are drawn large: steady points are some hundred, a run has thousands."""
    return {"ms": 9.0, "alpha": 0.8} if points <= _FEW_DRAWN else {"ms": 3.0, "alpha": 0.4}


def _most_frequent(x: pd.Series) -> pd.Series:
    return x == x.value_counts().index[0]


def _forces(model: TireModel, output: str, **points: Any) -> np.ndarray:
    found = model.forces(OperatingPoints(**points), limits="ignore", outputs=(output,))
    return np.asarray(getattr(found, output))
