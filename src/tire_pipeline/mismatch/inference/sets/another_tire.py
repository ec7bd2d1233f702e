"""Another tire than the file's, weighed as one more cause beside the sets of effects."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.evidence.hypotheses import log_prior, plain_evidence, position
from tire_pipeline.mismatch.inference.sets.answer import SetAnswer
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.recording.identity import SIZES_OF_TIRES, of_another_tire

Array = np.ndarray


def probability_of_another_tire(sets: Enumerated, answer: SetAnswer) -> float:
    """Return how likely it is that another tire explains a mismatch, and not a set of effects.

    Both are weighed by the same likelihood. Where several figures are off at once another tire is as likely
    beforehand as that nothing is missing.

    Parameters
    ----------
    sets : Enumerated
    answer : SetAnswer
        Of these sets. Those beside which something is unnamed do not count.
    """
    likelihood, data = sets.likelihood, sets.products.data
    columns = of_another_tire(data.tire, _channels(sets), data.recorded)
    scale = np.ones(next(iter(columns.values())).shape[1] - 1)
    other = likelihood.evidence(sets.products.of(columns), scale, tailed=np.zeros(scale.size, bool)).value
    other -= len(data.recorded) * np.log(len(SIZES_OF_TIRES))
    best = max(answer.alone, key=lambda names: answer.alone[names])
    number = position(sets.case, best)
    assert number is not None  # it was enumerated
    own = plain_evidence(likelihood, sets.sets[number]) + log_prior(sets.case, likelihood.learnt)[number]
    share = answer.alone[best] / sum(answer.alone.values())
    return float(scipy.special.expit(other - own + np.log(share)))


def _channels(sets: Enumerated) -> Mapping[str, Array]:
    data = sets.products.data
    return {name: data.get(name) for name in data.channels}
