"""The named set, beside which everything else in a recording is weighed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from tire_pipeline.mismatch.inference.evidence.hypotheses import scales
from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.evidence.products import OfSet
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray


@dataclass(frozen=True)
class Beside:
    """The named set in one recording.

    Parameters
    ----------
    named : OfSet
    rest : dict of ndarray, shape (n,)
        The residual of each output, N.
    columns : dict of ndarray, shape (n, m)
        Of its parameters and of what its forms get wrong, N.
    scale : ndarray, shape (m,)
        Spreads of these columns' coefficients.
    tailed : ndarray of bool, shape (m,)
        Which of them have priors with tails.
    positive : ndarray of bool, shape (m,)
        Which of them are never negative.
    likelihood : Likelihood
        Over every size of the misfit: with a larger one, nothing need be missing.
    """

    named: OfSet
    rest: Mapping[str, Array]
    columns: Mapping[str, Array]
    scale: Array
    tailed: Array
    positive: Array
    likelihood: Likelihood

    @classmethod
    def of(cls, enumerated: Enumerated, named: OfSet) -> Beside:
        """Return a set that was enumerated, as others are weighed beside it."""
        products, likelihood = enumerated.products, enumerated.likelihood
        scale = scales(named, likelihood.learnt)
        _, columns = products.columns_of_set(named.changes, named.free)
        return cls(
            named,
            residual(products.data, named.changes),
            {o: x[:, : scale.size] for o, x in columns.items()},
            scale,
            named.tailed(scale.size),
            named.positive(scale.size),
            likelihood,
        )
