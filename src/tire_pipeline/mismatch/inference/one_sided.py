"""Parameters that physics lets lie on one side only: a lag is not negative, friction has an optimum.

The evidence of a set is an integral over all sizes of its parameters. Where only one side is possible the
prior is twice as dense there, and the other side counts for nothing. So the evidence changes by the
probability of the possible side given the recording, over that beforehand, which is one half for each
parameter.

The probability of several sides at once takes them one after another: each truncates the normal distribution
of the others, which is taken for normal again with the same mean and covariance (Mendell and Elston 1974,
Biometrics 30, 41). For one parameter it is exact.
"""

from __future__ import annotations

import numpy as np
import scipy

Array = np.ndarray
_LOG_ROOT = 0.5 * np.log(2.0 * np.pi)


def log_possible(mean: Array, covariance: Array, positive: Array) -> float:
    """Return the log probability that some coefficients are positive, over that of centred ones.

    Parameters
    ----------
    mean : ndarray, shape (m,)
    covariance : ndarray, shape (m, m)
    positive : ndarray of bool, shape (m,)
    """
    picked = np.flatnonzero(positive)
    mean, covariance = mean[picked], covariance[np.ix_(picked, picked)]
    total = picked.size * np.log(2.0)
    for k in range(picked.size):
        spread = np.sqrt(covariance[k, k])
        z = mean[k] / spread
        inside = float(scipy.special.log_ndtr(z))
        total += inside
        hazard = np.exp(-0.5 * z**2 - _LOG_ROOT - inside)
        along = covariance[:, k] / spread
        mean = mean + along * hazard
        covariance = covariance - np.outer(along, along) * hazard * (hazard + z)
    return float(total)
