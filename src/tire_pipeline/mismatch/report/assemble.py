"""The report of one recording: effects, the corrected model, errors on unseen sweeps, what could be seen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import OPERATING_CHANNELS
from tire_pipeline.mismatch.corrected.agreed import share_agreed
from tire_pipeline.mismatch.corrected.as_recorded import as_recorded, never_worse, with_unnamed
from tire_pipeline.mismatch.corrected.going_on import going_on
from tire_pipeline.mismatch.corrected.later_sweeps import confirmed_later
from tire_pipeline.mismatch.corrected.model import CorrectedModel, force_limits
from tire_pipeline.mismatch.corrected.wheel_phase import WheelWay, way_at_each
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.analysis import Analysis, with_fit
from tire_pipeline.mismatch.inference.linearised_set import Fit
from tire_pipeline.mismatch.inference.sets.answer import LEVEL, SetAnswer
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.model.channels import CHANCE, ENOUGH_ROWS, one_sided, span
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.nominal import Reference
from tire_pipeline.mismatch.model.residual import partly, residual, rms
from tire_pipeline.mismatch.proof.held_out import made_worse, prove, prove_moments, recorded_moments
from tire_pipeline.mismatch.proof.locate import everywhere, locate
from tire_pipeline.mismatch.proof.measured import Remainder
from tire_pipeline.mismatch.proof.never_worse import Guarded, guarded
from tire_pipeline.mismatch.proof.remainder import remainder
from tire_pipeline.mismatch.proof.visible import visible
from tire_pipeline.mismatch.recording.prepare import Prepared
from tire_pipeline.mismatch.report.changed_together import (
    changed_by_itself,
    changed_together,
    on_changed_together,
)
from tire_pipeline.mismatch.report.contents import EffectReport
from tire_pipeline.mismatch.report.found_effects import from_factors, from_fit
from tire_pipeline.mismatch.report.headline.moment_words import head_of_moment, on_moment
from tire_pipeline.mismatch.report.headline.sentences import head, on_question, with_own_lag
from tire_pipeline.mismatch.report.next_experiment import next_experiment
from tire_pipeline.mismatch.report.remarks import (
    on_expected,
    on_moments,
    on_part,
    on_several,
    on_withheld,
    reasons,
    state_units,
    with_reasons,
)
from tire_pipeline.mismatch.report.result import MismatchReport
from tire_pipeline.mismatch.report.unnamed_part import (
    moment_error,
    moment_series,
    only_moment,
    put_in_equations,
)
from tire_pipeline.mismatch.report.words import not_looked_for
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedReport
from tire_pipeline.mismatch.unnamed_physics.search import instead_of_names
from tire_pipeline.progress import under_way

Array = np.ndarray
_TO_DO = {
    "undecided": "Explain a recording with more channels, or one that the model was fitted to.",
    "unexplained": "Record the same sweeps again, and then with one channel changed at a time: what repeats "
    "is the tire or the rig, and what follows a channel has found its cause.",
}
"""What to do next where no open name asks for a sweep."""


@dataclass(frozen=True)
class Explained:
    """The parts of a report.

    Parameters
    ----------
    prepared : Prepared
    analysis : Analysis
        With the set that is named.
    sets : Enumerated
    answer : SetAnswer
    recording : pandas.DataFrame
        As it came.
    level : float
        Probability from which an effect is named.
    """

    prepared: Prepared
    analysis: Analysis
    sets: Enumerated
    answer: SetAnswer
    recording: pd.DataFrame
    level: float = LEVEL

    @cached_property
    def rolled(self) -> WheelWay | None:
        """Where the wheel stood at each recorded sample; None without a time line."""
        data = self.prepared.data
        if data.time is None:
            return None
        columns = (self.recording[name] for name in ("time", "normal_load"))
        time, load = (column.to_numpy(dtype=float, na_value=np.nan) for column in columns)
        way = data.wheel.way if data.has("speed") else np.zeros(data.size)
        return way_at_each(time, load, data.time_line, way)


def assembled(it: Explained) -> MismatchReport:
    """Return the report."""
    it, equation = _beaten(_with_reasons(it))
    prepared, analysis, answer = it.prepared, it.analysis, it.answer
    data = analysis.data
    left, noise = remainder(analysis, answer, it.sets.likelihood.learnt.left, it.sets.products.largest)
    if prepared.stopped:
        left = replace(left, significant=False, located=[])
    effects = [from_factors(finding, prepared) for finding in prepared.findings]
    effects += [from_fit(analysis, answer, name, noise) for name in answer.names]
    verdict = prepared.stopped or _verdict(effects, left)
    plain = _model(it, [])
    model, allowed = _corrected(it, plain)
    put_in = allowed.fit
    withheld = tuple(n for n in analysis.fit.names if n not in put_in.names)
    inside = replace(analysis, fit=put_in)
    moments = prove_moments(inside, allowed)
    spared = made_worse(moments)
    model = replace(model, as_filed=tuple(spared))
    if spared:
        moments |= {o: f for o, f in prove_moments(inside, replace(allowed, part=0.0)).items() if o in spared}
    proved = {**prove(inside, allowed, noise), **moments}
    spoiled = any(finding.bad is not None for finding in prepared.findings)
    fit = as_recorded(proved, inside, allowed, model, it.recording, prepared.rows, spoiled)
    moment = moment_error(analysis, fit)
    unnamed, model = put_in_equations(
        analysis,
        verdict,
        model,
        it.recording,
        moment,
        named=bool(effects),
        stopped=bool(prepared.stopped),
        equation=equation,
    )
    fit = with_unnamed(fit, unnamed)
    of_moment = moment is not None and verdict == "agrees" and only_moment(moment, unnamed)
    if of_moment or (unnamed.physics is not None and not effects):
        verdict = "unexplained"  # a proved equation contradicts agreement, although it has no name
    silent = prepared.stopped or verdict == "agrees" or of_moment
    before = residual(data, [])
    located = [] if silent else locate(data, before, analysis.noise, analysis.block)
    following = _following(it, verdict, plain)
    ranges, all_over = _ranges(analysis), everywhere(data, before, located)
    rivals = [each.names for each in answer.rivals] or answer.beside_unnamed
    added = bool(put_in.names or prepared.findings or not effects)
    together = changed_together(data, effects)
    if moment is not None and of_moment:
        told = head_of_moment(moment, fit, unnamed)
        following = told.todo
    else:
        stated = () if prepared.question is None else prepared.question.stated
        told = head(
            verdict, effects, fit, located, left, following, ranges, all_over, unnamed, rivals, added, stated
        ).beside(on_moment(moment, fit))
    told = with_own_lag(told, fit, data.followed_relaxation, before).beside(
        on_withheld(withheld) if added else "",
        on_part(put_in.names, model.part),
        on_several(effects if model.instead else []),
        on_moments(spared),
        on_expected([n for n in _unseen(it, effects) if changed_by_itself(together, n)]),
        on_changed_together(together),
    )
    if prepared.question is not None:
        told = on_question(prepared.question, told)
    return MismatchReport(
        verdict=verdict,
        effects=effects,
        fit=fit,
        next_experiment=following,
        corrected=model,
        head=told,
        unnamed=unnamed,
        located=located,
        remainder=left,
        notes=[
            *prepared.notes,
            *filter(None, [_searched(it), _to_one_side(it, put_in), not_looked_for(analysis.absent)]),
        ],
        candidates=_candidates(analysis, answer),
        series=_series(analysis, noise, allowed) | moment_series(analysis, model, moment),
        assumed=prepared.assumed,
        find_visible=list
        if prepared.stopped
        else partial(visible, analysis, it.sets, answer.named, unexplained=left.significant),
        withheld=withheld,
        probabilities=_probabilities(answer),
    )


def _with_reasons(it: Explained) -> Explained:
    """Say of a channel that was left out why, wherever it is called not recorded."""
    left_out = reasons([*it.recording.attrs.get("notes", []), *it.prepared.notes])
    absent = {name: with_reasons(why, left_out) for name, why in it.analysis.absent.items()}
    assumed = [with_reasons(text, left_out) for text in it.prepared.assumed]
    notes = [with_reasons(text, left_out) for text in it.prepared.notes]
    return replace(
        it,
        prepared=replace(it.prepared, assumed=assumed, notes=notes),
        analysis=replace(it.analysis, absent=absent),
    )


def _beaten(it: Explained) -> tuple[Explained, UnnamedReport | None]:
    """Withdraw names where an equation alone predicts unseen sweeps clearly better, and return it, too."""
    if it.prepared.stopped or not it.answer.names:
        return it, None
    with under_way("looking for an equation instead of the names"):
        found = instead_of_names(it.analysis, it.sets, it.answer)
        if found is not None:
            found, _ = never_worse(found, _model(it, []), it.recording)
    if found is None or found.physics is None:
        return it, None
    answer = replace(it.answer, sets=(), named=it.answer.case.sets[0])
    return replace(it, answer=answer, analysis=with_fit(it.analysis, Fit([], []))), found


def _unseen(it: Explained, effects: Sequence[EffectReport]) -> list[str]:
    """Return effects that physics expects in this recording and that no set of names contains."""
    said = {name for effect in effects for name in effect.names}
    return sorted(it.sets.likelihood.unknown.expected - said)


def _verdict(effects: Sequence[EffectReport], left: Remainder) -> str:
    if left.significant:
        return "partly explained" if effects else "unexplained"
    if not effects:
        return "undecided" if left.unusual else "agrees"
    return "ambiguous" if any(e.alternatives or e.same_to_data for e in effects) else "explained"


def _searched(it: Explained) -> str:
    """Say that a long recording was searched in parts."""
    seen, whole = it.analysis.data.size, it.prepared.data.size
    if seen == whole:
        return ""
    refitted = "; parameters are fitted to all" if it.answer.names else ""
    return f"effects were searched for in {seen:,} of {whole:,} samples, stretches spread over them{refitted}"


def _to_one_side(it: Explained, put_in: Fit) -> str:
    """Say that nothing proves a correction on the side to which the recording does not turn."""
    data = it.analysis.data
    if not put_in.names or not data.varies("slip_angle") or not one_sided(data.get("slip_angle")):
        return ""
    return (
        "the slip angle goes to one side, or nearly: causes that differ on the other side look alike here, "
        "and nothing proves the corrected model there; record both sides"
    )


def _corrected(it: Explained, plain: CorrectedModel) -> tuple[CorrectedModel, Guarded]:
    """Put the named effects into the model, as far as sweeps confirm them that their fit has not seen."""
    likely = it.sets.with_mass(it.answer.probabilities, it.answer.named.names)
    allowed = guarded(it.analysis, likely, it.level)
    model = _model(it, allowed.fit.changes, _instead(it, allowed.fit), allowed.part)
    if allowed.fit.names and not _no_worse(it, model, plain):
        nothing = it.analysis.fit.part([], it.analysis.system)
        return plain, Guarded(nothing, 1.0, residual(it.analysis.data, []))
    agreed = share_agreed(it.analysis.data, model.changes, model.instead, model.moments)
    allowed = replace(allowed, agreed=agreed)
    later = partial(confirmed_later, it.analysis, allowed.fit)
    return replace(model, going_on=going_on(it.prepared.data, model.changes, it.rolled, later)), allowed


def _instead(it: Explained, put_in: Fit) -> list[tuple[float, tuple[Change, ...]]]:
    """Return the other likely explanations with their odds, without what is withheld of them."""
    if not put_in.names:
        return []
    withheld = set(it.analysis.fit.names) - set(put_in.names)
    probability, named = it.answer.probabilities, it.answer.named.names
    others = [each for each in it.answer.likely if each.names != named]
    parts = [
        (probability[each.names] / probability[named], tuple(c for c in each.changes if c[0] not in withheld))
        for each in others
    ]
    return [(odds, changes) for odds, changes in parts if changes]


def _no_worse(it: Explained, model: CorrectedModel, plain: CorrectedModel) -> bool:
    """Whether the rows as they were recorded are predicted no worse, all forces together."""
    after, before = (
        sum((rms(it.recording[o] - forces[o]) / it.analysis.largest[o]) ** 2 for o in model.outputs)
        for forces in (model.predict(it.recording), plain.predict(it.recording))
    )
    return after <= before


def _model(
    it: Explained,
    changes: Sequence[Change],
    instead: Sequence[tuple[float, tuple[Change, ...]]] = (),
    part: float = 1.0,
) -> CorrectedModel:
    data, prepared = it.analysis.data, it.prepared
    outputs = tuple(prepared.data.outputs)
    load = data.get("normal_load")
    reference = Reference(
        scales=data.states.scales,
        pressure_nominal=data.nominal.pressure if data.has("pressure") else None,
        speed_nominal=data.nominal.speed if data.has("speed") else None,
        load_range=(float(load.min()), float(load.max())),
        measured=frozenset(data.present),
        relaxes=data.simulation.own_relaxation is not None,
    )
    model = CorrectedModel(
        data.tire,
        tuple(changes),
        outputs,
        reference,
        stands_in=data.simulation.beside is not None,
        moments=recorded_moments(data),
        factors=prepared.factors,
        limits=force_limits(prepared.findings, outputs),
        question=prepared.question,
        cleaned={c.channel: c.removed for c in prepared.cleaned if c.smoothed},
        instead=tuple(instead),
        part=part,
        rolled=it.rolled,
    )
    return model.limited_where_it_helps(it.recording).cleaned_where_it_helps(it.recording)


def _following(it: Explained, verdict: str, plain: CorrectedModel) -> str:
    """Return what to record or to settle next."""
    question = it.prepared.question
    if it.prepared.stopped and question is not None:
        return f"{question.todo}."
    asked = state_units(it.prepared.notes) if verdict in _TO_DO else ""
    return asked or next_experiment(it.analysis, it.answer, plain) or _TO_DO.get(verdict, "")


def _ranges(analysis: Analysis) -> dict[str, tuple[float, float]]:
    """Lowest and highest value of time and of each channel that varies, but for outliers."""
    data, out = analysis.data, {}
    for axis in ("time", *OPERATING_CHANNELS):
        values = data.time if axis == "time" else data.channels.get(axis)
        if values is not None and (axis == "time" or data.varies(axis)):
            out[axis] = span(values)
    return out


def _candidates(analysis: Analysis, answer: SetAnswer) -> list[dict[str, Any]]:
    """Each effect of the catalogue with its log evidence, and why it is not named."""
    likely = {n for names, _ in answer.sets for n in names}
    rows = []
    for name, effect in catalogue().items():
        gain, why = answer.gains.get(name), ""
        if name in analysis.absent:
            gain, why = None, analysis.absent[name]
        elif gain is None:
            why = "detected directly in the channels" if not effect.parameters else "screened out"
        elif name in likely and name not in answer.names:
            why = "is an alternative to a named effect"
        elif name not in likely:
            why = "is less likely than the named effects" if answer.names else "does not pay for itself"
        row = {"name": name, "kind": effect.kind, "accepted": name in answer.names, "gain": gain, "why": why}
        rows.append(row)
    return sorted(rows, key=lambda r: (not r["accepted"], -(r["gain"] if r["gain"] is not None else -np.inf)))


def _probabilities(answer: SetAnswer) -> list[tuple[tuple[str, ...], float]]:
    """Sets that together hold 95% of the posterior, the likeliest first."""
    out, total = [], 0.0
    for names, p in sorted(answer.probabilities.items(), key=lambda each: -each[1]):
        out.append((names, p))
        total += p
        if total > 1.0 - CHANCE:
            break
    return out


def _series(analysis: Analysis, noise: Mapping[str, float], allowed: Guarded) -> dict[str, Any]:
    """Arrays for the page's figures."""
    data = analysis.data
    step = max(1, data.size // ENOUGH_ROWS)
    before, after = residual(data, []), residual(data, analysis.fit.changes)
    out: dict[str, Any] = {
        "time": None if data.time is None else data.time[::step],
        "normal_load": data.get("normal_load")[::step],
        "slip_angle": data.get("slip_angle")[::step],
        "slip_ratio": data.get("slip_ratio")[::step],
    }
    for o in data.outputs:
        out[f"before_{o}"] = before[o][::step]
        out[f"after_{o}"] = partly(before[o], after[o], allowed.added(o))[::step]
        out[f"floor_{o}"] = noise[o]
    return out
