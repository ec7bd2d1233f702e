"""From a tire model and a recording to a report."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.corrected.as_recorded import as_recorded, never_worse, with_unnamed
from tire_pipeline.mismatch.corrected.model import CorrectedModel, force_limits
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.base import Finding
from tire_pipeline.mismatch.inference import search as searching
from tire_pipeline.mismatch.inference.ambiguity import alternatives, experiment, rivals
from tire_pipeline.mismatch.inference.left_out import shares_left
from tire_pipeline.mismatch.inference.refit import Fit
from tire_pipeline.mismatch.inference.restart import search_all, unlike
from tire_pipeline.mismatch.inference.search import Search
from tire_pipeline.mismatch.inference.thinning import refit_on_all, thinned
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.confidence import confidence
from tire_pipeline.mismatch.proof.held_out import prove, prove_moments, recorded_moments
from tire_pipeline.mismatch.proof.intervals import standard_errors
from tire_pipeline.mismatch.proof.locate import AXES, everywhere, locate, when, where
from tire_pipeline.mismatch.proof.measured import OutputFit, Remainder
from tire_pipeline.mismatch.proof.remainder import remainder
from tire_pipeline.mismatch.proof.visible import visible
from tire_pipeline.mismatch.recording.checks import Prepared, prepare
from tire_pipeline.mismatch.report.result import EffectReport, MismatchReport
from tire_pipeline.mismatch.report.sentences import on_unnamed, summary
from tire_pipeline.mismatch.report.words import not_looked_for
from tire_pipeline.mismatch.unnamed_physics.search import more_than_usual, unnamed_physics
from tire_pipeline.progress import track

Array = np.ndarray
_SOMETHING_LEFT = ("unexplained", "partly explained")


def explain_mismatch(tire: Any, recording: pd.DataFrame, *, without: Collection[str] = ()) -> MismatchReport:
    """Say where a simulation and a recording differ, what the model left out, and prove it.

    Parameters
    ----------
    tire : TireModel or None
        The model. None if the recording has a column ``simulated_fy`` (or ``simulated_fx``), the
        output of another simulator.
    recording : pandas.DataFrame
        Canonical columns in SI: ``time`` s, ``slip_angle`` rad, ``slip_ratio``, ``camber`` rad,
        ``normal_load`` N, ``speed`` m/s, ``pressure`` Pa, ``tread_temperature`` degC, ``fx fy`` N.
        Without ``time`` the rows are steady points.
    without : collection of str
        Effects that are not looked for, as if the catalogue lacked them: what they do is then left without a
        name. For proofs; faults that are found from exact factors are found all the same.

    Returns
    -------
    MismatchReport
        Verdict, effects with their probabilities, errors before and after, and the corrected model.

    Raises
    ------
    RecordingError
        If the recording cannot be used; the message says why and what to do.

    See Also
    --------
    explain_recordings : Several recordings of one tire, one of them held out.
    tire_pipeline.recordings.read_recording : Reads a file into such a table.

    Notes
    -----
    Method and limits: ``docs/explanation/mismatch.md``.

    Examples
    --------
    A rig on which the tire has 10% less cornering stiffness than its file says:

    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.tir import read_tir
    >>> tire = read_tir("tire.tir")
    >>> softer = tire.replace(LKY=0.9)
    >>> slip_angle = np.tile(np.linspace(-0.15, 0.15, 100), 2)
    >>> rig = pd.DataFrame({"slip_angle": slip_angle, "normal_load": np.repeat([3000.0, 5000.0], 100)})
    >>> rig["fy"] = softer.forces(slip_angle=rig["slip_angle"], normal_load=rig["normal_load"]).fy
    >>> rig["fy"] += np.random.default_rng(0).normal(0.0, 20.0, len(rig))
    >>> report = explain_mismatch(tire, rig)
    >>> "stiffness_scale" in report.sets[0][0], report.fit["fy"].rms_before > 5 * report.fit["fy"].rms_after
    (True, True)
    """
    unknown = sorted(set(without) - set(catalogue()))
    if unknown:
        raise RecordingError(
            f"the catalogue has no {', '.join(unknown)} to leave out", todo="name effects of the catalogue"
        )
    state: dict[str, Any] = {}
    steps = (
        ("check", lambda: state.update(prepared=prepare(tire, recording))),
        ("noise", lambda: state.update(search=searching.begin(thinned(state["prepared"].data), without))),
        ("search", lambda: _search(state["search"], state["prepared"])),
        ("refit", lambda: _refit(state["search"], state["prepared"])),
        ("report", lambda: state.update(report=_report(state["prepared"], state["search"], recording))),
    )
    for name, step in track(steps, "explaining the mismatch"):
        try:
            step()
        except np.linalg.LinAlgError as error:
            raise RecordingError(
                f"the equations of this recording cannot be solved ({error})",
                where=f"explain_mismatch, step {name}",
                todo="leave out channels that hold nothing but noise, and please report the recording",
            ) from error
    return state["report"]


def _search(search: Search, prepared: Prepared) -> None:
    """Look for effects, if the recording carries an answer or one effect could give it."""
    question = prepared.question
    if not prepared.stopped or (question is not None and question.removed is not None):
        search_all(search)
    if not prepared.stopped or question is None:
        return
    if len(search.fit.names) == 1 and question.answered(_removed(search)):
        prepared.question = None
        return
    search.fit, search.gates = Fit([], []), []
    search.refused.update({n: f"not looked for: {prepared.stopped}" for n in catalogue()})


def _removed(search: Search) -> float:
    """Share of the squared mismatch that the effects remove, of the force that has the least."""
    left = residual(search.data, search.fit.changes)
    return 1.0 - max(shares_left(left, residual(search.data, [])).values())


def _refit(search: Search, prepared: Prepared) -> None:
    """Refit the parameters to all samples if the search has seen a part of them."""
    whole, seen = prepared.data.size, search.data.size
    if whole == seen:
        return
    search.fit = refit_on_all(search, prepared.data)
    refitted = "; parameters are fitted to all" if search.fit.names else ""
    prepared.notes.append(
        f"effects were searched for in {seen:,} of {whole:,} samples, stretches spread over them{refitted}"
    )


def _report(prepared: Prepared, search: Search, recording: pd.DataFrame) -> MismatchReport:
    data = search.data
    left = remainder(search)
    if unlike(search, left.log_evidence):
        search.refused.update(
            {n: "what it leaves is too large for this to be the cause" for n in search.fit.names}
        )
        search.fit, search.gates = Fit([], []), []
        left = replace(remainder(search), significant=True)
    if search.unnamed or (search.nearly and not search.fit.names):
        left = replace(left, significant=True)
    fit = prove(search)
    before = {o: data.recorded[o] - data.base[o] for o in data.outputs}
    effects = [_exact(f, prepared) for f in prepared.findings]
    experiments = []
    for i in range(len(search.fit.names)):
        effect, text = _found(search, i, left, data)
        effects.append(effect)
        if text:
            experiments.append(text)
    if prepared.stopped:
        left = replace(left, significant=False, located=[])
    verdict = prepared.stopped or _verdict(effects, left)
    silent = prepared.stopped or verdict == "agrees"
    located = [] if silent else locate(data, before, search.noise, search.block)
    if verdict == "unexplained" and not experiments:
        experiments.append(
            "Record the same sweeps again, and then with one channel changed at a time: what repeats is "
            "the tire or the rig, and what follows a channel has found its cause."
        )
    question = prepared.question
    if prepared.stopped and question is not None:
        experiments = [f"{question.todo}."]
    following = " ".join(experiments)
    outputs = tuple(prepared.data.outputs)
    reference: dict[str, Any] = {"scales": data.scales, "measured": tuple(sorted(data.present))}
    load = data.get("normal_load")
    reference["load_range"] = {"low": float(load.min()), "high": float(load.max())}
    if "pressure" in data.present:
        reference["pressure_nominal"] = data.pressure_nominal
    if "speed" in data.present:
        reference["speed_nominal"] = data.speed_nominal
    corrected = CorrectedModel(
        data.tire,
        tuple(search.fit.changes),
        reference,
        outputs,
        data.beside is not None,
        recorded_moments(data),
        factors=prepared.factors,
        limits=force_limits(prepared.findings, outputs),
        question=question,
        cleaned={c.channel: c.removed for c in prepared.cleaned if c.smoothed},
    ).cleaned_where_it_helps(recording)
    fit = as_recorded({**fit, **prove_moments(search)}, search, corrected, recording)
    unnamed = None
    beside_names = effects and not prepared.stopped and more_than_usual(search)
    if verdict in _SOMETHING_LEFT or beside_names:
        plainly = verdict not in _SOMETHING_LEFT
        looked = unnamed_physics(search, plainly=plainly)
        unnamed, corrected = never_worse(looked, corrected, recording)
        fit = with_unnamed(fit, unnamed)
        unnamed = None if plainly and unnamed.physics is None else unnamed
    even = everywhere(data, before, located)
    told = (
        ""
        if prepared.stopped
        else summary(verdict, effects, fit, located, left, following, _ranges(data), even)
    )
    return MismatchReport(
        verdict=verdict,
        effects=effects,
        fit=fit,
        next_experiment=following,
        corrected=corrected,
        summary=" ".join(
            filter(None, ["" if question is None else question.in_words, told, on_unnamed(unnamed, verdict)])
        ),
        unnamed=unnamed,
        located=located,
        remainder=left,
        notes=[*prepared.notes, *filter(None, [not_looked_for(search.absent)])],
        candidates=_candidates(search),
        series=_series(search),
        assumed=prepared.assumed,
        visible=[] if prepared.stopped else visible(search, unexplained=left.significant),
    )


def _exact(finding: Finding, prepared: Prepared) -> EffectReport:
    effect = catalogue()[finding.name]
    spans: list[tuple[float, float]] = []
    if prepared.data.time is not None:
        spans = [(float(prepared.data.time[0]), float(prepared.data.time[-1]))]
    if finding.span is not None:
        spans = [finding.span]
    return EffectReport(
        name=finding.name,
        kind=effect.kind,
        title=f"{effect.title} ({finding.text})",
        alternatives=(),
        confidence=finding.evidence,
        output=finding.channel,
        where={},
        when=spans,
        share=float("nan"),
        equation=effect.equation,
        source=effect.source,
        parameters=finding.parameters,
        evidence={"found": finding.text},
    )


def _found(search: Search, index: int, left: Remainder, data: Data) -> tuple[EffectReport, str]:
    name, values = search.fit.changes[index]
    effect, gate = catalogue()[name], search.gates[index]
    near = rivals(search, index)
    possible = alternatives(near)
    whole = simulate(data, search.fit.changes)
    without = simulate(data, [c for j, c in enumerate(search.fit.changes) if j != index])
    part = {o: whole[o] - without[o] for o in data.outputs}
    output = max(data.outputs, key=lambda o: float(np.mean(part[o] ** 2)))
    units = {p.name: p.unit for p in effect.parameters}
    known = zip(search.fit.labels, standard_errors(search, search.fit), strict=True)
    errors = {n: float(error) for (i, n), error in known if i == index}
    parameters = {
        n: (float(v), errors.get(n, 0.0), units[n]) for n, v in values.items() if n in search.fit.free[index]
    }
    evidence: dict[str, Any] = {
        "gain_nats": gate.gain,
        "gain_with_loose_coefficients": gate.loose,
        "gain_with_frozen_coefficients": gate.frozen,
        "wilcoxon_p": gate.p_value,
        "sweeps": gate.blocks,
    }
    if gate.free:
        evidence["not_asked_for"] = "gain with loose coefficients"
    if near:
        evidence |= {"nearest_rival": near[0].name, "nearest_rival_apart": near[0].apart}
    report = EffectReport(
        name=name,
        kind=effect.kind,
        title=effect.title,
        alternatives=possible,
        confidence=confidence(search, index, near, left),
        output=output,
        where=where(part[output], data),
        when=when(part[output], data, search.noise[output].floor),
        share=gate.share,
        equation=effect.equation,
        source=effect.source,
        parameters=parameters,
        evidence=evidence,
    )
    return report, experiment(name, list(possible)) if possible else ""


def _verdict(effects: list[EffectReport], left: Remainder) -> str:
    if not effects:
        return "unexplained" if left.significant else "agrees"
    if left.significant:
        return "partly explained"
    return "ambiguous" if any(e.alternatives for e in effects) else "explained"


def _ranges(data: Data) -> dict[str, tuple[float, float]]:
    """Lowest and highest value of each axis (0.5 and 99.5% quantile)."""
    out = {}
    for axis in ("time", *AXES):
        values = data.time if axis == "time" else data.channels.get(axis)
        if values is not None:
            low, high = np.quantile(values, [0.005, 0.995])
            out[axis] = (float(low), float(high))
    return out


def _candidates(search: Search) -> list[dict[str, Any]]:
    taken = dict(zip(search.fit.names, search.gates, strict=True)) if search.gates else {}
    rows = []
    for name, effect in catalogue().items():
        row: dict[str, Any] = {"name": name, "kind": effect.kind, "accepted": name in taken}
        if name in search.absent:
            row |= {"gain": None, "why": search.absent[name]}
        else:
            gain = taken[name].gain if name in taken else search.screened.get(name)
            row |= {
                "gain": gain,
                "why": "" if name in taken else search.refused.get(name, _why_not(search, gain)),
            }
        rows.append(row)
    return sorted(rows, key=lambda r: (not r["accepted"], -(r["gain"] if r["gain"] is not None else -1e9)))


def _why_not(search: Search, gain: float | None) -> str:
    """Why a candidate that no gate refused is not in."""
    if gain is not None and gain > settings.LEAST_GAIN and search.fit.names:
        return "explains less than what is accepted, and nothing beside it"
    return "does not pay for itself"


def _series(search: Search) -> dict[str, Any]:
    """Arrays for the page's figures, at most 4000 samples."""
    data = search.data
    step = max(1, data.size // 4000)
    after = residual(data, search.fit.changes)
    out: dict[str, Any] = {
        "time": None if data.time is None else data.time[::step],
        "normal_load": data.get("normal_load")[::step],
        "slip_angle": data.get("slip_angle")[::step],
        "slip_ratio": data.get("slip_ratio")[::step],
    }
    for o in data.outputs:
        out[f"before_{o}"] = (data.recorded[o] - data.base[o])[::step]
        out[f"after_{o}"] = after[o][::step]
        out[f"floor_{o}"] = search.noise[o].floor
    return out


__all__ = ["OutputFit", "RecordingError", "explain_mismatch"]
