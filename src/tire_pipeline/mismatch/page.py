"""The report as one HTML page without any outside reference."""

from __future__ import annotations

import math
from typing import Any

import jinja2

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.figures import drawings
from tire_pipeline.mismatch.report import MismatchReport, Visible
from tire_pipeline.mismatch.words import amount, condition, gaussian, interval


def render(report: MismatchReport) -> str:
    """Return the page.

    Parameters
    ----------
    report : MismatchReport
    """
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("tire_pipeline.mismatch"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters["number"] = number
    environment.filters["condition"] = condition
    return environment.get_template("report.html").render(
        report=report,
        drawings=drawings(report),
        effects=[_effect(e) for e in report.effects],
        located=_located(report),
        gaussian=[gaussian(f) for f in report.remainder.gaussian],
        candidates=[_candidate(c) for c in report.candidates],
        visible=[_seen(v) for v in report.visible],
    )


def _located(report: MismatchReport) -> list[tuple[str, str, float, float, float]]:
    """One row for each output and axis: the stretch along the force before the one of plain differences."""
    rows: dict[tuple[str, str], Any] = {}
    for f in sorted(report.located, key=lambda f: not f.along_force):
        rows.setdefault((f.output, f.axis), f)
    order = [f for f in report.located if rows[f.output, f.axis] is f]
    return [(f.output, interval(f.axis, f.low, f.high), f.mean, f.share, f.p_value) for f in order[:8]]


def number(value: Any, digits: int = 3) -> str:
    """Return a number with few digits, a dash for nothing."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    if isinstance(value, float):
        return f"{value:,.0f}" if abs(value) >= 10**digits else f"{value:.{digits}g}"
    return str(value)


def _effect(effect: Any) -> dict[str, Any]:
    looks = catalogue()[effect.name].looks_like
    return {
        "it": effect,
        "where": [interval(a, low, high) for a, (low, high) in effect.where.items()],
        "when": [f"{a:.1f} to {b:.1f} s" for a, b in effect.when[:12]],
        "more": max(0, len(effect.when) - 12),
        "looks": [
            (n, looks.get(n) or catalogue()[n].looks_like.get(effect.name, "")) for n in effect.alternatives
        ],
    }


def _candidate(row: dict[str, Any]) -> dict[str, Any]:
    return {**row, "title": catalogue()[row["name"]].title}


def _seen(row: Visible) -> dict[str, Any]:
    """Return a row of what could have been seen: sizes in words where there are any."""
    sizes = [amount(x, row.unit) if math.isfinite(x) else "–" for x in (row.ruled_out, row.seen)]
    title = catalogue()[row.name].title
    return {
        "it": row,
        "title": title,
        "ruled_out": sizes[0],
        "seen": sizes[1],
        "why": row.text.removeprefix(f"{title}: "),
    }
