"""The summary in plain words."""

from __future__ import annotations

from collections.abc import Sequence

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.locate import Located
from tire_pipeline.mismatch.report import EffectReport, GaussianForm, OutputFit, Remainder

_UNITS = {
    "slip_angle": (57.29578, "deg", "slip angle"),
    "camber": (57.29578, "deg", "camber"),
    "normal_load": (1e-3, "kN", "load"),
    "speed": (1.0, "m/s", "speed"),
    "pressure": (1e-5, "bar", "pressure"),
    "tread_temperature": (1.0, "degC", "tread temperature"),
    "slip_ratio": (1.0, "", "slip ratio"),
    "time": (1.0, "s", "time"),
}


def shown(axis: str, value: float) -> str:
    """Return a value of an axis in the unit that engineers use."""
    factor, unit, _ = _UNITS.get(axis, (1.0, "", axis))
    return f"{value * factor:.3g} {unit}".strip()


def label(axis: str) -> str:
    """Return the name of an axis in words."""
    return _UNITS.get(axis, (1.0, "", axis))[2]


def interval(axis: str, low: float, high: float) -> str:
    """Return ``load 2.1 to 4.3 kN``."""
    factor, unit, name = _UNITS.get(axis, (1.0, "", axis))
    return f"{name} {low * factor:.3g} to {high * factor:.3g} {unit}".strip()


def gaussian(form: GaussianForm) -> str:
    """Return a Gaussian process in a sentence."""
    lengths = []
    for name, length in form.lengths.items():
        channel = name.removeprefix("rate of ")
        factor, unit, text = _UNITS.get(channel, (1.0, "", channel))
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
) -> str:
    """Return the report in a few sentences."""
    parts = []
    if verdict == "agrees":
        floors = ", ".join(
            f"{o.capitalize()} {f.rms_before:.0f} N (noise {f.noise_floor:.0f} N)" for o, f in fit.items()
        )
        return (
            "Simulation and recording agree: what differs is no larger than noise and the "
            "misfit that a fitted "
            f"tire model always has. RMS difference: {floors}."
        )
    if located:
        parts.append(_where(located))
    if effects:
        names = " and ".join(e.title for e in effects)
        physics = [e for e in effects if e.kind == "physics"]
        lead = "Left out of the model" if len(physics) == len(effects) else "Found"
        if not physics:
            lead = "Wrong in the recording"
        parts.append(f"{lead}: {names}.")
        if fit:
            o, f = max(fit.items(), key=lambda t: t[1].rms_before ** 2 - t[1].rms_after ** 2)
            parts.append(
                f"With it the error of {o.capitalize()} falls from {f.rms_before:.0f} N to "
                f"{f.rms_after:.0f} N on sweeps "
                f"left out of the fit; noise is {f.noise_floor:.0f} N."
            )
        for e in effects:
            if e.alternatives:
                others = " or ".join(catalogue()[a].title for a in e.alternatives)
                parts.append(f"This recording cannot exclude {others} instead of {e.title}.")
    if remainder.significant:
        sizes = ", ".join(f"{o.capitalize()} {s:.0f} N" for o, s in remainder.size.items())
        lead = "Something else is left" if effects else "No effect in the catalogue explains it"
        parts.append(f"{lead} ({sizes} RMS above noise); it gets no name.")
        if remainder.located:
            f0 = remainder.located[0]
            parts.append(
                f"It is clearest in {f0.output.capitalize()} at {interval(f0.axis, f0.low, f0.high)}."
            )
    if next_experiment:
        parts.append(next_experiment)
    return " ".join(parts)


def _where(located: Sequence[Located]) -> str:
    """First sentence: where recorded and simulated force differ most."""
    along = [f for f in located if f.along_force] or list(located)
    output = max(along, key=lambda f: abs(f.mean)).output
    own = [f for f in along if f.output == output][:3]
    where = ", ".join(interval(f.axis, f.low, f.high) for f in own)
    best = max(own, key=lambda f: abs(f.mean))
    if best.along_force and abs(best.share) > 0.002:
        word = "lower" if best.mean < 0.0 else "higher"
        return (
            f"At {where}, {output.capitalize()} is up to {abs(best.share) * 100:.2g}% {word} than the model."
        )
    return f"At {where}, {output.capitalize()} differs from the model by {best.mean:+.0f} N on average."
