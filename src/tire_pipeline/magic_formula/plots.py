"""Figures of tire models: forces over slip, stiffness over load."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from tire_pipeline.channels import SHOWN_UNITS, SLIP_OF_FORCE, axis_label
from tire_pipeline.magic_formula.forces import tire_forces
from tire_pipeline.magic_formula.key_figures import forces_over, usual_loads
from tire_pipeline.magic_formula.parameters.points import OperatingPoints
from tire_pipeline.magic_formula.parameters.tire_parameters import TireParameters
from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.unit_definitions import DEGREE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_LINES = ("-", "--", ":", "-.")
_LINE_WORDS = ("solid", "dashed", "dotted", "dash-dotted")


def draw_models(
    models: Mapping[str, TireParameters], *, loads: Sequence[float] | None = None, camber: float = 0.0
) -> tuple[Figure, str]:
    """Draw forces over slip at some loads, and cornering stiffness over load.

    Parameters
    ----------
    models : mapping of str to TireParameters
        Name in the legend -> model; up to four.
    loads : sequence of float, optional
        N; half, one and one and a half nominal loads if left out.
    camber : float
        rad.

    Returns
    -------
    figure : matplotlib.figure.Figure
    caption : str
    """
    loads = usual_loads(list(models.values())) if loads is None else [float(load) for load in loads]
    figure, axes = new_figure(2, 2, width=9.0, height=6.2)
    panels = np.asarray(axes).ravel()
    for panel, (force, slip) in zip(panels, SLIP_OF_FORCE.items(), strict=False):
        for line, model in zip(_LINES, models.values(), strict=False):
            _forces(panel, model, force, slip, loads, camber, line)
        panel.set_xlabel(axis_label(slip))
        panel.set_ylabel(axis_label(force))
        _say_if_empty(panel)
    _stiffness(panels[3], models, loads, camber)
    _legends(panels, models, loads)
    return figure, _caption(models, camber)


def _forces(
    panel: Any, model: TireParameters, force: str, slip: str, loads: Sequence[float], camber: float, line: str
) -> None:
    for i, load in enumerate(loads):
        found = forces_over(model, slip, load, camber=camber)
        x, y = found["slip"] * SHOWN_UNITS[slip].factor, found[force] * SHOWN_UNITS[force].factor
        if np.isfinite(y).any() and np.ptp(y) > 0.0:
            panel.plot(x, y, line, color=colour_of(i), lw=1.4)


def _stiffness(
    panel: Any, models: Mapping[str, TireParameters], loads: Sequence[float], camber: float
) -> None:
    for line, model in zip(_LINES, models.values(), strict=False):
        axis = np.linspace(0.1 * min(loads), 1.2 * max(loads), 200)
        points = OperatingPoints(normal_load=axis, camber=camber)
        found = tire_forces(model, points, limits="ignore", outputs=("cornering_stiffness",))
        stiffness = np.abs(found.cornering_stiffness) * DEGREE
        if stiffness.max() > 0.0:
            panel.plot(axis / 1e3, stiffness, line, color="black", lw=1.4)
    for i, load in enumerate(loads):
        panel.axvline(load / 1e3, color=colour_of(i), lw=0.8, alpha=0.6)
    panel.set_xlabel("normal load Fz (kN)")
    panel.set_ylabel("cornering stiffness (N/deg)")
    panel.set_ylim(bottom=0.0)
    _say_if_empty(panel)


def _say_if_empty(panel: Any) -> None:
    if not any(len(line.get_xdata()) > 2 for line in panel.lines):
        panel.text(0.5, 0.5, "the file does not give it", ha="center", va="center", transform=panel.transAxes)
        panel.set_xticks([])
        panel.set_yticks([])


def _legends(panels: Any, models: Mapping[str, TireParameters], loads: Sequence[float]) -> None:
    from matplotlib.lines import Line2D

    colours = [Line2D([], [], color=colour_of(i), label=f"{load:,.0f} N") for i, load in enumerate(loads)]
    panels[0].legend(handles=colours, title="normal load", fontsize=8, title_fontsize=8)
    if len(models) > 1:
        lines = [
            Line2D([], [], color="black", ls=line, label=name)
            for line, name in zip(_LINES, models, strict=False)
        ]
        panels[3].legend(handles=lines, fontsize=8, loc="lower right")


def _caption(models: Mapping[str, TireParameters], camber: float) -> str:
    first = next(iter(models.values()))
    at = [f"camber {np.degrees(camber):.3g} deg"]
    if all(model.family == 6 for model in models.values()) and len(models) == 1:
        at.append(f"nominal pressure {first.value('NOMPRES') / 1e3:.4g} kPa")
    text = f"Pure slip, {', '.join(at)}; signs and axes as in the file (ISO W for most)."
    if len(models) > 1:
        lines = ", ".join(f"{name} {word}" for word, name in zip(_LINE_WORDS, models, strict=False))
        text += f" Lines: {lines}."
    return f"{text} Vertical lines mark the loads of the other panels."
