"""From the answer to the set that is named: its parameters, their errors, and a refit to all samples."""

from __future__ import annotations

from dataclasses import replace

from tire_pipeline.mismatch.inference.analysis import Analysis, with_fit
from tire_pipeline.mismatch.inference.evidence.hypotheses import plain
from tire_pipeline.mismatch.inference.linearised_set import Fit, columns_of, linearised
from tire_pipeline.mismatch.inference.priors import prior
from tire_pipeline.mismatch.inference.sets.answer import SetAnswer
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.inference.thinning import refit_on_all
from tire_pipeline.mismatch.model.data import Data


def with_named(analysis: Analysis, sets: Enumerated, answer: SetAnswer, data: Data) -> Analysis:
    """Return the analysis with the set that is named, its parameters fitted to all samples.

    Parameters
    ----------
    analysis : Analysis
        Of the samples that were searched.
    sets : Enumerated
    answer : SetAnswer
    data : Data
        All samples.
    """
    if not answer.sets:
        return analysis
    named = with_fit(analysis, _fit_of(analysis, sets, answer))
    return replace(named, fit=refit_on_all(named, data))


def _fit_of(analysis: Analysis, sets: Enumerated, answer: SetAnswer) -> Fit:
    """Return the fit of a set, with the covariance of its parameters beside all that is never known."""
    each = answer.named
    labels, _ = columns_of(analysis.data, list(each.changes), list(each.free))
    _, wide = prior(analysis.data, each.changes, labels)
    found = plain(sets.likelihood, each)
    inner = found.covariance[: each.parameters, : each.parameters] * wide[:, None] * wide[None, :]
    weight = {
        o: w.precision / sets.products.largest[o] ** 2 / analysis.data.size for o, w in found.weights.items()
    }
    fit = linearised(analysis.system, each.changes, each.free, inner, weight, sets.likelihood.learnt.prior)
    kept = [i for i, (name, _) in enumerate(each.changes) if name in answer.names]
    return fit if len(kept) == len(each.changes) else fit.part(kept, analysis.system)
