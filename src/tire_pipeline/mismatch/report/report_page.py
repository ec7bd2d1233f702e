"""The report as one HTML page without any outside reference."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import asdict
from importlib.resources import files
from typing import Any

from markupsafe import Markup

from tire_pipeline.channels import unit_of
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.amounts import amount
from tire_pipeline.mismatch.model.channels import CHANCE
from tire_pipeline.mismatch.proof.locate import Located
from tire_pipeline.mismatch.proof.measured import Visible
from tire_pipeline.mismatch.report.contents import EffectReport, ReportContents
from tire_pipeline.mismatch.report.figures import drawings, unnamed_curve
from tire_pipeline.mismatch.report.words import (
    condition,
    gaussian,
    in_words,
    interval,
    same_decimals,
    short_equation,
)
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedReport
from tire_pipeline.mismatch.unnamed_physics.language.grammar import parse
from tire_pipeline.mismatch.unnamed_physics.language.symbols import MEANING
from tire_pipeline.pages.drawing import page_style
from tire_pipeline.pages.safe_page import page_environment, policy

_NOMINAL_UNITS = {"F0": "N", "R0": "m", "V0": "m/s", "P0": "Pa", "T0": "degC"}
_TOO_LITTLE = {"does not pay for itself": "too little evidence for its parameters"}


def render(report: ReportContents, *, pages: Sequence[tuple[str, str]] = ()) -> str:
    """Return the page.

    Parameters
    ----------
    report : ReportContents
    pages : sequence of (str, str)
        Address and name of other pages, for links at the top.
    """
    environment = page_environment("tire_pipeline.mismatch.report")
    own = files("tire_pipeline.mismatch.report").joinpath("templates", "report.css").read_text("utf-8")
    style = page_style() + own
    environment.filters |= {"number": number, "percent": percent, "log_evidence": log_evidence}
    environment.filters |= {"condition": condition, "short_equation": short_equation, "to": range_of}
    environment.filters["unit_of"] = unit_of
    errors = [(o, f) for o, f in report.fit.items() if math.isfinite(f.rms_before)]
    seen, silent = _visible(report.visible)
    name = ", ".join(report.recordings) or "Simulation and recording"
    return environment.get_template("report.html").render(
        report=report,
        title=f"{name}: {report.stated_verdict}",
        name=name,
        pages=pages,
        footer="",
        style=Markup(style),
        policy=policy(style=style, figures=True),
        drawings=drawings(report),
        errors=errors,
        conditions=any(f.held_out_condition for _, f in errors),
        effects=[_effect(e) for e in report.effects],
        located=_located(report),
        gaussian=[gaussian(f) for f in report.remainder.gaussian],
        candidates=[_candidate(c) for c in report.candidates],
        next_experiment=in_words(report.next_experiment),
        visible=seen,
        silent=silent,
        unnamed=report.unnamed if report.unnamed.looked_for and report.verdict != "agrees" else None,
        chance=f"{CHANCE:.0%}",
        unnamed_symbols=_symbols(report.unnamed),
        unnamed_figure=unnamed_curve(report),
    )


def _symbols(found: UnnamedReport) -> list[tuple[str, str]]:
    """Symbols of an unnamed equation and of those as good, what they mean, and the nominal values in them."""
    if found.physics is None:
        return []
    each = [found.physics.equations, *(other.equations for other in found.alternatives)]
    texts = [text for equations in each for text in equations.values()]
    used = frozenset(found.physics.ranges).union(*(parse(text).symbols for text in texts))
    told = [
        (symbol, MEANING[symbol]) for symbol in MEANING if symbol in used and symbol not in _NOMINAL_UNITS
    ]
    words = {*used, *re.findall(r"\w+", " ".join(meaning for _, meaning in told))}
    nominal = asdict(found.physics.nominal)
    return told + [
        (name, f"{nominal[name]:,.6g} {unit}") for name, unit in _NOMINAL_UNITS.items() if name in words
    ]


def number(value: Any, digits: int = 3) -> str:
    """Return a number with few digits, a dash for nothing."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    if isinstance(value, float):
        return f"{value:,.0f}" if abs(value) >= 10**digits else f"{value:.{digits}g}"
    return str(value)


def range_of(low: float, high: float) -> str:
    """Return ``52.9 to 60.0``."""
    return " to ".join(same_decimals(low, high))


