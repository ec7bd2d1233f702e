"""Where recording and model differ, in a clause of the report's head."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from tire_pipeline.channels import SLIP_AND_LOAD
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.proof.locate import Located, Throughout
from tire_pipeline.mismatch.proof.measured import OutputFit, Remainder
from tire_pipeline.mismatch.report.contents import EffectReport
from tire_pipeline.mismatch.report.words import ends, newtons, place
from tire_pipeline.pages.first_letter import first_large

_FEW_STRETCHES = 3
"""More stretches of time are not listed in the summary; the report has them all."""

MORE_THAN_HALF = 0.5
_HARDLY = 0.2
"""What is most of the time or of the mismatch, and below which part of its RMS a mean difference shows hardly
anything of it."""

_AS_MUCH = 0.4
"""Part of the first place's mean difference from which a stretch of another channel is worth a sentence."""
_WHOLE = 99.5
"""Percent: what would be rounded to the whole force."""

Ranges = Mapping[str, tuple[float, float]]
"""Time and each channel that varies -> lowest and highest recorded value, SI."""


def stretches_of(effect: EffectReport, ranges: Ranges) -> str:
    """Return ``between 25 and 65 s``; empty if that is most of the time, or many stretches.

    An effect that a channel drives has no stretches of its own: they show how the rig was run.
    """
    if _drivers(effect, ranges):
        return ""
    first, last = ranges.get("time", (0.0, 0.0))
    shows = sum(b - a for a, b in effect.when)
    if not 0 < len(effect.when) <= _FEW_STRETCHES or shows > MORE_THAN_HALF * (last - first):
        return ""
    return "between " + ", ".join("{} and {} s".format(*ends("time", a, b)) for a, b in effect.when)


def spot_of(
    effects: Sequence[EffectReport],
    fit: dict[str, OutputFit],
    located: Sequence[Located],
    remainder: Remainder,
    ranges: Ranges,
    even: Mapping[str, Throughout],
) -> str:
    """Where they differ; nothing if an exact fault of the recording is all there is."""
    exact = bool(effects) and not any(np.isfinite(e.share) for e in effects)
    if not located or (exact and not remainder.significant):
        return ""
    if any(np.isfinite(e.share) for e in effects) and fit:  # the place and the error are of one force
        located = [f for f in located if f.output == corrected_most(fit)] or located
    throughout = max(located, key=lambda f: abs(f.mean)).output in even
    own = _of_slip_and_load(located) if throughout else _of_the_effects(effects, located, ranges)
    both = _to_both_sides(effects, fit, located, ranges)
    return both or (_where(own, ranges, even) if own else _where_the_effects_are(effects, ranges))


def corrected_most(fit: Mapping[str, OutputFit]) -> str:
    """Return the force of which most of the squared error goes."""
    return max(fit, key=lambda o: fit[o].rms_before ** 2 - fit[o].rms_after ** 2)


def _of_the_effects(
    effects: Sequence[EffectReport], located: Sequence[Located], ranges: Ranges
) -> Sequence[Located]:
    """Return the places on axes of which a named effect covers a part only.

    Other axes merely varied with them: a tread warms up in each sweep, so an effect of camber is also found
    at some tread temperature.
    """
    axes = {axis for effect in effects for axis in _drivers(effect, ranges) or _narrow_axes(effect, ranges)}
    if axes:
        return [f for f in located if f.axis in axes]
    return _of_slip_and_load(located) if effects else located


def _of_slip_and_load(located: Sequence[Located]) -> Sequence[Located]:
    """Return the places on the axes that every force depends on, if there are any; else all.

    What is off throughout is largest where the force is. The load is stepped in time and warms the tread.
    """
    return [f for f in located if f.axis in SLIP_AND_LOAD] or located


def on_placeless(effects: Sequence[EffectReport], ranges: Ranges) -> str:
    """Say which effects have no place of their own beside others that have one; "" if there are none.

    Parameters
    ----------
    effects : sequence of EffectReport
    ranges : mapping
        Axis -> (lowest, highest) recorded, SI.
    """
    fitted = [effect for effect in effects if effect.where]
    everywhere = [e for e in fitted if not (_drivers(e, ranges) or _narrow_axes(e, ranges))]
    if not everywhere or len(everywhere) == len(fitted):
        return ""
    titles = " and ".join(effect.title for effect in everywhere)
    have, their, act = ("have", "their", "they act") if len(everywhere) > 1 else ("has", "its", "it acts")
    return (
        f"{first_large(titles)} {have} no place of {their} own: {act} over at least half of the "
        "recorded range of every channel."
    )


