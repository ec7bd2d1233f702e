"""Kinds of tires that no metadata names: a mixture whose classes all categories share.

A compound stands in no file, but it leaves traces in several properties at once: friction, cornering and slip
stiffness. Tires fall into groups; the groups are the same for whoever measured, their shares depend on the
metadata alone, and what a category does to each group is its bias. So a category's bias is found by laying
its groups over the other categories' groups (expectation maximisation), which is far sharper than comparing
means.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from scipy.optimize import minimize
from scipy.special import logsumexp

from tire_pipeline.numerics.row_products import by_row

_SHARE_PENALTY = 1.0


@dataclass(frozen=True)
class TireClasses:
    """Classes of tires.

    Attributes
    ----------
    scores : ndarray of int, shape (q,)
        The scores that tell classes apart.
    shares : ndarray, shape (1 + d, k)
        Metadata (after a 1) to the logarithms of the classes' shares, up to a constant.
    usual : ndarray, shape (k,)
        Share of each class over all training tires.
    own : ndarray, shape (q, q)
        Covariance of what is a tire's own within its class, scores in their standard deviations.
    """

    scores: np.ndarray
    shares: np.ndarray
    usual: np.ndarray
    own: np.ndarray

    @property
    def count(self) -> int:
        """How many classes."""
        return int(self.usual.size)

    def prior(self, metadata: np.ndarray) -> np.ndarray:
        """Logarithms of the shares among tires of such metadata, (n, k)."""
        return log_shares(metadata, self.shares)

    def coded(self, probability: np.ndarray) -> np.ndarray:
        """Regressors, (n, k): probabilities less the usual shares, so that zero is the mean tire."""
        return probability - self.usual

    def probability(self, metadata: np.ndarray, gap: np.ndarray, alone: np.ndarray) -> np.ndarray:
        """Probability of each class, (n, k).

        Parameters
        ----------
        metadata : ndarray, shape (n, d)
        gap : ndarray, shape (n, k, q)
            What was measured less what is expected of each class.
        alone : ndarray, shape (n, q)
            Variance of a measurement beyond what is the tire's own.
        """
        return np.exp(_normalised(self.prior(metadata) + log_density(gap, self.own, alone)))

    def to_state(self) -> dict[str, Any]:
        """Return the arrays that restore it."""
        return {
            "class_scores": self.scores,
            "class_shares": self.shares,
            "class_usual": self.usual,
            "class_own": self.own,
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        return cls(
            np.asarray(state["class_scores"]).astype(int),
            np.asarray(state["class_shares"]),
            np.asarray(state["class_usual"]),
            np.asarray(state["class_own"]),
        )


def _normalised(logs: np.ndarray) -> np.ndarray:
    return np.asarray(logs - logsumexp(logs, axis=1, keepdims=True))


def log_shares(metadata: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Logarithms of the classes' shares, (n, k), for weights (1 + d, k) of metadata (n, d) after a 1."""
    return _normalised(by_row(np.concatenate([np.ones((len(metadata), 1)), metadata], axis=1), weights))


def log_density(gap: np.ndarray, own: np.ndarray, alone: np.ndarray) -> np.ndarray:
    """Logarithm of the Gaussian density of each class, (n, k), up to a constant."""
    covariance = own[None] + alone[:, :, None] * np.eye(len(own))[None]
    factor = np.linalg.cholesky(covariance)
    whitened = np.linalg.solve(factor[:, None], gap[..., None])[..., 0]
    spread = np.log(np.diagonal(factor, axis1=1, axis2=2)).sum(axis=1)
    return np.asarray(-0.5 * (whitened**2).sum(axis=2) - spread[:, None])


def fit_shares(
    metadata: np.ndarray, probability: np.ndarray, start: np.ndarray | None = None, steps: int = 50
) -> np.ndarray:
    """Multinomial logistic regression of the classes on the metadata, (1 + d, k); slopes are penalised."""
    x = np.concatenate([np.ones((len(metadata), 1)), metadata], axis=1)
    count = probability.shape[1]
    penalty = np.full((x.shape[1], 1), _SHARE_PENALTY)
    penalty[0] = 1e-3

    def loss(flat: np.ndarray) -> tuple[float, np.ndarray]:
        weights = flat.reshape(x.shape[1], count)
        logs = _normalised(x @ weights)
        value = -(probability * logs).sum() + 0.5 * (penalty * weights**2).sum()
        slope = x.T @ (np.exp(logs) - probability) + penalty * weights
        return float(value), slope.ravel()

    if start is None:
        start = np.zeros((x.shape[1], count))
        start[0] = np.log(np.maximum(probability.mean(axis=0), 1e-6))
    found = minimize(loss, start.ravel(), jac=True, method="L-BFGS-B", options={"maxiter": steps})
    return np.asarray(found.x.reshape(x.shape[1], count))
