"""Figures of the report: where and when recording and model differ, before and after."""

from __future__ import annotations

import io
import re
from typing import Any

import matplotlib
import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure, FigureBase

from tire_pipeline.channels import SHOWN_UNITS, SLIP_OF_FORCE, TANGENTIAL_FORCES, axis_label, unit_of
from tire_pipeline.mismatch.report.contents import ReportContents
from tire_pipeline.mismatch.report.words import short_equation
from tire_pipeline.pages.drawing import captioned, svg_element

_BEFORE, _AFTER, _SHADE = "#D55E00", "#0072B2", "#F0E442"
_NO_DATA = "#D4D4D4"
"""Behind the map: a cell without a mean is not one without a difference, which is white."""
_FEWEST_OF_A_CELL = 3
"""Samples of a cell with a mean."""
_CANCELS = "What differs in both directions within a cell cancels in its mean."
_HEIGHT_OF_A_BAR = 0.05
_MARKED_POINTS = 600
_STEPS_OF_GAP = 5.0
"""Usual steps without a sample after which a curve over time is broken."""
_NOTICED = 1.1
"""Ratio of two noises from which a reader sees that they differ."""
_LEAST_SLIP = 0.002
"""Range of slip, rad or 1, from which a map over it says something."""
_REPORT_STYLE: Any = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.alpha": 0.25,
    "svg.fonttype": "none",
    "svg.hashsalt": "mismatch",
}


def svg(figure: Any) -> Markup:
    """Return a figure as inline SVG without an XML header."""
    buffer = io.StringIO()
    with matplotlib.rc_context(_REPORT_STYLE):
        figure.savefig(buffer, format="svg", metadata={"Date": None})
    text = re.sub(r'width="[^"]+pt" height="[^"]+pt"', 'class="figure"', buffer.getvalue(), count=1)
    return svg_element(text)


def time_line(report: ReportContents, output: str, figure: FigureBase | None = None) -> FigureBase:
    """Draw recorded minus simulated force over time, before and after, effects' windows shaded."""
    s = report.series
    with matplotlib.rc_context(_REPORT_STYLE):
        figure = Figure(figsize=(9.0, 2.9), layout="constrained") if figure is None else figure
        axes = figure.subplots()
        x = s["time"] if s["time"] is not None else np.arange(s[f"before_{output}"].size)
        barred = [e for e in report.effects if e.output == output and e.when]
        for number, effect in enumerate(barred):
            top = 1.0 - _HEIGHT_OF_A_BAR * number
            for k, (a, b) in enumerate(effect.when):
                axes.axvspan(
                    a,
                    b,
                    ymin=top - _HEIGHT_OF_A_BAR,
                    ymax=top,
                    color=f"C{number + 2}",
                    lw=0,
                    label=effect.name.replace("_", " ") if k == 0 else None,
                )
        floor = s[f"floor_{output}"]
        axes.axhspan(-floor, floor, color="#A0A0A0", alpha=0.6, lw=0, label="noise (1 sigma)")
        few = x.size < _MARKED_POINTS
        look: Any = {"lw": 0.9 if few else 0.5, "marker": "." if few else None, "rasterized": True}
        axes.plot(*_broken(x, s[f"before_{output}"]), color=_BEFORE, label="before", **look)
        if _changes(report, output):
            axes.plot(*_broken(x, s[f"after_{output}"]), color=_AFTER, label="after", **look)
        low, high = axes.get_ylim()
        axes.set_ylim(low, low + (high - low) / (1.0 - _HEIGHT_OF_A_BAR * len(barred)))  # bars hide no peak
        axes.set_xlabel("time (s)" if s["time"] is not None else "point")
        axes.set_ylabel(_difference(output))
        legend = axes.legend(loc="upper center", bbox_to_anchor=(0.5, 1.18), ncol=6, frameon=False)
        for line in legend.get_lines():
            line.set_linewidth(2.0)  # the curves are too thin to show their colour
    return figure


