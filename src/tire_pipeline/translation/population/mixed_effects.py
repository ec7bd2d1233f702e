"""A linear mixed model whose variances are found from the data: the statistical model of the translators.

y_i = sum over blocks of x_i' w_block + tire effect + (tire x category) effect + noise

Weights of a block are Gaussian around zero with a variance of the block's own. Variances maximise the
marginal
likelihood (empirical Bayes; Robinson 1991, *That BLUP is a good thing*; MacKay 1992): a block that the
data does not support gets a variance near zero, and so its effect shrinks to nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import minimize

NOT_BLOCKS = ("tire", "tire_category", "noise")
"""Variances that are of no block of the design."""

_FLAT = 100.0
_LOW, _HIGH = np.log(1e-6), np.log(50.0)


@dataclass(frozen=True)
class Design:
    """Rows of the model.

    Attributes
    ----------
    blocks : dict of str to ndarray
        Regressors, each (n, columns). The block ``level`` has a fixed, wide variance.
    tire : ndarray, shape (n, t)
        One column for each tire that more than one row belongs to; other rows are all zero.
    files : ndarray, shape (n,)
        Number of files that a row is the average of.
    weight : ndarray, shape (n,), optional
        How often a row counts; 1 if not given.
    """

    blocks: dict[str, np.ndarray]
    tire: np.ndarray
    files: np.ndarray
    weight: np.ndarray | None = None


@dataclass(frozen=True)
class Fitted:
    """Posterior of the weights of one response.

    Attributes
    ----------
    variances : dict of str to float
        By block, and ``tire``, ``tire_category`` and ``noise``.
    mean : ndarray, shape (m,)
        Weights, blocks in their order, then tires.
    covariance : ndarray, shape (m, m)
    """

    variances: dict[str, float]
    mean: np.ndarray
    covariance: np.ndarray


def _stack(design: Design) -> np.ndarray:
    return np.concatenate([*design.blocks.values(), design.tire], axis=1)


class MarginalLikelihood:
    """Negative log marginal likelihood and its gradient by the logarithms of the variances."""

    def __init__(self, design: Design, response: np.ndarray, noise: float) -> None:
        self.x, self.y = _stack(design), response
        self.names = [*design.blocks, "tire"]
        sizes = [block.shape[1] for block in design.blocks.values()] + [design.tire.shape[1]]
        self.ends = np.cumsum(sizes)
        self.starts = self.ends - sizes
        self.alone = (design.tire.sum(axis=1) == 0).astype(float)
        self.fixed = noise / design.files
        self.weight = np.ones(len(response)) if design.weight is None else design.weight

    def posterior(self, logs: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
        """Return the posterior of the p weights for some variances.

        Parameters
        ----------
        logs : ndarray, shape (v,)
            Logarithms of the variances.

        Returns
        -------
        mean : ndarray, shape (p,)
        covariance : ndarray, shape (p, p)
        rest : ndarray, shape (n,)
            Variance of each row that the weights leave.
        value : float
            The negative logarithm of the marginal likelihood, up to a constant.
        """
        variances = np.exp(logs)
        prior = np.concatenate(
            [np.full(e - s, v) for s, e, v in zip(self.starts, self.ends, variances[:-1], strict=True)]
        )
        rest = self.alone * variances[-2] + variances[-1] + self.fixed
        weighted = self.x * (self.weight / rest)[:, None]
        precision = self.x.T @ weighted
        precision[np.diag_indices_from(precision)] += 1.0 / prior
        factor = cho_factor(precision, lower=True)
        covariance = cho_solve(factor, np.eye(prior.size))
        mean = covariance @ (weighted.T @ self.y)
        gap = self.y - self.x @ mean
        value = 0.5 * ((self.weight * (gap**2 / rest + np.log(rest))).sum() + (mean**2 / prior).sum())
        value += 0.5 * np.log(prior).sum() + np.log(np.diag(factor[0])).sum()
        return mean, covariance, rest, float(value)

    def value_and_gradient(self, logs: np.ndarray) -> tuple[float, np.ndarray]:
        """Return the value and its gradient by the logarithms of the variances, (v,)."""
        mean, covariance, rest, value = self.posterior(logs)
        variances = np.exp(logs)
        square = mean**2 + np.diag(covariance)
        slope = np.empty_like(logs)
        for k, (start, end) in enumerate(zip(self.starts, self.ends, strict=True)):
            slope[k] = 0.5 * ((end - start) - square[start:end].sum() / variances[k])
        gap = self.y - self.x @ mean
        second = gap**2 + np.einsum("ij,ij->i", self.x @ covariance, self.x)
        by_rest = 0.5 * self.weight * (1.0 / rest - second / rest**2)
        slope[-2] += (by_rest * self.alone).sum() * variances[-2]
        slope[-1] = by_rest.sum() * variances[-1]
        return value, slope


def fit_mixed_effects(
    design: Design,
    response: np.ndarray,
    *,
    noise: float,
    guess: dict[str, float],
    width: Mapping[str, float] | float = 3.0,
    tire_category: float | None = None,
) -> Fitted:
    """Find the variances, then the weights.

    Parameters
    ----------
    design : Design
    response : ndarray, shape (n,)
        Of variance about 1.
    noise : float
        Variance of one file's measurement noise, from repeats.
    guess : dict of float
        Expected variance by block, and ``tire`` and ``tire_category``: centre of a prior.
    width : float or dict of float
        Standard deviation of that prior on the logarithm of a variance.
    tire_category : float, optional
        Variance of what one tire does in one category only; without it, it is estimated, which takes tires
        that several categories measured.

    Returns
    -------
    Fitted
    """
    marginal = MarginalLikelihood(design, response, noise)
    names = [*marginal.names, "tire_category"]
    centre = np.log([guess[name] if name != "level" else _FLAT for name in names])
    bounds = [(_LOW, _HIGH)] * len(names)
    bounds[names.index("level")] = (np.log(_FLAT), np.log(_FLAT))
    if tire_category is not None:
        centre[-1] = np.log(tire_category)
        bounds[-1] = (centre[-1], centre[-1])

    widths = np.array([width if isinstance(width, float) else width[name] for name in names])

    def objective(logs: np.ndarray) -> tuple[float, np.ndarray]:
        value, slope = marginal.value_and_gradient(logs)
        apart = (logs - centre) / widths
        return value + 0.5 * float(apart @ apart), slope + apart / widths

    found = minimize(
        objective, centre, jac=True, method="L-BFGS-B", bounds=bounds, options={"maxiter": 40, "ftol": 1e-7}
    )
    mean, covariance, _, _ = marginal.posterior(found.x)
    variances = dict(zip(names, np.exp(found.x), strict=True))
    return Fitted({**variances, "noise": noise}, mean, covariance)


def posterior_weights(design: Design, response: np.ndarray, variances: Mapping[str, float]) -> Fitted:
    """Find the weights for variances that are known.

    Parameters
    ----------
    design : Design
    response : ndarray, shape (n,)
    variances : dict of float
        As in :attr:`Fitted.variances`.

    Returns
    -------
    Fitted
    """
    marginal = MarginalLikelihood(design, response, variances["noise"])
    logs = np.log([variances[name] for name in (*marginal.names, "tire_category")])
    mean, covariance, _, _ = marginal.posterior(logs)
    return Fitted(dict(variances), mean, covariance)
