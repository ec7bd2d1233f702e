"""The report in three sentences: the verdict and its names, where and how much, and what to do next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from tire_pipeline.channels import PLANE_FORCES, TANGENTIAL_FORCES, unit_of
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.shared import lengths_in_words
from tire_pipeline.mismatch.model.residual import rms
from tire_pipeline.mismatch.proof.locate import Located, Throughout
from tire_pipeline.mismatch.proof.measured import OutputFit, Remainder
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.mismatch.report.contents import EffectReport, Head, HeldOutFit
from tire_pipeline.mismatch.report.headline.equation_words import of_equation, on_unnamed
from tire_pipeline.mismatch.report.headline.spots import (
    MORE_THAN_HALF,
    Ranges,
    corrected_most,
    on_placeless,
    spot_of,
    stretches_of,
)
from tire_pipeline.mismatch.report.words import in_words, listed, newtons, place
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedReport
from tire_pipeline.pages.first_letter import first_small

_RIVALS_LISTED = 3
"""The number of explanations that are named if each would do."""

_TRY_IT = "Next, test the corrected model on another recording before you use it."
_RECORD_MORE = "Next, record more sweeps where it shows: then it can be proved, and corrected."
_RECORD_AGAIN = "Next, correct the recording at its source and explain it again."
_SAID_IF_UNDECIDED = (
    "no cause stands out, and I can't tell a coarse fit or rig from a cause that this recording does not show"
)
_NO_NAME = "a cause that the catalogue does not have"
_EITHER = "a fault of the recording or something that the model leaves out"
_APART = "this recording cannot tell them apart"
_SEVERAL_APART = (
    'This recording cannot tell apart the causes that are joined by "or". Where a fault of the recording is '
    "among them, the model may be right."
)
_NOTHING_TO_DO = "There is nothing to correct; the page lists the effects that this recording rules out."


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
    added: bool = True,
    stated: Sequence[str] = (),
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
        Sets of effects of which one is the answer, where no name stands out. An empty one is a cause without
        a name.
    added : bool
        Whether anything of what is named is in the corrected model.
    stated : sequence of str
        Texts of findings that an open question states: they are no causes beside it.
    """
    if verdict == "agrees":
        return _agreement({o: f for o, f in fit.items() if o in PLANE_FORCES})
    fit = _forces(fit)
    ranges = ranges or {}
    if verdict == "undecided":
        causes, size = _SAID_IF_UNDECIDED, _undecided(fit, remainder)
    else:
        corrected = bool(effects and added and fit)
        partly = corrected and fit[corrected_most(fit)].recovered < MORE_THAN_HALF
        rest = [e for e in effects if e.evidence.get("found") not in stated]
        causes = _causes(rest, remainder, ranges, rivals, partly=partly, named=bool(effects))
        size = (_size(effects, fit) if added else _as_it_is(fit)) or of_equation(unnamed)
    apart = _SEVERAL_APART if _several_open(effects) else ""
    notes = (apart, on_placeless(effects, ranges), _more_left(remainder) if effects else "")
    return Head(
        causes=causes,
        spot=spot_of(effects, fit, located, remainder, ranges, even or {}),
        size=size,
        todo=_next(effects, next_experiment, added),
        notes=tuple(filter(None, notes)),
        equation=on_unnamed(unnamed, verdict, rivals),
        verdict=verdict if effects or verdict == "undecided" else "",
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
    todo = f"Next, {question.todo}; no corrected file is written until then."
    return replace(Head("") if question.verdict else told, question=question, todo=todo)


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


def with_own_lag(
    told: Head, fit: Mapping[str, OutputFit], lengths: Mapping[str, float], left: Mapping[str, np.ndarray]
) -> Head:
    """Return a head with the error beside the relaxation that the file states, which tire.forces lacks.

    Parameters
    ----------
    told : Head
        Whose errors are without it.
    fit : mapping of str to OutputFit
    lengths : mapping of str to float
        Slip -> relaxation length that the file states, m, where the forces follow it.
    left : mapping of ndarray, shape (n,)
        Output -> residual with it and nothing else, N.
    """
    errors = {o: newtons(rms(rest)) for o, rest in left.items()}
    sizes = [f"{o.capitalize()} {e} N" for o, e in errors.items() if e != newtons(fit[o].rms_before)]
    if not lengths or not sizes:
        return told
    stated = lengths_in_words(lengths)
    lag = f"tire.forces lacks the relaxation that the file states ({stated}): with it alone the RMS error is "
    return replace(told, size="; ".join(filter(None, [told.size, f"{lag}{', '.join(sizes)}"])))


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
        f"Next, keep the model as it is for recordings like {fit.recording}: no gain of the correction is "
        "certain there."
    )