def _broken(x: Any, y: Any) -> tuple[Any, Any]:
    """Put NaN where the recording has a gap, so that no line runs over it."""
    steps = np.diff(x)
    gaps = 1 + np.flatnonzero(steps > _STEPS_OF_GAP * np.median(steps)) if steps.size else np.empty(0, int)
    return np.insert(x.astype(float), gaps, np.nan), np.insert(y.astype(float), gaps, np.nan)


def operating_map(report: ReportContents, output: str, figure: FigureBase | None = None) -> FigureBase:
    """Draw the mean difference over slip and load, before and after, on one colour scale."""
    s = report.series
    slip = _slip(report, output)
    name = SLIP_OF_FORCE[output]
    factor = SHOWN_UNITS[name].factor
    small = float(np.max(s["normal_load"])) < 100.0
    load = s["normal_load"] if small else s["normal_load"] / 1e3
    kinds = ["before"] + (["after"] if _changes(report, output) else [])
    points = slip.size < _MARKED_POINTS
    maps: list[Any] = []
    edges = (
        np.linspace(slip.min() * factor, slip.max() * factor + 1e-9, 25),
        np.linspace(load.min(), load.max() + 1e-9, 9),
    )
    for kind in kinds:
        values = s[f"{kind}_{output}"]
        maps.append(values if points else _means(slip * factor, load, values, edges))
    limit = max(float(np.nanmax(np.abs(maps[0]), initial=0.0)), s[f"floor_{output}"])
    colours: Any = {"cmap": "RdBu_r", "vmin": -limit, "vmax": limit, "rasterized": True}
    with matplotlib.rc_context(_REPORT_STYLE):
        figure = Figure(figsize=(9.2, 2.9), layout="constrained") if figure is None else figure
        axes = np.atleast_1d(figure.subplots(1, len(kinds), sharey=True))
        for ax, kind, values in zip(axes, kinds, maps, strict=True):
            if points:
                mesh: Any = ax.scatter(
                    slip * factor, load, c=values, s=28, edgecolors="#888888", linewidths=0.4, **colours
                )
            else:
                mesh = ax.pcolormesh(*edges, values.T, **colours)
                ax.set_facecolor(_NO_DATA)
            ax.set_title(kind)
            ax.set_xlabel(axis_label(name))
            ax.grid(False)
        axes[0].set_ylabel("normal load (N)" if small else "normal load (kN)")
        figure.colorbar(mesh, ax=axes, label=_difference(output))
    return figure


def _changes(report: ReportContents, output: str) -> bool:
    """Whether an output is drawn with what was found, too: a moment with its equation, forces without one."""
    if output in TANGENTIAL_FORCES:
        return bool(report.corrected.changes)
    return bool(np.any(report.series[f"after_{output}"] != report.series[f"before_{output}"]))


def _difference(output: str) -> str:
    return f"{output.capitalize()} recorded - simulated ({unit_of(output)})"


def _slip(report: ReportContents, output: str) -> Any:
    return report.series[SLIP_OF_FORCE[output]]


def _means(x: Any, y: Any, values: Any, edges: tuple[Any, Any]) -> Any:
    """Means over the cells with enough samples."""
    count, *_ = np.histogram2d(x, y, list(edges))
    total, *_ = np.histogram2d(x, y, list(edges), weights=values)
    return np.where(count >= _FEWEST_OF_A_CELL, total / np.maximum(count, 1), np.nan)


def overview(report: ReportContents) -> Figure:
    """Draw the output that differs most: over slip and load, and over time."""
    output = _order(report)[0]
    mapped = np.ptp(_slip(report, output)) > _LEAST_SLIP
    captions = [_map_caption(report, output)] if mapped else []
    captions.append(_time_caption(report, output))
    with matplotlib.rc_context(_REPORT_STYLE):
        figure = Figure(figsize=(9.2, 3.2 * len(captions)), layout="constrained")
        parts = figure.subfigures(len(captions), 1, hspace=0.05, squeeze=False).ravel()
    time_line(report, output, parts[-1])
    if mapped:
        operating_map(report, output, parts[0])
    for part, caption in zip(parts, captions, strict=True):
        captioned(part, caption)
    return figure


