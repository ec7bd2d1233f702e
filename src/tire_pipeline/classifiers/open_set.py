"""Assign a file to a known supplier, or to none: a calibrated probability and a test of typicality.

A probability among known categories knows nothing of unknown ones: of two wrong answers one is always the
more probable. So a file must be typical of the category, too: its distance to the category's mean, in the
deviations that files of one category have (Mahalanobis; Lee et al. 2018 use it so for networks), may not be
among the largest that files of tires left out had to their own (a conformal p-value; Vovk, Gammerman and
Shafer 2005).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.numerics.row_products import by_group, by_row

LEAST_PROBABILITY = 0.95
"""A file is given to a category from this calibrated probability on."""

LEAST_TYPICALITY = 0.10
"""And if at least this share of the category's own files, tires left out, lies as far from its mean or
farther: that share of the files of known suppliers is turned away."""

OPEN_SET_FOLDS = 5
_LEAST_SCALE = 0.01  # of the magnitude: what never varies counts as varying by that much


@dataclass(frozen=True)
class Assignment:
    """The supplier of each file.

    Attributes
    ----------
    category : ndarray of str, shape (n,)
        The most probable one.
    probability : ndarray, shape (n,)
        Calibrated; right if the supplier is among the known ones.
    typicality : ndarray, shape (n,)
        Conformal p-value of the file among those of ``category``.
    """

    category: np.ndarray
    probability: np.ndarray
    typicality: np.ndarray

    @property
    def given(self) -> np.ndarray:
        """Whether a file may be called the category's, (n,)."""
        return (self.probability >= LEAST_PROBABILITY) & (self.typicality >= LEAST_TYPICALITY)


class OpenSetClassifier:
    """Linear discriminant analysis with calibrated probabilities, and a distance to each category."""

    def fit(self, features: np.ndarray, labels: np.ndarray, tires: np.ndarray, *, seed: int = 0) -> Self:
        """Learn, and calibrate on tires that are left out.

        Parameters
        ----------
        features : ndarray, shape (n, d)
            Finite, see :func:`.supplier_features.supplier_features`.
        labels : ndarray of str, shape (n,)
        tires : ndarray of str, shape (n,)
            Physical tire of each file: all files of one are left out together.
        seed : int
            Of the folds.

        Raises
        ------
        DomainError
            If there is one category only, or one has fewer than two tires.
        """
        from sklearn.calibration import CalibratedClassifierCV
        from sklearn.discriminant_analysis import LinearDiscriminantAnalysis
        from sklearn.model_selection import StratifiedGroupKFold

        self.classes_, codes = np.unique(np.asarray(labels).astype(str), return_inverse=True)
        self._check(codes, tires)
        folds = StratifiedGroupKFold(_fold_count(codes, tires), shuffle=True, random_state=seed)
        splits = list(folds.split(features, codes, tires))
        self.space = _Space.of(features, codes)
        # equal priors: the number of files that a supplier sent is no evidence
        equal = np.full(self.classes_.size, 1.0 / self.classes_.size)
        linear = LinearDiscriminantAnalysis(solver="lsqr", shrinkage="auto", priors=equal)
        self.calibrated: Any = CalibratedClassifierCV(
            linear, method="temperature", cv=splits, ensemble=False
        ).fit(self.space.scaled(features), codes)
        own = np.zeros(len(codes))
        for train, left in splits:
            distances = _Space.of(features[train], codes[train]).distances(features[left])
            own[left] = distances[np.arange(len(left)), codes[left]]
        self.own = [np.sort(own[codes == k]) for k in range(self.classes_.size)]
        return self

    def _check(self, codes: np.ndarray, tires: np.ndarray) -> None:
        for k, name in enumerate(self.classes_):
            if np.unique(np.asarray(tires)[codes == k]).size < 2:
                raise DomainError(
                    f"category {name} has files of one tire only: how its files vary is not known",
                    todo="give files of more tires, or do not ask for classification",
                )
        if self.classes_.size < 2:
            raise DomainError(
                "there is one category only: nothing can be told apart",
                todo="give training files of a second supplier, or do not ask for classification",
            )

    def assign(self, features: np.ndarray) -> Assignment:
        """Tell the most probable category of each file, and whether it may be called that category's.

        Parameters
        ----------
        features : ndarray, shape (n, d)

        Returns
        -------
        Assignment
        """
        chances = by_group(self.calibrated.predict_proba, self.space.scaled(features))
        best = chances.argmax(axis=1)
        rows = np.arange(len(best))
        distance = self.space.distances(features)[rows, best]
        typicality = [
            (1 + own.size - np.searchsorted(own, far)) / (1 + own.size)
            for far, own in ((far, self.own[k]) for far, k in zip(distance, best, strict=True))
        ]
        return Assignment(self.classes_[best], chances[rows, best], np.array(typicality, dtype=float))