def _on_held_out(fit: HeldOutFit) -> str:
    """Return how the explained model predicts a recording that was held out, in a sentence."""
    parts = []
    for output, error in fit.errors.items():
        unit = unit_of(output)
        sizes = f"from {newtons(error.rms_before)} {unit} to {newtons(error.rms_after)} {unit}"
        if error.ratio_high < 1.0:
            parts.append(f"{output.capitalize()} falls {sizes}")
        elif error.ratio_low > 1.0:
            parts.append(f"{output.capitalize()} rises {sizes}: what was found does not hold there")
        else:
            parts.append(f"{output.capitalize()} is about the same as before ({sizes})")
    return f"in {fit.recording}, which was held out, the RMS error of {', that of '.join(parts)}"


def on_each(each: Sequence[HeldOutFit], noise: Mapping[str, float]) -> str:
    """Say in which of the recordings that were explained together the error rises by more than the noise."""
    risen = [
        f"{output.capitalize()} in {fit.recording} (from {newtons(e.rms_before)} {unit_of(output)} to "
        f"{newtons(e.rms_after)} {unit_of(output)})"
        for fit in each
        for output, e in fit.errors.items()
        if e.ratio_low > 1.0 and e.rms_after**2 - e.rms_before**2 > noise.get(output, 0.0) ** 2
    ]
    if not risen:
        return ""
    return (
        f"With what was found, the RMS error of {' and of '.join(risen)} rises: it does not hold for all "
        "recordings. Explain those in which it rises by themselves, too."
    )


def _beside_noise(fit: Mapping[str, OutputFit], *, after: bool = False) -> str:
    """RMS errors of all forces, before or after the correction, each beside its noise."""
    said = []
    for o, f in fit.items():
        unit = unit_of(o)
        noise = f" (noise {newtons(f.noise_floor)} {unit})" if np.isfinite(f.noise_floor) else ""
        said.append(f"{o.capitalize()} {newtons(f.rms_after if after else f.rms_before)} {unit}{noise}")
    return ", ".join(said)


def _agreement(fit: Mapping[str, OutputFit]) -> Head:
    return Head(
        "simulation and recording agree: what differs is no larger than noise and the misfit that a fitted "
        "tire model always has",
        size=f"the RMS difference is {_beside_noise(fit)}",
        todo=_NOTHING_TO_DO,
    )


def _undecided(fit: Mapping[str, OutputFit], left: Remainder) -> str:
    sizes = ", ".join(f"{o.capitalize()} {newtons(f.rms_before)} N" for o, f in fit.items())
    return (
        f"the RMS difference is {sizes}, and what neither noise nor a smooth misfit of the formula accounts "
        f"for {_than_usual(left)}"
    )