def _map_caption(report: ReportContents, output: str) -> str:
    points = _slip(report, output).size < _MARKED_POINTS
    faded = "; it should fade from before to after" if _changes(report, output) else ""
    cancels = "" if points else f" Grey: fewer than {_FEWEST_OF_A_CELL} samples. {_CANCELS}"
    return (
        f"{output.capitalize()} over slip and load: recorded minus simulated, "
        f"{'each point' if points else 'mean of each cell'}. Strong colour marks where they "
        f"differ{faded}.{cancels}{_repaired(report)}"
    )


def _order(report: ReportContents) -> list[str]:
    """Outputs with series, those that differ most first."""
    return sorted(
        (o for o in report.fit if f"before_{o}" in report.series),
        key=lambda o: -report.fit[o].rms_before / max(report.series[f"floor_{o}"], 1e-9),
    )


def drawings(report: ReportContents) -> list[dict[str, Any]]:
    """Return the figures of a report as inline SVG with captions, the outputs that differ most first."""
    order = _order(report)
    out = []
    for o in order:
        if np.ptp(_slip(report, o)) > _LEAST_SLIP:
            out.append(
                {
                    "svg": svg(operating_map(report, o)),
                    "caption": _map_caption(report, o),
                }
            )
        out.append({"svg": svg(time_line(report, o)), "caption": _time_caption(report, o)})
    return out


def unnamed_curve(report: ReportContents) -> Markup | None:
    """Draw the residual over the first factor of the equation for unnamed physics, beside the equation."""
    curve = report.unnamed.curve
    if report.unnamed.physics is None or not curve:
        return None
    with matplotlib.rc_context(_REPORT_STYLE):
        figure = Figure(figsize=(9.0, 2.9), layout="constrained")
        axes = figure.subplots()
        axes.plot(curve["x"], curve["left"], "o", ms=3.5, color=_BEFORE, label="unexplained residual")
        axes.plot(curve["x"], curve["fitted"], color=_AFTER, label="equation")
        axes.set_xlabel(short_equation(curve["label"]))
        output = curve["output"]
        along = "along the force" if output in TANGENTIAL_FORCES else "along what it acts on"
        axes.set_ylabel(f"{output.capitalize()} {along} ({unit_of(output)})")
        axes.legend(frameon=False)
    return svg(figure)


def _has_gaps(report: ReportContents) -> bool:
    time = report.series["time"]
    return bool(_broken(time, time)[0].size > time.size)


def _time_caption(report: ReportContents, output: str) -> str:
    name = output.capitalize()
    if report.series["time"] is None:
        return f"{name} over the points in their order.{_repaired(report)}"
    bars = any(effect.when for effect in report.effects if effect.output == output)
    said = " The bars at the top say when each effect is above the noise." if bars else ""
    broken = " Lines break where nothing was recorded." if _has_gaps(report) else ""
    return (
        f"{name} over time.{said}{broken} What lies within the grey band is noise.{_repaired(report)}"
        f"{_cleaned(report, output)}"
    )


def _repaired(report: ReportContents) -> str:
    """Say that what is drawn is smaller than the errors in the table, which are of the rows as recorded."""
    channels = [name for name, factor in report.corrected.factors.items() if factor != 1.0]
    if not channels:
        return ""
    return (
        f" Drawn with the unit or sign of {', '.join(channels)} set right. In the table, the error before is "
        "that of the recording as it is."
    )


def _cleaned(report: ReportContents, output: str) -> str:
    """Say why the noise that is drawn is smaller than that of the table, which is of the rows as recorded."""
    if not report.fit[output].noise_floor > _NOTICED * report.series[f"floor_{output}"]:
        return ""
    return (
        " Drawn with the inputs as the fit used them, without their sensor noise and averaged where the rate "
        "is high. The errors in the table are those of the recording as it is, so their noise is larger."
    )
