"""Another tire than the file's, weighed as one more cause beside the sets of effects."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
import scipy

from tire_pipeline.channels import FORCE_OF_SLIP
from tire_pipeline.mismatch.inference.evidence.hypotheses import log_prior, scales
from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood, Projected
from tire_pipeline.mismatch.inference.evidence.products import OfSet
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.recording.identity import SIZES_OF_TIRES, of_another_tire


def probability_of_another_tire(sets: Enumerated) -> float:
    """Return how likely it is that another tire explains a mismatch, and not a set of effects.

    Both are weighed by the same likelihood, on the forces whose slip varies: of another one the figures of a
    tire say nothing. Where several figures are off at once another tire is as likely beforehand as that
    nothing is missing. Sets beside which something is unnamed do not count.

    Parameters
    ----------
    sets : Enumerated
    """
    likelihood, data = sets.likelihood, sets.products.data
    driven = {force for slip, force in FORCE_OF_SLIP.items() if data.varies(slip) and force in data.recorded}
    channels = {name: data.get(name) for name in data.channels}
    columns = of_another_tire(data.tire, channels, data.recorded)
    known = _of_forces(likelihood.projected(sets.products.of(columns)), driven)
    ones = np.ones(next(iter(columns.values())).shape[1] - 1)
    other = likelihood.evidence(known, ones, tailed=np.zeros(ones.size, bool)).value
    other -= len(driven) * np.log(len(SIZES_OF_TIRES))
    own = np.array([_log_evidence(likelihood, each, driven) for each in sets.sets])
    own += log_prior(sets.case, likelihood.learnt)[: own.size]
    return float(scipy.special.expit(other - scipy.special.logsumexp(own)))


def _log_evidence(likelihood: Likelihood, each: OfSet, forces: Collection[str]) -> float:
    """Return the log evidence of a set with nothing unnamed in some of the forces."""
    scale = scales(each, likelihood.learnt)
    known = _of_forces(likelihood.projected(each.plain), forces)
    tailed, positive = each.tailed(scale.size), each.positive(scale.size)
    return likelihood.evidence(known, scale, tailed=tailed, positive=positive).value + each.spread


def _of_forces(products: Projected, forces: Collection[str]) -> Projected:
    return Projected(
        {o: x for o, x in products.own.items() if o in forces},
        {o: x for o, x in products.parts.items() if o in forces},
    )