def _drivers(effect: EffectReport, ranges: Ranges) -> list[str]:
    """Return the channels that decide how much of an effect there is, those of them that vary."""
    return [axis for axis in catalogue()[effect.name].drivers(effect.output) if axis in ranges]


def _narrow_axes(effect: EffectReport, ranges: Ranges) -> list[str]:
    """Return the axes of which an effect covers a part only: what drives it, if that varies.

    Else the time, if the effect is seen in a part of it or follows the clock, and of the channels that it may
    depend on the one of which it covers the least. A sensor that follows the clock depends on none: loads and
    cambers are stepped in time, so a drift is largest at those that were recorded last.
    """
    drivers, cause = _drivers(effect, ranges), catalogue()[effect.name]
    if cause.by_clock and cause.kind == "artefact":
        return ["time"] if "time" in ranges else []
    depends_on = drivers or (*SLIP_AND_LOAD, *cause.used)
    parts = {
        axis: (high - low) / (ranges[axis][1] - ranges[axis][0])
        for axis, (low, high) in effect.where.items()
        if axis in depends_on and axis in ranges and ranges[axis][1] > ranges[axis][0]
    }
    narrow = [axis for axis, part in parts.items() if part < MORE_THAN_HALF and part == min(parts.values())]
    return (["time"] if cause.by_clock or stretches_of(effect, ranges) else []) + narrow[:1]


def _to_both_sides(
    effects: Sequence[EffectReport], fit: dict[str, OutputFit], located: Sequence[Located], ranges: Ranges
) -> str:
    """Say where the force differs, if one effect makes most of it and no mean of a stretch shows it.

    A camber to both sides adds to the force and takes from it: what is then clearest is next to nothing.
    """
    main = max(effects, key=lambda e: e.share if np.isfinite(e.share) else 0.0, default=None)
    if main is None or not main.share > MORE_THAN_HALF or main.output not in fit:
        return ""
    means = [abs(f.mean) for f in located if f.output == main.output]
    spots = _where_it_is(main, ranges)
    if not spots or max(means, default=0.0) > _HARDLY * fit[main.output].rms_before:
        return ""
    return f"{main.output.capitalize()} differs most {spots}, to both sides"


def _where_the_effects_are(effects: Sequence[EffectReport], ranges: Ranges) -> str:
    """Say where the named effects change a force, if no sure mean shows them."""
    said = [
        f"{effect.title} changes {effect.output.capitalize()} {spots}"
        for effect in effects
        if (spots := _where_it_is(effect, ranges))
    ]
    return " and ".join(said)


def _where_it_is(effect: EffectReport, ranges: Ranges) -> str:
    """The stretches of time and of the channel that hold an effect; empty if it is everywhere."""
    return ", ".join(
        stretches_of(effect, ranges) if axis == "time" else place(axis, *effect.where[axis], ranges)
        for axis in _narrow_axes(effect, ranges)
    )


def _where(located: Sequence[Located], ranges: Ranges, even: Mapping[str, Throughout]) -> str:
    """Where recorded and simulated force differ most."""
    top = max(located, key=lambda f: abs(f.mean))
    output = top.output
    own = [f for f in located if f.output == output and f.along_force == top.along_force]
    own = [f for f in own if f is top or _as_well(f, top)]
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
    if output in even:
        share = even[output].share
        if not np.isfinite(share):
            return f"{name} differs from the model by {even[output].mean:+,.3g} N throughout"
        word = "lower" if share < 0.0 else "higher"
        most = f"most in newtons {where}: {newtons(abs(best.mean))} N"
        size = abs(share) * 100
        much = f"{size:.2g}%" if size < _WHOLE else "at least 100%"
        return f"{name} is {much} {word} than the model throughout ({most})"
    much = _of_the_force(best.share)
    if best.along_force:
        word = "lower" if best.mean < 0.0 else "higher"
        return f"{where}, {name} is on average {newtons(abs(best.mean))} N ({much}) {word} than the model"
    sign = "-" if best.mean < 0.0 else "+"
    return f"{where}, {name} differs from the model by {sign}{newtons(abs(best.mean))} N on average ({much})"


def _as_well(place: Located, top: Located) -> bool:
    """Whether a stretch of another axis adds information about the same difference."""
    return place.mean * top.mean > 0.0 and min(place.own, 1.0) * abs(place.mean) > _AS_MUCH * abs(top.mean)


def _of_the_force(share: float) -> str:
    """A mean difference as a part of the force there, in words."""
    if not np.isfinite(share):
        return "where the force is small"
    size = abs(share) * 100
    return f"{size:.2g}% of the force there" if size < _WHOLE else "more than the force there"
