"""Where the search for classes begins: expectation maximisation climbs to the nearest top only.

Groups of all tires together are wrong where a category moves one class more than another; groups within one
category are free of that, and the others follow by the metadata; and the classes of a search for one class
fewer, one of them split, find what both overlook (Ueda et al. 2000, *SMEM algorithm for mixture models*).
The evidence decides between the tops.
"""

from __future__ import annotations

import numpy as np

from tire_pipeline.translation.population.classes.search_input import ClassSearchInput, per_tire
from tire_pipeline.translation.population.classes.tire_classes import fit_shares, log_shares
from tire_pipeline.translation.population.mixed_effects import posterior_weights

_CLUSTERINGS = 2  # of each clustering, of which the best counts
_TIRES_A_GROUP = 10  # fewer tires of a category tell no groups within it
_LEAST_SPLIT = 8  # tires of a class that is split


def starts(question: ClassSearchInput, count: int, fewer: np.ndarray | None, seed: int) -> list[np.ndarray]:
    """Return probabilities of classes to begin with.

    Parameters
    ----------
    question : ClassSearchInput
    count : int
        Number of classes k.
    fewer : ndarray, shape (n, k - 1), optional
        Probabilities that the search for one class fewer came to.
    seed : int
        Of the clusterings.

    Returns
    -------
    list of ndarray, each (n, k)
    """
    if count == 1:
        return [np.ones((len(question.response), 1))]
    gap = _unexplained(question)
    organisation = per_tire(question.design.blocks["category"], question.tire)
    found = [*_of_all(gap, count, seed), *_of_one_category(question, gap, organisation, count, seed)]
    if fewer is not None and count > 2:
        found += _split(gap, organisation.argmax(axis=1), per_tire(fewer, question.tire), seed)
    return [each[question.tire] for each in found]


def _unexplained(question: ClassSearchInput) -> np.ndarray:
    """What the category leaves unexplained of each tire, (tires, q)."""
    fitted = [
        posterior_weights(question.design, y, v)
        for y, v in zip(question.response.T, question.variances, strict=True)
    ]
    blocks = question.design.blocks
    known = np.concatenate(
        [b if name in ("level", "category") else np.zeros_like(b) for name, b in blocks.items()], axis=1
    )
    gap = question.response - np.stack([known @ f.mean[: known.shape[1]] for f in fitted], axis=1)
    gap = per_tire(gap, question.tire)
    spread = gap.std(axis=0)
    return np.clip(gap, -4.0 * spread, 4.0 * spread)


def _groups(gap: np.ndarray, count: int, seed: int) -> np.ndarray:
    from sklearn.mixture import GaussianMixture

    mixture = GaussianMixture(count, covariance_type="diag", n_init=_CLUSTERINGS, random_state=seed)
    return np.asarray(mixture.fit(gap).predict_proba(gap))


def _nearest_mean(gap: np.ndarray, count: int, seed: int) -> np.ndarray:
    from sklearn.cluster import KMeans

    return np.asarray(KMeans(count, n_init=_CLUSTERINGS, random_state=seed).fit_predict(gap))


def _of_all(gap: np.ndarray, count: int, seed: int) -> list[np.ndarray]:
    means = _nearest_mean(gap, count, seed)
    return [np.eye(count)[means], _groups(gap, count, seed)]


def _of_one_category(
    question: ClassSearchInput, gap: np.ndarray, organisation: np.ndarray, count: int, seed: int
) -> list[np.ndarray]:
    """Groups within each category that has tires enough; shares by the metadata for everyone else's."""
    metadata = question.metadata[question.one_cell]
    found = []
    for own in (organisation > 0.0).T:
        if own.sum() < _TIRES_A_GROUP * count:
            continue
        groups = _groups(gap[own], count, seed)
        probability = np.exp(log_shares(metadata, fit_shares(metadata[own], groups)))
        probability[own] = groups
        found.append(probability)
    return found


def _split(gap: np.ndarray, organisation: np.ndarray, fewer: np.ndarray, seed: int) -> list[np.ndarray]:
    """Split each class in two, one after the other, by how its tires differ within their categories."""
    kind = fewer.argmax(axis=1)
    found = []
    for k in range(fewer.shape[1]):
        own = np.flatnonzero(kind == k)
        if own.size < _LEAST_SPLIT:
            continue
        apart = gap[own]
        for category in np.unique(organisation[own]):
            mine = organisation[own] == category
            apart[mine] -= apart[mine].mean(axis=0)
        half = _nearest_mean(apart / np.maximum(apart.std(axis=0), 1e-9), 2, seed)
        cut = np.concatenate([fewer, np.zeros((len(fewer), 1))], axis=1)
        moved = own[half == 1]
        cut[moved, -1], cut[moved, k] = fewer[moved, k], 0.0
        found.append(cut)
    return found
