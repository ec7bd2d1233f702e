"""How far a parameter may be off: noise, misfit, and coefficients that moved since the file was fitted.

The search lets the coefficients move little, so that they do not take up what an effect does. An interval
has to hold the truth however they moved, and asks for more room. In recordings of the rig simulator in which
nothing is missing (seeds 63000 to 63006, set on them) the intervals of the search held the truth, zero, in
0.86 of 239 parameters, and in 0.93 with twice as much room; of those that scale or shift the force in 0.86
and 0.96. ``benchmarks/visible_sizes.py`` measures it on other seeds.
"""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.inference.refit import Fit, inverse
from tire_pipeline.mismatch.inference.search_state import Search, nuisance_scale

Array = np.ndarray
ROOM = 2.0
"""Times as far as in the search the coefficients may be off."""


def roomy(search: Search) -> System:
    """Return the search's equations with as much room for the coefficients as an interval asks for."""
    return search.system.rescaled(nuisance_scale(search.sizes, search.misfit, search.path, ROOM))


def standard_errors(search: Search, fit: Fit) -> Array:
    """Return the standard errors of a fit's floating parameters, in the order of ``fit.labels``.

    What more room adds is added to the fit's own variance: more samples make the noise's part of it smaller,
    not this one.
    """
    variance = np.diag(fit.covariance)
    if fit.sums is not None and fit.labels:
        own, wide = (inverse(system.reduce(fit.sums)[0]) for system in (search.system, roomy(search)))
        variance = variance + np.maximum(np.diag(wide) - np.diag(own), 0.0)
    return np.sqrt(np.maximum(variance, 0.0) * search.inflation)
