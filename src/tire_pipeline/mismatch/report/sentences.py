"""The report in three sentences: the verdict and its names, where and how much, and what to do next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from tire_pipeline.channels import TANGENTIAL_FORCES
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.proof.locate import Located, Throughout
from tire_pipeline.mismatch.proof.measured import OutputFit, Remainder
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.mismatch.report.contents import EffectReport, Head, HeldOutFit
from tire_pipeline.mismatch.report.equation_words import of_equation, on_unnamed
from tire_pipeline.mismatch.report.words import figure, in_words, listed, newtons, place
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedReport

_FEW_STRETCHES = 3
"""More stretches of time are not listed in the summary; the report has them all."""

_RIVALS_LISTED = 3
"""So many explanations are named where each would do."""

_HALF = 0.5
_HARDLY = 0.2
"""What is most of the time or of the mismatch, and below which part of its RMS a mean difference shows hardly
anything of it."""

_TRY_IT = "Next, test the corrected model on another recording before you use it."
_RECORD_AGAIN = "Next, correct the recording at its source and explain it again."
_SAID_IF_UNDECIDED = (
    "undecided: no cause stands out, and I can't tell a coarse fit or rig from a cause that this recording "
    "does not show"
)
_EITHER = "a fault of the recording or something that the model leaves out"
_NOTHING_TO_DO = "There is nothing to correct; the page lists the effects that this recording rules out."

Ranges = Mapping[str, tuple[float, float]]


def head(
    verdict: str,
    effects: Sequence[EffectReport],
    fit: dict[str, OutputFit],
    located: Sequence[Located],
    remainder: Remainder,
    next_experiment: str,
    ranges: Ranges | None = None,
    even: Mapping[str, Throughout] | None = None,
    unnamed: UnnamedReport | None = None,
    rivals: Sequence[Sequence[str]] = (),
) -> Head:
    """Return the head of a report.

    Parameters
    ----------
    verdict, effects, fit, located, remainder, next_experiment, unnamed
        Of the report.
    ranges : mapping, optional
        Axis -> (lowest, highest) recorded, SI, to say "above" and "below" where a stretch ends there.
    even : mapping, optional
        Output -> how it is off throughout.
    rivals : sequence of sequence of str
        Sets of effects of which one is the answer, where no name stands out.
    """
    fit = _forces(fit)
    if verdict == "agrees":
        return _agreement(fit)
    ranges = ranges or {}
    if verdict == "undecided":
        causes, size = _SAID_IF_UNDECIDED, _undecided(fit, remainder)
    else:
        causes = _causes(verdict, effects, remainder, ranges, rivals)
        size = _size(effects, fit) or of_equation(unnamed)
    return Head(
        causes=causes,
        spot=_spot(effects, fit, located, remainder, ranges, even or {}),
        size=size,
        todo=_next(effects, next_experiment),
        notes=tuple(filter(None, [_more_left(remainder) if effects else ""])),
        equation=on_unnamed(unnamed, verdict, rivals),
    )


def on_question(question: Question, told: Head) -> Head:
    """Return a head that puts an open question first.

    Parameters
    ----------
    question : Question
        If nothing can be explained before it is settled, it is all that is said.
    told : Head
        What was found all the same.
    """
    todo = f"Next, {question.todo[:1].lower()}{question.todo[1:]}; no corrected file is written until then."
    if question.verdict:
        return Head(question.why, todo=todo)
    return replace(told, causes=f"open: {question.why}; as it was read: {told.causes}", todo=todo)


def with_held_out(told: Head, fit: HeldOutFit, effects: Sequence[EffectReport]) -> Head:
    """Return a head with what the held-out recording says, and what to do next in view of it.

    Parameters
    ----------
    told : Head
        Without it.
    fit : HeldOutFit
    effects : sequence of EffectReport
    """
    size = "; ".join(filter(None, [told.size, _on_held_out(fit)]))
    open_still = told.todo not in ("", _TRY_IT)
    return replace(told, size=size, todo=told.todo if open_still or not effects else _next_after(fit))


def without_equation(
    told: Head, verdict: str, effects: Sequence[EffectReport], fit: Mapping[str, OutputFit]
) -> Head:
    """Return a head without an equation that did not hold.

    Parameters
    ----------
    told : Head
    verdict, effects
        Of the report.
    fit : mapping of str to OutputFit
        Errors without the equation.
    """
    size = told.size if verdict == "undecided" else _size(effects, _forces(fit))
    return replace(told, size=size, equation="")


def _forces(fit: Mapping[str, OutputFit]) -> dict[str, OutputFit]:
    return {o: f for o, f in fit.items() if o in TANGENTIAL_FORCES}


def _next_after(fit: HeldOutFit) -> str:
    errors = fit.errors.values()
    if any(e.ratio_low > 1.0 for e in errors):
        return (
            f"Next, find out what differs between {fit.recording} and the explained recordings (tire, wear, "
            "rig set-up) before you use the corrected model."
        )
    if any(e.ratio_high < 1.0 for e in errors):
        return "Next, use the corrected model within the ranges of the explained recordings."
    return (
        f"Next, keep the model as it is for recordings like {fit.recording}: the correction gains nothing "
        "there."
    )


def _on_held_out(fit: HeldOutFit) -> str:
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
    return f"in {fit.recording}, which was held out, the RMS error of {', that of '.join(parts)}"


def _agreement(fit: Mapping[str, OutputFit]) -> Head:
    sizes = ", ".join(
        f"{o.capitalize()} {newtons(f.rms_before)} N (noise {newtons(f.noise_floor)} N)"
        for o, f in fit.items()
    )
    return Head(
        "simulation and recording agree: what differs is no larger than noise and the misfit that a fitted "
        "tire model always has",
        size=f"the RMS difference is {sizes}",
        todo=_NOTHING_TO_DO,
    )


def _undecided(fit: Mapping[str, OutputFit], left: Remainder) -> str:
    sizes = ", ".join(f"{o.capitalize()} {newtons(f.rms_before)} N" for o, f in fit.items())
    return (
        f"the RMS difference is {sizes}, and what neither noise nor a smooth misfit of the formula accounts "
        f"for {_than_usual(left)}"
    )


def _more_left(left: Remainder) -> str:
    """Say that more is left beside names than fitted models usually leave."""
    if left.significant or not left.unusual:
        return ""
    return f"The remaining residual {_than_usual(left)}: more may be missing."


def _than_usual(left: Remainder) -> str:
    errors = ", ".join(f"{o.capitalize()} {share:.1%}" for o, share in left.unusual.items())
    low, high = left.usual
    return (
        f"({errors} of the largest force) is more than fitted models usually leave ({low:.1%} to {high:.1%})"
    )


def _causes(
    verdict: str,
    effects: Sequence[EffectReport],
    remainder: Remainder,
    ranges: Ranges,
    rivals: Sequence[Sequence[str]],
) -> str:
    """The verdict, the causes, and the unexplained residual."""
    left = _what_is_left(remainder, ranges)
    if not effects and rivals:
        sets = [" with ".join(catalogue()[n].title for n in names) for names in rivals[:_RIVALS_LISTED]]
        sets += ["others"] if len(rivals) > len(sets) else []
        return f"I can't tell which of these explains the difference{left}: {listed(sets)}"
    if not effects:
        return f"I can't tell: no effect of the catalogue explains the difference{left}"
    physics, faults, either = (
        [_cause(e, ranges) for e in effects if _kinds(e) == kinds]
        for kinds in ({"physics"}, {"artefact"}, {"physics", "artefact"})
    )
    parts = []
    if physics:
        parts.append(f"from {' and '.join(physics)}, which the model leaves out")
    if faults:
        fault = "a fault" if len(faults) == 1 else "faults"
        parts.append(f"from {' and '.join(faults)}, {fault} of the recording")
    if either:
        parts.append(f"from {' and '.join(either)}: {_EITHER}")
    text = f"{verdict}: the difference comes {', and '.join(parts)}"
    return f"{text}; an unexplained residual remains{left}" if remainder.significant else text


def _kinds(effect: EffectReport) -> set[str]:
    """Kinds of an effect and of what cannot be excluded instead of it."""
    return {effect.kind, *(catalogue()[a].kind for a in effect.alternatives)}


def _what_is_left(remainder: Remainder, ranges: Ranges) -> str:
    """Size and place of the unexplained residual in brackets; nothing where neither is known."""
    sizes = ", ".join(f"{o.capitalize()} {newtons(s)} N" for o, s in remainder.size.items() if s > 0.0)
    said = [f"{sizes} RMS above noise"] if sizes else []
    if remainder.located:
        f = remainder.located[0]
        said.append(f"clearest in {f.output.capitalize()} {place(f.axis, f.low, f.high, ranges)}")
    return f" ({', '.join(said)})" if said and remainder.significant else ""


def _cause(effect: EffectReport, ranges: Ranges) -> str:
    """The effect, what cannot be excluded instead of it, and when it shows if that is part of the time."""
    names = [effect.title, *(catalogue()[a].title for a in effect.alternatives)]
    stretches = _stretches(effect, ranges)
    apart = "this recording cannot tell them apart" if effect.alternatives else ""
    seen = f"seen {stretches}" if stretches else ""
    said = "; ".join(filter(None, [seen, apart]))
    together = listed(names)
    return f"{together} ({said})" if said else together


def _stretches(effect: EffectReport, ranges: Ranges) -> str:
    """Return ``between 25 and 65 s``, or nothing where that is most of the time or many stretches."""
    first, last = ranges.get("time", (0.0, 0.0))
    shows = sum(b - a for a, b in effect.when)
    if not 0 < len(effect.when) <= _FEW_STRETCHES or shows > _HALF * (last - first):
        return ""
    return "between " + ", ".join(f"{figure('time', a)} and {figure('time', b)} s" for a, b in effect.when)


def _spot(
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
    return _to_both_sides(effects, fit, located, ranges) or _where(located, ranges, even)


def _size(effects: Sequence[EffectReport], fit: dict[str, OutputFit]) -> str:
    """The error before and after, beside the noise."""
    if not effects or not fit:
        return ""
    lead = "with that corrected"
    if any(np.isfinite(e.share) for e in effects):
        o, f = max(fit.items(), key=lambda t: t[1].rms_before ** 2 - t[1].rms_after ** 2)
        goes = "falls" if f.rms_after < f.rms_before else "goes"
        return (
            f"{lead}, the RMS error of {o.capitalize()} over all held-out sweeps {goes} from "
            f"{newtons(f.rms_before)} N to {newtons(f.rms_after)} N (noise {newtons(f.noise_floor)} N)"
        )
    sizes = ", ".join(
        f"{o.capitalize()} {newtons(f.rms_after)} N (noise {newtons(f.noise_floor)} N)"
        for o, f in fit.items()
    )
    return f"{lead}, the RMS difference is {sizes}"


def _next(effects: Sequence[EffectReport], experiment: str) -> str:
    if experiment:
        return f"Next, {in_words(f'{experiment[:1].lower()}{experiment[1:]}')}"
    if not effects:
        return ""
    return _RECORD_AGAIN if all(_kinds(e) == {"artefact"} for e in effects) else _TRY_IT


def _to_both_sides(
    effects: Sequence[EffectReport], fit: dict[str, OutputFit], located: Sequence[Located], ranges: Ranges
) -> str:
    """Say when the force differs, if one effect makes most of it and no mean of a stretch shows it.

    A camber to both sides adds to the force and takes from it: what is then clearest is next to nothing.
    """
    main = max(effects, key=lambda e: e.share if np.isfinite(e.share) else 0.0, default=None)
    if main is None or not main.share > _HALF or main.output not in fit:
        return ""
    means = [abs(f.mean) for f in located if f.output == main.output]
    stretches = _stretches(main, ranges)
    if not stretches or max(means, default=0.0) > _HARDLY * fit[main.output].rms_before:
        return ""
    return f"{main.output.capitalize()} differs most {stretches}, to both sides"


def _where(located: Sequence[Located], ranges: Ranges, even: Mapping[str, Throughout]) -> str:
    """Where recorded and simulated force differ most."""
    top = max(located, key=lambda f: abs(f.mean))
    output = top.output
    own = [f for f in located if f.output == output and f.along_force == top.along_force]
    own = [f for f in own if f.mean * top.mean > 0.0 and min(f.own, 1.0) * abs(f.mean) > 0.4 * abs(top.mean)]
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
        return f"{name} is {abs(share) * 100:.2g}% {word} than the model throughout ({most})"
    much = _of_the_force(best.share)
    if best.along_force:
        word = "lower" if best.mean < 0.0 else "higher"
        return f"{where}, {name} is on average {newtons(abs(best.mean))} N ({much}) {word} than the model"
    sign = "-" if best.mean < 0.0 else "+"
    return f"{where}, {name} differs from the model by {sign}{newtons(abs(best.mean))} N on average ({much})"


def _of_the_force(share: float) -> str:
    """A mean difference as a part of the force there, in words."""
    if not np.isfinite(share):
        return "where the force is small"
    size = abs(share) * 100
    return f"{size:.2g}% of the force there" if size < 99.5 else "more than the force there"
