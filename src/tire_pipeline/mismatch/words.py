"""The summary in plain words."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np

from tire_pipeline.mismatch.effects import Effect, catalogue
from tire_pipeline.mismatch.locate import Located
from tire_pipeline.mismatch.report import EffectReport, GaussianForm, HeldOutFit, OutputFit, Remainder

_UNITS = {
    "slip_angle": (57.29578, "deg", "slip angle"),
    "camber": (57.29578, "deg", "camber"),
    "normal_load": (1e-3, "kN", "load"),
    "speed": (1.0, "m/s", "speed"),
    "pressure": (1e-5, "bar", "pressure"),
    "tread_temperature": (1.0, "degC", "tread temperature"),
    "slip_ratio": (1.0, "", "slip ratio"),
    "turn_slip": (1.0, "1/m", "path curvature"),
    "time": (1.0, "s", "time"),
}


_FINEST = {"slip_angle": 5e-5, "camber": 5e-5, "slip_ratio": 1e-4}
"""What is smaller is written as 0, SI: no rig holds it."""

_FEW_STRETCHES = 3
"""More stretches of time are not listed in the summary; the report has them all."""

_MOST = 0.5
_HARDLY = 0.2
"""What is most of the time or of the mismatch, and below which part of its RMS a mean difference shows hardly
anything of it."""


def unit_of(axis: str, size: float) -> tuple[float, str, str]:
    """Return factor, unit and name of an axis; loads below 100 N (model cars) are shown in N."""
    if axis == "normal_load" and abs(size) < 100.0:
        return 1.0, "N", "load"
    return _UNITS.get(axis, (1.0, "", axis.replace("_", " ")))


def shown(axis: str, value: float) -> str:
    """Return a value of an axis in the unit that engineers use."""
    return f"{figure(axis, value)} {unit_of(axis, value)[1]}".strip()


def figure(axis: str, value: float, size: float | None = None) -> str:
    """Return a value of an axis without its unit, which is that for values of some size."""
    factor = unit_of(axis, value if size is None else size)[0]
    return "0" if abs(value) < _FINEST.get(axis, 0.0) else f"{value * factor:.3g}"


_AMOUNTS = {
    "1": (100.0, "%"),
    "rad": (57.29578, "deg"),
    "s": (1e3, "ms"),
    "rad/N": (57.29578e3, "deg/kN"),
    "rad/rad": (1.0, "deg/deg"),
}


def amount(value: float, unit: str) -> str:
    """Return the size of a parameter in the unit that engineers use."""
    factor, name = _AMOUNTS.get(unit, (1.0, unit))
    return f"{value * factor:.2g} {name}"


def label(axis: str) -> str:
    """Return the name of an axis in words."""
    return _UNITS.get(axis, (1.0, "", axis))[2]


def interval(axis: str, low: float, high: float) -> str:
    """Return ``load 2.1 to 4.3 kN``."""
    size = max(abs(low), abs(high))
    _, unit, name = unit_of(axis, size)
    return f"{name} {figure(axis, low, size)} to {figure(axis, high, size)} {unit}".strip()


def gaussian(form: GaussianForm) -> str:
    """Return a Gaussian process in a sentence."""
    lengths = []
    for name, length in form.lengths.items():
        channel = name.removeprefix("rate of ")
        factor, unit, text = unit_of(channel, length)
        per = "/s" if name != channel else ""
        lead = f"rate of {text}" if per else text
        lengths.append(f"{lead} ({length * factor:.2g} {unit}{per})".replace(" )", ")").replace("( ", "("))
    share = (
        "" if form.explained != form.explained else f"; it predicts {100.0 * max(form.explained, 0.0):.0f}%"
    )
    where = ", ".join(lengths)
    low = form.explained < 0.2
    return (
        f"{form.output.capitalize()}: {newtons(form.size)} N, changing with {where}{share}"
        + (" of what is left on sweeps that its fit has not seen" if share else "")
        + (": it depends on something that is not recorded, or lives in time as well" if low else "")
    )


def newtons(value: float) -> str:
    """Return a force with as many digits as it deserves."""
    return f"{value:,.0f}" if abs(value) >= 20.0 else f"{value:.2g}"


def summary(
    verdict: str,
    effects: Sequence[EffectReport],
    fit: dict[str, OutputFit],
    located: Sequence[Located],
    remainder: Remainder,
    next_experiment: str,
    ranges: Mapping[str, tuple[float, float]] | None = None,
    even: Mapping[str, float] | None = None,
) -> str:
    """Return the report in a few sentences.

    Parameters
    ----------
    verdict, effects, fit, located, remainder, next_experiment
        Of the report.
    ranges : mapping, optional
        Axis -> (lowest, highest) recorded, SI, to say "above" and "below" where a stretch ends there.
    even : mapping, optional
        Output -> share of the force by which it is off throughout.
    """
    fit = {o: f for o, f in fit.items() if o in ("fx", "fy")}
    if verdict == "agrees":
        return _agreement(fit)
    ranges = ranges or {}
    exact = bool(effects) and not any(np.isfinite(e.share) for e in effects)
    parts = []
    if located and not (exact and not remainder.significant):
        parts = [_to_both_sides(effects, fit, located, ranges) or _where(located, ranges, even or {})]
    if effects:
        parts += _cause(effects, fit, ranges)
    parts += [_doubt(e) for e in effects if e.alternatives]
    if remainder.significant:
        parts += _left(bool(effects), remainder, ranges)
    if next_experiment:
        parts.append(in_words(next_experiment))
    return " ".join(parts)


def on_held_out(fit: HeldOutFit) -> str:
    """Return how the explained model predicts a recording that was held out, in a sentence."""
    parts = []
    for output, error in fit.errors.items():
        unit = "N m" if output.startswith("m") else "N"
        sizes = f"from {newtons(error.rms_before)} {unit} to {newtons(error.rms_after)} {unit}"
        if error.ratio_high < 1.0:
            parts.append(f"{output.capitalize()} falls {sizes}")
        elif error.ratio_low > 1.0:
            parts.append(f"{output.capitalize()} rises {sizes}: what was found does not hold there")
        else:
            parts.append(f"{output.capitalize()} is about the same as before ({sizes})")
    return f"In {fit.recording}, which was held out, the RMS error of {', that of '.join(parts)}."


def in_words(text: str) -> str:
    """Return a text with the titles of effects in place of their names."""
    names = sorted(catalogue(), key=len, reverse=True)
    return re.sub(rf"\b({'|'.join(n for n in names if '_' in n)})\b", lambda m: catalogue()[m[1]].title, text)


def condition(text: str) -> str:
    """Return ``|slip angle| above 4.2 deg`` from ``|slip_angle| above 0.0735 rad``."""
    found = re.fullmatch(r"\|(\w+)\| above (\S+) \S+", text)
    if found is None:
        return text
    value = float(found[2])
    return f"|{label(found[1])}| above {shown(found[1], value)}"


def not_looked_for(absent: Mapping[str, str]) -> str:
    """Return in one sentence what could not be looked for, by reason; nothing if that is nothing.

    Parameters
    ----------
    absent : mapping
        Name of an effect -> why the fit leaves it out. What is looked for without a fit is not among these.
    """
    by_reason: dict[str, list[str]] = {}
    for name, why in absent.items():
        if type(catalogue()[name]).detect is Effect.detect:
            by_reason.setdefault(why, []).append(catalogue()[name].title)
    reasons = [f"{', '.join(titles)} ({why})" for why, titles in by_reason.items()]
    return f"could not be looked for: {'; '.join(reasons)}" if reasons else ""


def _agreement(fit: dict[str, OutputFit]) -> str:
    sizes = ", ".join(
        f"{o.capitalize()} {newtons(f.rms_before)} N (noise {newtons(f.noise_floor)} N)"
        for o, f in fit.items()
    )
    return (
        "Simulation and recording agree: what differs is no larger than noise and the misfit that a fitted "
        f"tire model always has. RMS difference: {sizes}."
    )


def _cause(
    effects: Sequence[EffectReport], fit: dict[str, OutputFit], ranges: Mapping[str, tuple[float, float]]
) -> list[str]:
    """What was left out or is wrong, and what it brings."""
    physics = [e.title + _while(e, ranges) for e in effects if e.kind == "physics"]
    artefacts = [e.title + _while(e, ranges) for e in effects if e.kind != "physics"]
    parts = []
    if physics:
        parts.append(f"Left out of the model: {' and '.join(physics)}.")
    if artefacts:
        parts.append(f"Wrong in the recording: {' and '.join(artefacts)}.")
    if fit and any(np.isfinite(e.share) for e in effects):
        o, f = max(fit.items(), key=lambda t: t[1].rms_before ** 2 - t[1].rms_after ** 2)
        it = "it" if len(effects) == 1 else "them"
        goes = "falls" if f.rms_after < f.rms_before else "goes"
        parts.append(
            f"With {it} the error of {o.capitalize()} {goes} from {newtons(f.rms_before)} N to "
            f"{newtons(f.rms_after)} N on sweeps left out of the fit of the parameters; noise is "
            f"{newtons(f.noise_floor)} N."
        )
    elif fit:
        sizes = ", ".join(
            f"{o.capitalize()} {newtons(f.rms_after)} N (noise {newtons(f.noise_floor)} N)"
            for o, f in fit.items()
        )
        parts.append(f"With that set right the difference is {sizes} RMS.")
    return parts


def _while(effect: EffectReport, ranges: Mapping[str, tuple[float, float]]) -> str:
    """Return `` (seen between 25 and 65 s)`` for an effect above the noise less than half of the time."""
    stretches = _stretches(effect, ranges)
    return f" (seen {stretches})" if stretches else ""


def _stretches(effect: EffectReport, ranges: Mapping[str, tuple[float, float]]) -> str:
    """Return ``between 25 and 65 s``, or nothing where that is most of the time or many stretches."""
    first, last = ranges.get("time", (0.0, 0.0))
    shows = sum(b - a for a, b in effect.when)
    if not 0 < len(effect.when) <= _FEW_STRETCHES or shows > _MOST * (last - first):
        return ""
    return "between " + ", ".join(f"{figure('time', a)} and {figure('time', b)} s" for a, b in effect.when)


def _to_both_sides(
    effects: Sequence[EffectReport],
    fit: dict[str, OutputFit],
    located: Sequence[Located],
    ranges: Mapping[str, tuple[float, float]],
) -> str:
    """Say when the force differs, if one effect makes most of it and no mean of a stretch shows it.

    A camber to both sides adds to the force and takes from it: what is then clearest is next to nothing.
    """
    main = max(effects, key=lambda e: e.share if np.isfinite(e.share) else 0.0, default=None)
    if main is None or not main.share > _MOST or main.output not in fit:
        return ""
    means = [abs(f.mean) for f in located if f.output == main.output]
    stretches = _stretches(main, ranges)
    if not stretches or max(means, default=0.0) > _HARDLY * fit[main.output].rms_before:
        return ""
    return f"{main.output.capitalize()} differs most {stretches}, to both sides."


def _doubt(effect: EffectReport) -> str:
    others = " or ".join(catalogue()[a].title for a in effect.alternatives)
    return f"{others[:1].upper()}{others[1:]} cannot be excluded instead of {effect.title}."


def _left(named: bool, remainder: Remainder, ranges: Mapping[str, tuple[float, float]]) -> list[str]:
    sizes = ", ".join(f"{o.capitalize()} {newtons(s)} N" for o, s in remainder.size.items())
    lead = "Something else is left" if named else "No effect of the catalogue explains it"
    parts = [f"{lead} ({sizes} RMS above noise); it gets no name."]
    if remainder.located:
        f = remainder.located[0]
        parts.append(f"It is clearest in {f.output.capitalize()} {place(f.axis, f.low, f.high, ranges)}.")
    return parts


def place(axis: str, low: float, high: float, ranges: Mapping[str, tuple[float, float]]) -> str:
    """Return ``between 41 and 96 s``, ``at load above 4 kN``, ``at slip angle below -2 deg``."""
    size = max(abs(low), abs(high))
    _, unit, name = unit_of(axis, size)
    a, b = figure(axis, low, size), figure(axis, high, size)
    lowest, highest = ranges.get(axis, (-np.inf, np.inf))
    near = 0.03 * (highest - lowest) if np.isfinite(highest - lowest) else 0.0
    if axis == "time":
        return f"between {a} and {b} s"
    if high >= highest - near and low > lowest + near:
        return f"at {name} above {a} {unit}".rstrip()
    if low <= lowest + near and high < highest - near:
        return f"at {name} below {b} {unit}".rstrip()
    return f"at {name} between {a} and {b} {unit}".rstrip()


def _where(
    located: Sequence[Located], ranges: Mapping[str, tuple[float, float]], even: Mapping[str, float]
) -> str:
    """First sentence: where recorded and simulated force differ most."""
    along = [f for f in located if f.along_force] or list(located)
    output = max(along, key=lambda f: abs(f.mean)).output
    own = [f for f in along if f.output == output]
    top = max(own, key=lambda f: abs(f.mean))
    own = [f for f in own if f.mean * top.mean > 0.0 and abs(f.mean) > 0.4 * abs(top.mean)]
    own = sorted(own, key=lambda f: -abs(f.mean))[:2]
    spots = [place(f.axis, f.low, f.high, ranges) for f in own]
    spots = [
        s.removeprefix("at ") if i and spots[i - 1].startswith("at ") else s for i, s in enumerate(spots)
    ]
    times = spots[0] + ", " if own[0].axis == "time" and len(spots) > 1 else ""
    rest = spots[1:] if times else spots
    where = times + " and ".join(rest)
    best = max(own, key=lambda f: abs(f.mean))
    name = output.capitalize()
    lead = f"{where[:1].upper()}{where[1:]}, {name}"
    if output in even:
        word = "lower" if even[output] < 0.0 else "higher"
        most = f"most in newtons {where}: {newtons(abs(best.mean))} N"
        return f"{name} is {abs(even[output]) * 100:.2g}% {word} than the model throughout ({most})."
    if best.along_force and abs(best.share) > 0.002:
        word = "lower" if best.mean < 0.0 else "higher"
        size = abs(best.share) * 100
        return (
            f"{lead} is up to {size:.2g}% {word} than the model."
            if size < 99.5
            else (f"{lead} is up to {newtons(abs(best.mean))} N {word} than the model.")
        )
    return f"{lead} differs from the model by {best.mean:+,.3g} N on average."
