"""Another tire than the file's, weighed as one more cause beside the sets of effects."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from tire_pipeline.channels import SLIP_OF_FORCE
from tire_pipeline.mismatch.inference.evidence.hypotheses import log_prior, plain_evidence
from tire_pipeline.mismatch.inference.learnt.sizes import EXPECTED
from tire_pipeline.mismatch.inference.sets.answer import SetAnswer, nothing
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.recording.identity import SIZES_OF_TIRES, of_another_tire
from tire_pipeline.mismatch.recording.prepare import Prepared


def settled(
    prepared: Prepared, sets: Enumerated, answer: SetAnswer, level: float
) -> tuple[Prepared, SetAnswer]:
    """Drop an open question that sets of effects answer; where one stays open, nothing is explained.

    Parameters
    ----------
    prepared : Prepared
    sets : Enumerated
    answer : SetAnswer
    level : float
        Probability from which something is named.
    """
    question, suspected = prepared.question, prepared.suspected
    named = answer.unnamed < level
    if prepared.stopped and question is not None:
        if question.by_sets and named and probability_of_another_tire(sets) < level:
            return replace(prepared, questions=prepared.questions[1:]), answer
        return prepared, nothing(answer.case)
    if suspected is None or not named or probability_of_another_tire(sets, likely=False) < level:
        return prepared, answer
    rest = [each for each in prepared.questions if each is not suspected]
    return replace(prepared, questions=[replace(suspected, likely=True), *rest]), nothing(answer.case)


def probability_of_another_tire(sets: Enumerated, *, likely: bool = True) -> float:
    """Return how likely it is that another tire explains a mismatch, and not a set of effects.

    Both are weighed by the same likelihood, on the forces whose slip varies: of another one the figures of a
    tire say nothing. Where several figures are off at once another tire is as likely beforehand as that
    nothing is missing but what physics expects: that acts on another tire as well. Sets beside which
    something is unnamed do not count.

    Parameters
    ----------
    sets : Enumerated
    likely : bool
        Whether several figures are off. If not, another tire is as likely beforehand as one effect.
    """
    likelihood, data = sets.likelihood, sets.products.data
    driven = {o: x for o, x in data.recorded.items() if data.varies(SLIP_OF_FORCE[o])}
    if not driven:
        return 0.0
    columns = of_another_tire(data.tire, {name: data.get(name) for name in data.channels}, driven)
    ones = np.ones(next(iter(columns.values())).shape[1] - 1)
    other = likelihood.evidence(sets.products.of(columns), ones).value
    other -= len(driven) * np.log(len(SIZES_OF_TIRES))
    parts = [replace(each, products=each.products.of_forces(driven)) for each in sets.sets]
    own = np.array([plain_evidence(likelihood, each) for each in parts])
    own += log_prior(sets.case, likelihood.learnt)[: own.size] - EXPECTED * len(likelihood.unknown.expected)
    other += 0.0 if likely else likelihood.learnt.effect
    return float(scipy.special.expit(other - scipy.special.logsumexp(own)))