def _more_left(left: Remainder) -> str:
    """Say that the residual beside the names is larger than fitted models usually leave."""
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
    effects: Sequence[EffectReport],
    remainder: Remainder,
    ranges: Ranges,
    rivals: Sequence[Sequence[str]],
    *,
    partly: bool,
    named: bool,
) -> str:
    """The causes, whether they are a smaller part of it, and the unexplained residual."""
    left = _what_is_left(remainder, ranges)
    if not named and rivals:
        titles = (" with ".join(catalogue()[n].title for n in names) for names in rivals[:_RIVALS_LISTED])
        sets = [each or _NO_NAME for each in titles]
        sets += ["others"] if len(rivals) > len(sets) else []
        return f"I can't tell which of these explains the difference{left}: {listed(sets)}"
    if not named:
        return f"I can't tell: no effect of the catalogue explains the difference{left}"
    several = _several_open(effects)
    physics, faults, either = (
        [_cause(e, ranges, "" if several else _APART) for e in effects if _kinds(e) == kinds]
        for kinds in ({"physics"}, {"artefact"}, {"physics", "artefact"})
    )
    beside = ", and from " if several else " and "
    parts = []
    if physics:
        parts.append(f"from {beside.join(physics)}, which the model leaves out")
    if faults:
        fault = "a fault" if len(faults) == 1 else "faults"
        parts.append(f"from {beside.join(faults)}, {fault} of the recording")
    if either:
        parts.append(f"from {beside.join(either)}{'' if several else f': {_EITHER}'}")
    from_all = f"the difference comes {'in part ' if partly else ''}{', and '.join(parts)}" if parts else ""
    rest = f"an unexplained residual remains{left}" if remainder.significant else ""
    return "; ".join(filter(None, [from_all, rest]))


def _several_open(effects: Sequence[EffectReport]) -> bool:
    """Whether several causes have alternatives: then a note says once that they are not told apart."""
    return sum(bool(e.alternatives or e.same_to_data) for e in effects) > 1


def _kinds(effect: EffectReport) -> set[str]:
    """Kinds of an effect and of what cannot be excluded instead of it."""
    kinds = {effect.kind, *(catalogue()[a].kind for a in effect.alternatives)}
    return kinds | {kind for _, kind in effect.same_to_data}


def _what_is_left(remainder: Remainder, ranges: Ranges) -> str:
    """Size and place of the unexplained residual in brackets; nothing where neither is known."""
    sizes = ", ".join(f"{o.capitalize()} {newtons(s)} N" for o, s in remainder.size.items() if s > 0.0)
    said = [f"{sizes} RMS above noise"] if sizes else []
    if remainder.located:
        f = remainder.located[0]
        said.append(f"clearest in {f.output.capitalize()} {place(f.axis, f.low, f.high, ranges)}")
    return f" ({', '.join(said)})" if said and remainder.significant else ""


def _cause(effect: EffectReport, ranges: Ranges, not_apart: str) -> str:
    """The effect, what cannot be excluded instead of it, and when it shows if that is part of the time."""
    same = (words for words, _ in effect.same_to_data)
    names = [effect.title, *(catalogue()[a].title for a in effect.alternatives), *same]
    stretches = stretches_of(effect, ranges)
    apart = not_apart if len(names) > 1 else ""
    seen = f"seen {stretches}" if stretches else ""
    said = "; ".join(filter(None, [seen, apart]))
    together = listed(names)
    return f"{together} ({said})" if said else together


def _size(effects: Sequence[EffectReport], fit: dict[str, OutputFit]) -> str:
    """The error before and after, beside the noise."""
    if not effects or not fit:
        return ""
    lead = "with that corrected"
    if any(np.isfinite(e.share) for e in effects):
        o = corrected_most(fit)
        f = fit[o]
        goes = "falls" if f.rms_after < f.rms_before else "goes"
        return (
            f"{lead}, the RMS error of {o.capitalize()} over all held-out sweeps {goes} from "
            f"{newtons(f.rms_before)} N to {newtons(f.rms_after)} N (noise {newtons(f.noise_floor)} N)"
        )
    return f"{lead}, the RMS difference is {_beside_noise(fit, after=True)}"


def _as_it_is(fit: Mapping[str, OutputFit]) -> str:
    """Say that nothing was added, with the error that stays."""
    return (
        "no correction helps on held-out sweeps, so the model stays as it is, with an RMS error of "
        f"{_beside_noise(fit)}"
    )


def _next(effects: Sequence[EffectReport], experiment: str, added: bool) -> str:
    if experiment:
        return f"Next, {in_words(first_small(experiment))}"
    if not effects:
        return ""
    if not added:
        return _RECORD_MORE
    return _RECORD_AGAIN if all(_kinds(e) == {"artefact"} for e in effects) else _TRY_IT