def log_evidence(value: float | str | None) -> str:
    """Return a log evidence, a dash for none."""
    return f"{value:.1f}" if isinstance(value, float) and math.isfinite(value) else "–"


def percent(share: float) -> str:
    """Return a share of something, a dash where it is none or more than all of it."""
    if not 0.0 < abs(share) <= 1.0:
        return "–"
    size = f"{abs(100.0 * share):#.2g}".rstrip(".") if abs(share) < 0.995 else "100"
    return f"{'-' if share < 0.0 else ''}{size}%"


def _located(report: ReportContents) -> list[tuple[str, str, float, str, float, float]]:
    """One row for each output and axis: the stretch with the largest difference."""
    rows: dict[tuple[str, str], Any] = {}
    for f in report.located:
        rows.setdefault((f.output, f.axis), f)
    return [
        (f.output, interval(f.axis, f.low, f.high), f.mean, _way(f), f.share, f.p_value)
        for f in list(rows.values())[:8]
    ]


def _way(place: Located) -> str:
    """The way in which the force differs."""
    if not place.along_force:
        return "off to one side"
    return "smaller" if place.mean < 0.0 else "larger"


def _effect(effect: EffectReport) -> dict[str, Any]:
    looks = catalogue()[effect.name].looks_like
    return {
        "it": effect,
        "certainty": certainty_of(effect),
        "parameters": effect.rows(),
        "where": [interval(a, low, high) for a, (low, high) in effect.where.items()],
        "when": [f"{a:.1f} to {b:.1f} s" for a, b in effect.when[:12]],
        "more": max(0, len(effect.when) - 12),
        "looks": [
            (catalogue()[n].title, n, looks.get(n) or catalogue()[n].looks_like.get(effect.name, ""))
            for n in effect.alternatives
        ],
        "evidence": _evidence(effect.evidence),
    }


def certainty_of(effect: EffectReport) -> str:
    """The certainty of the name, and its share of the error."""
    text = f"Probability {'over 99%' if effect.confidence > 0.995 else f'{effect.confidence:.0%}'}"
    if effect.alternatives:
        text += " that it is this or one of its alternatives"
    removed = _removed(effect.share)
    if removed:
        text += f"; {removed} on sweeps that its fit has not seen, mostly in {effect.output.capitalize()}"
    return f"{text}."


def _removed(share: float) -> str:
    """What an effect does to the squared error, in words; nothing if it was found without a fit."""
    if not math.isfinite(share):
        return ""
    if share > 1.0:
        return "without it the other effects leave a larger error than there was before"
    if share < -1.0:
        return "beside the other effects it leaves a larger error than there was before"
    if share < 0.0:
        return f"it adds {percent(-share)} to the squared error"
    return f"it removes {percent(share) if share else 'none'} of the squared error"


def _evidence(evidence: dict[str, float | str]) -> str:
    """The evidence that a reader needs; the JSON has all of it."""
    if "log_evidence" not in evidence:
        return in_words(str(evidence.get("found", "")))
    return f"Log evidence {log_evidence(evidence['log_evidence'])} above the best explanation without it"


def _candidate(row: dict[str, Any]) -> dict[str, Any]:
    why = _TOO_LITTLE.get(row["why"], row["why"])
    kind = "physics" if row["kind"] == "physics" else "recording"
    return {**row, "title": catalogue()[row["name"]].title, "kind": kind, "why": in_words(why)}


def _visible(rows: list[Visible]) -> tuple[list[dict[str, Any]], list[tuple[str, list[str]]]]:
    """Rows with sizes, and the titles of effects about which nothing can be said, by reason."""
    sized: list[dict[str, Any]] = []
    silent: dict[str, list[str]] = {}
    for row in rows:
        title = catalogue()[row.name].title
        sizes = [amount(x, row.unit) if math.isfinite(x) else "–" for x in (row.ruled_out, row.seen)]
        if row.parameter and sizes[0] != sizes[1]:
            sized.append({"it": row, "title": title, "ruled_out": sizes[0], "seen": sizes[1]})
        elif not row.text.startswith(f"{title}: named"):
            why = row.text.removeprefix(f"{title} ({row.parameter}): ").removeprefix(f"{title}: ")
            silent.setdefault(why.rstrip("."), []).append(title)
    return sized, list(silent.items())
