"""Several recordings of one tire explained together, with one held out to test the explanation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import INPUT_CHANNELS
from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.corrected.apart import Apart, apart, in_words
from tire_pipeline.mismatch.corrected.as_recorded import without_unnamed
from tire_pipeline.mismatch.corrected.model import CorrectedModel
from tire_pipeline.mismatch.each_run import check_conventions, check_copies
from tire_pipeline.mismatch.effects.shared import INDEPENDENT_STRETCHES
from tire_pipeline.mismatch.explainer import Explainer
from tire_pipeline.mismatch.model.residual import rms, root_ratio_interval
from tire_pipeline.mismatch.recording.given import SPIKES, usable_numbers
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.mismatch.report.contents import HeldOutFit, PredictionError
from tire_pipeline.mismatch.report.headline.sentences import (
    on_each,
    on_question,
    with_held_out,
    without_equation,
)
from tire_pipeline.mismatch.report.result import MismatchReport
from tire_pipeline.recordings.conventions.canonical import notes_beside_assumed
from tire_pipeline.recordings.conventions.plausible import implausible_radii
from tire_pipeline.recordings.join import check_missing, join_recordings

Array = np.ndarray


def explain_recordings(
    tire: Any,
    recordings: Mapping[str, pd.DataFrame],
    *,
    held_out: str | None = None,
    explainer: Explainer | None = None,
) -> MismatchReport:
    """Explain recordings of one tire together.

    What is found has to hold for all of them: a friction that differs between two of them is not a friction
    of the tire. See :func:`tire_pipeline.recordings.join_recordings` for what may be joined.

    Parameters
    ----------
    tire : TireModel or None
        As for :func:`explain_mismatch`.
    recordings : mapping of str to DataFrame
        Name -> canonical columns in SI, in the order they were recorded in.
    explainer : Explainer, optional
        Searches for the effects; by default as :func:`explain_mismatch` does.
    held_out : str, optional
        The name of the recording that is left out of the explanation. The explained model predicts it, and
        ``report.held_out`` has the errors before and after.

    Returns
    -------
    MismatchReport
        ``recordings`` names those that were explained, and ``each`` has the errors in each of several.
        ``notes`` says which channels were left out. ``held_out`` is None where that one cannot be predicted
        (a channel is missing): ``head.remarks`` says why.

    Raises
    ------
    RecordingError
        They cannot be joined or explained; one is a copy of another one, or in other units or axes; the one
        to hold out is unknown or the only one.

    See Also
    --------
    explain_mismatch : One recording.
    tire_pipeline.recordings.join_recordings : Joins them.

    Notes
    -----
    No fit sees the held-out recording. The interval of its errors resamples independent stretches of it
    (Politis and Romano, "The stationary bootstrap", 1994, with stretches of fixed length).

    Examples
    --------
    Two runs on which the tire has 10% less cornering stiffness than its file says:

    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.tir import read_tir
    >>> tire = read_tir("tire.tir")
    >>> softer = tire.replace(LKY=0.9)
    >>> slip_angle = np.tile(np.linspace(-0.15, 0.15, 100), 2)
    >>> rig = pd.DataFrame({"slip_angle": slip_angle, "normal_load": np.repeat([3000.0, 5000.0], 100)})
    >>> rig["fy"] = softer.forces(slip_angle=rig["slip_angle"], normal_load=rig["normal_load"]).fy
    >>> rig["fy"] += np.random.default_rng(0).normal(0.0, 20.0, len(rig))
    >>> again = rig.assign(fy=rig["fy"] + np.random.default_rng(1).normal(0.0, 20.0, len(rig)))
    >>> report = explain_recordings(tire, {"first": rig, "second": again}, held_out="second")
    >>> report.recordings, report.held_out.recording
    (('first',), 'second')
    """
    if held_out is not None and held_out not in recordings:
        raise RecordingError(
            f"there is no recording {held_out!r} to hold out",
            todo=f"name one of {', '.join(recordings)}",
        )
    explained = {name: usable_numbers(frame) for name, frame in recordings.items() if name != held_out}
    if not explained:
        raise RecordingError("the only recording is held out", todo="pass another one to explain")
    if len(recordings) > 1:
        _check(tire, recordings)
    if len(explained) == 1:
        ((name, joined),) = explained.items()
        notes = [f"{name}: {said}" for said in notes_beside_assumed(joined)] if held_out is not None else []
    else:
        joined = join_recordings(explained)
        notes = notes_beside_assumed(joined)
        notes += [
            f"{name}: {said}" for name, each in explained.items() for said in each.attrs.get(SPIKES, [])
        ]
    try:
        report = (explainer or Explainer()).explain(tire, joined)
    except RecordingError as error:
        where = ", ".join(filter(None, [*explained, error.where]))
        raise RecordingError(error.what, where=where, todo=error.todo) from error
    notes = [*notes, *report.notes, *implausible_radii(recordings)]
    report = replace(report, recordings=tuple(explained), notes=notes)
    if held_out is not None:
        known = {said for frame in explained.values() for said in _as_read(frame)}
        own = [said for said in _as_read(recordings[held_out]) if said not in known]
        report.notes.extend(f"{held_out}, held out: {said}" for said in own)
        report = _tested(report, recordings[held_out], held_out)
    if len(explained) == 1:
        return report
    each = errors_of_each(report.corrected, joined)
    noise = {o: f.noise_floor for o, f in report.fit.items()}
    report = replace(report, each=each, head=report.head.beside(on_each(each, noise)))
    return _asked(report, apart(report.corrected, joined))


def _asked(report: MismatchReport, odd: Sequence[Apart]) -> MismatchReport:
    """Return the report with the question why some recordings differ from the others, before what it found.

    What one has alone, such as a gain of its load cell, is in no way what the model leaves out.
    """
    if not odd or report.corrected.question is not None:
        return report
    names = " and ".join(dict.fromkeys(each.recording for each in odd))
    question = Question(
        "; ".join(in_words(each) for each in odd),
        f"check what is different in {names} (load cell, set-up, surface, another tire), and explain what "
        "differs by itself",
        "unexplained" if report.verdict in ("agrees", "undecided") else "",
        short="recordings differ",
    )
    return replace(
        report,
        verdict=question.verdict or report.verdict,
        corrected=replace(report.corrected, question=question),
        head=on_question(question, report.head),
    )


def _tested(report: MismatchReport, recording: pd.DataFrame, name: str) -> MismatchReport:
    """Return the report with the errors in a held-out recording; without, where it cannot be predicted."""
    try:
        report = _equation_held(report, recording, name)
        tried = predict_held_out(report.corrected, recording, name)
    except RecordingError as error:  # what was found in the others holds all the same
        why = f"{name}, which was held out, tests nothing: {error.what}."
        return replace(report, head=report.head.beside(why))
    return replace(report, held_out=tried, head=with_held_out(report.head, tried, report.effects))


def _check(tire: Any, recordings: Mapping[str, pd.DataFrame]) -> None:
    """Refuse, before anything long is computed, what would be explained as physics or is not unseen."""
    check_missing(recordings)
    check_copies(recordings)
    if tire is not None:
        check_conventions(tire, recordings)


def _as_read(recording: pd.DataFrame) -> list[str]:
    """How a recording was read: what was assumed, and what was noted."""
    return [*recording.attrs.get("assumed", []), *notes_beside_assumed(recording)]


def errors_of_each(corrected: CorrectedModel, joined: pd.DataFrame) -> tuple[HeldOutFit, ...]:
    """Return the errors in each of the recordings that were explained together.

    Parameters
    ----------
    corrected : CorrectedModel
    joined : DataFrame
        Of :func:`tire_pipeline.recordings.join_recordings`: heat, wear and drift go on from one to the next.

    Notes
    -----
    Their forces were used to find the effects: a correction that holds lowers the error of each.
    """
    after, before = corrected.predict(joined), _plain(corrected).predict(joined)
    rows = {part["name"]: slice(part["first"], part["last"] + 1) for part in joined.attrs["joined"]}
    return tuple(
        HeldOutFit(name, *_errors(joined.iloc[own], before.iloc[own], after.iloc[own]))
        for name, own in rows.items()
    )


def _plain(corrected: CorrectedModel) -> CorrectedModel:
    """The model without what was found, as it predicts what is recorded."""
    return replace(corrected, changes=(), instead=(), unnamed=None)


def _errors(
    recorded: pd.DataFrame, before: pd.DataFrame, after: pd.DataFrame
) -> tuple[int, dict[str, PredictionError]]:
    """Samples in which anything can be compared, and errors of each output that was recorded."""
    errors, compared = {}, np.zeros(len(recorded), bool)
    for n in [n for n in after.columns if n in recorded]:
        left = [
            recorded[n].to_numpy(dtype=float) - frame[n].to_numpy(dtype=float) for frame in (before, after)
        ]
        good = np.isfinite(left[0]) & np.isfinite(left[1])
        if good.any():
            errors[n] = _error(*(x[good] for x in left))
            compared |= good
    return int(compared.sum()), errors


def _equation_held(report: MismatchReport, recording: pd.DataFrame, name: str) -> MismatchReport:
    """Return the report, without its equation where that predicts a held-out recording no better."""
    found, equation = report.unnamed, report.corrected.unnamed
    if equation is None:
        return report
    named = replace(report.corrected, unnamed=None)
    with_it, plain = (predict_held_out(m, recording, name).errors for m in (report.corrected, named))
    outputs = [o for o in equation.equations if o in with_it]
    if all(with_it[o].rms_after < plain[o].rms_after for o in outputs):
        return report
    fit = without_unnamed(report.fit, found)
    return replace(
        report,
        corrected=named,
        fit=fit,
        unnamed=found.refused(f"it predicts {name}, which was held out, no better"),
        head=without_equation(report.head, report.verdict, report.effects, fit),
    )


def predict_held_out(corrected: CorrectedModel, recording: pd.DataFrame, name: str) -> HeldOutFit:
    """Predict a recording that no fit has seen, with the model as it was and with what was found.

    Parameters
    ----------
    corrected : CorrectedModel
    recording : DataFrame
        Canonical columns in SI, with the forces.
    name : str

    Returns
    -------
    HeldOutFit

    Raises
    ------
    RecordingError
        It lacks a channel that the model needs, or holds none of the forces that were explained.

    Notes
    -----
    Both predictions put in signs and units that were found to be wrong in the explained recordings, so that
    the difference is due to the effects. Wear and heat start from zero in this recording; a drift and a
    change of surface are left out, unless its clock is that of the explained recordings. The interval
    resamples independent stretches of the recording.
    """
    usable = _finite(usable_numbers(recording))
    after = corrected.predict(usable)
    _, errors = _errors(usable, _plain(corrected).predict(usable), after)
    if not errors:
        raise RecordingError(
            f"{name} has none of the forces that were explained ({', '.join(after.columns)})",
            where=name,
            todo="hold out another recording",
        )
    return HeldOutFit(name, len(usable), errors)


def _finite(recording: pd.DataFrame) -> pd.DataFrame:
    needed = [c for c in ("time", *INPUT_CHANNELS) if c in recording]
    rows = np.isfinite(recording[needed].to_numpy(dtype=float)).all(axis=1)
    if not rows.any():
        raise RecordingError("no sample has numbers in all channels", todo="drop the columns without numbers")
    return recording[rows]


def _error(before: Array, after: Array) -> PredictionError:
    stretch = np.arange(before.size) * INDEPENDENT_STRETCHES // before.size
    squares = [np.bincount(stretch, x**2, INDEPENDENT_STRETCHES) for x in (after, before)]
    return PredictionError(rms(before), rms(after), *root_ratio_interval(*squares))