def _fold_count(codes: np.ndarray, tires: np.ndarray) -> int:
    return min(OPEN_SET_FOLDS, *(np.unique(np.asarray(tires)[codes == k]).size for k in np.unique(codes)))


@dataclass(frozen=True)
class _Space:
    """Means of the categories, and how files spread about them."""

    centre: np.ndarray
    scale: np.ndarray
    means: np.ndarray
    precision: np.ndarray

    @classmethod
    def of(cls, features: np.ndarray, codes: np.ndarray) -> Self:
        from sklearn.covariance import LedoitWolf

        names = np.unique(codes)
        means = np.stack([features[codes == k].mean(axis=0) for k in names])
        within = features - means[np.searchsorted(names, codes)]
        centre = features.mean(axis=0)
        least = _LEAST_SCALE * np.abs(features).mean(axis=0)
        scale = np.maximum(within.std(axis=0), least)
        scale[scale == 0.0] = 1.0
        spread = LedoitWolf(assume_centered=True).fit(within / scale)
        return cls(centre, scale, (means - centre) / scale, spread.precision_)

    def scaled(self, features: np.ndarray) -> np.ndarray:
        return (features - self.centre) / self.scale

    def distances(self, features: np.ndarray) -> np.ndarray:
        """Squared Mahalanobis distance to each category, (n, categories)."""
        away = self.scaled(features)[:, None, :] - self.means
        along = by_row(away.reshape(-1, away.shape[2]), self.precision).reshape(away.shape)
        return np.asarray((along * away).sum(axis=2))


def left_out_check(
    features: np.ndarray, labels: np.ndarray, tires: np.ndarray, *, seed: int = 0
) -> pd.DataFrame:
    """Check the classifier on suppliers it knows, tires left out, and on each one it has never seen.

    Parameters
    ----------
    features, labels, tires, seed
        As for :meth:`OpenSetClassifier.fit`; at least three categories.

    Returns
    -------
    DataFrame
        One row a category: ``category``, ``files``, ``right`` (share of its files, tires left out, that are
        given to it), ``wrong`` (that are given to another), ``given_when_unseen`` (share of its files that
        are given to another when no file of the category was learned from).
    """
    from sklearn.model_selection import StratifiedGroupKFold

    labels = np.asarray(labels).astype(str)
    names, codes = np.unique(labels, return_inverse=True)
    right, wrong = np.zeros(len(labels), dtype=bool), np.zeros(len(labels), dtype=bool)
    folds = StratifiedGroupKFold(_fold_count(codes, tires), shuffle=True, random_state=seed + 1)
    for train, left in folds.split(features, codes, tires):
        model = OpenSetClassifier().fit(features[train], labels[train], tires[train], seed=seed)
        found = model.assign(features[left])
        right[left] = found.given & (found.category == labels[left])
        wrong[left] = found.given & (found.category != labels[left])
    rows = []
    for name in names:
        own = labels == name
        model = OpenSetClassifier().fit(features[~own], labels[~own], tires[~own], seed=seed)
        unseen = model.assign(features[own]).given
        rows.append((name, int(own.sum()), right[own].mean(), wrong[own].mean(), unseen.mean()))
    return pd.DataFrame(rows, columns=["category", "files", "right", "wrong", "given_when_unseen"])
