"""The report's entry for each effect that was found."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.base import Finding
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.sets.answer import SetAnswer
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.left_out import each_left_out, shares_left
from tire_pipeline.mismatch.proof.locate import when, where
from tire_pipeline.mismatch.recording.prepare import Prepared
from tire_pipeline.mismatch.report.contents import EffectReport
from tire_pipeline.mismatch.report.words import shortened


def from_factors(finding: Finding, prepared: Prepared) -> EffectReport:
    """Report a fault that exact factors show."""
    effect = catalogue()[finding.name]
    spans: list[tuple[float, float]] = []
    if prepared.data.time is not None:
        spans = [(float(prepared.data.time[0]), float(prepared.data.time[-1]))]
    if finding.span is not None:
        spans = [finding.span]
    return EffectReport(
        name=finding.name,
        kind=effect.kind,
        title=f"{effect.title} ({shortened(finding.text)})",
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


def from_fit(analysis: Analysis, answer: SetAnswer, name: str, noise: Mapping[str, float]) -> EffectReport:
    """Report a named effect with its alternatives, its parameters and what it removes."""
    data, fit = analysis.data, analysis.fit
    index = fit.names.index(name)
    (group, confidence) = next(each for each in answer.sets if each[0][0] == name)
    effect = catalogue()[name]
    rest = [change for j, change in enumerate(fit.changes) if j != index]
    whole, without = simulate(data, fit.changes), simulate(data, rest)
    part = {o: whole[o] - without[o] for o in data.outputs}
    output = max(data.outputs, key=lambda o: float(np.mean(part[o] ** 2)))
    units = {p.name: p.unit for p in effect.parameters}
    own = {n: row for row, (i, n) in enumerate(fit.labels) if i == index}
    errors, ends, open_still = fit.errors, fit.intervals, fit.undetermined
    fitted = {n: dict(answer.single(n)[0][1]) for n in group[1:]} | {name: fit.changes[index][1]}
    return EffectReport(
        name=name,
        kind=effect.kind,
        title=effect.title,
        alternatives=group[1:],
        confidence=confidence,
        output=output,
        where=where(part[output], data),
        when=when(part[output], data, noise[output]),
        share=_share(analysis, index, output),
        equation=effect.equation,
        source=effect.source,
        parameters={n: (float(fit.changes[index][1][n]), float(errors[k]), units[n]) for n, k in own.items()},
        evidence={"log_evidence": answer.gains.get(name, float("nan"))},
        intervals={n: (float(ends[k, 0]), float(ends[k, 1])) for n, k in own.items()},
        undetermined=tuple(n for n, k in own.items() if open_still[k]),
        same_to_data=tuple(filter(None, (catalogue()[n].same_to_data(data, fitted[n]) for n in group))),
    )


def _share(analysis: Analysis, index: int, output: str) -> float:
    """Share of the squared mismatch that an effect removes on sweeps that the fit has not seen."""
    fit, before = analysis.fit, residual(analysis.data, [])
    others = fit.part([j for j in range(len(fit.names)) if j != index], analysis.system)
    with_it, without = (shares_left(each_left_out(analysis, f), before)[output] for f in (fit, others))
    return without - with_it
