"""Find from training files in which few numbers tires' curves differ.

Noise shows in files of one tire in one category. What is a tire's own is what category and metadata leave.
"""

from __future__ import annotations

import logging
import warnings
from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.linalg import eigh

from tire_pipeline.errors import DomainError
from tire_pipeline.progress import track
from tire_pipeline.tire_table import LARGEST_TO_SQUARE, told_tires
from tire_pipeline.translation.curves.features import encode
from tire_pipeline.translation.curves.space import PARTS, UNIT, CurveSpace
from tire_pipeline.translation.population.metadata import Metadata

_LOG = logging.getLogger(__name__)
_USUAL_SHARE = 0.6  # of repeats, from which the noise is found
_NOMINAL = 0.01  # of the logarithm of test over nominal pressure
_FEWEST_REPEATS = 4  # files of a cell tell its noise
_NOISE_SHARE = 0.05  # of the spread between tires, where no tire has three files in one category


@dataclass(frozen=True)
class Cells:
    """Files of one tire in one category, averaged.

    Attributes
    ----------
    row : ndarray of int, shape (c,)
        A file of each cell, for its category, tire and metadata.
    scores : ndarray, shape (c, p)
        Robust mean of its files' scores, corrected to nominal pressure.
    files : ndarray, shape (c,)
        How many files.
    cell : ndarray of int, shape (n,)
        The cell of each file.
    repeats : ndarray, shape (m, p)
        Scores less their cell's, of the files at nominal pressure in cells of four or more.
    """

    row: np.ndarray
    scores: np.ndarray
    files: np.ndarray
    cell: np.ndarray
    repeats: np.ndarray


def with_finite_curves(table: pd.DataFrame) -> pd.DataFrame:
    """Leave out files whose values overflow in the equations, and say which they are.

    Parameters
    ----------
    table : DataFrame
        Tire table.
    """
    sizes = (np.abs(values) for values in encode(table).values())
    finite = np.all([(size < LARGEST_TO_SQUARE).all(axis=1) for size in sizes], axis=0)
    for file in table.loc[~finite, "file"]:
        _LOG.warning("%s is not learned from: its curves overflow", file)
    return table[finite]


def fit_curve_space(table: pd.DataFrame) -> tuple[CurveSpace, Cells]:
    """Learn the components from training files, and average the files of each cell.

    Parameters
    ----------
    table : DataFrame
        Tire table with ``category``, ``tire_id`` and, where known, ``INFLPRES`` and ``NOMPRES``.

    Returns
    -------
    CurveSpace, Cells

    Raises
    ------
    DomainError
        If a tire's curves cannot be evaluated.
    """
    key = table["category"].astype(str) + "|" + told_tires(table)
    _, row, cell = np.unique(key.to_numpy(dtype=str), return_index=True, return_inverse=True)
    over = _over_pressure(table)
    known = _known(table.iloc[row])
    parts: dict[str, tuple[np.ndarray, ...]] = {}
    scores, apart, noise = [], [], []
    features = encode(table)
    for name, part in track(PARTS.items(), "finding how curves differ"):
        values = features[part.group][:, part.columns] / UNIT[part.group]
        if not np.isfinite(values).all():
            bad = table["file"].iloc[int(np.flatnonzero(~np.isfinite(values).all(axis=1))[0])]
            raise DomainError(f"the curves of {bad} are not finite", todo="drop the file")
        *fitted, own, left, spread = _fit_part(values, cell, over, known, part.components)
        parts[name] = tuple(fitted)
        scores.append(own)
        apart.append(left)
        noise.append(spread)
    mean, onto, back, limit = ({name: found[k] for name, found in parts.items()} for k in range(4))
    files = np.bincount(cell)
    repeated = (np.abs(over) < _NOMINAL) & (files[cell] >= _FEWEST_REPEATS)
    repeats = np.concatenate(apart, axis=1)[repeated]
    cells = Cells(row, np.concatenate(scores, axis=1), files.astype(float), cell, repeats)
    return CurveSpace(mean, onto, back, limit, np.concatenate(noise)), cells


def _known(cells: pd.DataFrame) -> np.ndarray:
    """What is known of each cell before it is measured: category and metadata, as regressors."""
    category = cells["category"].to_numpy(dtype=str)
    organisations = (category[:, None] == np.unique(category)[None, :]).astype(float)
    metadata = Metadata.fit(cells)
    size = metadata.size_indicators(cells)
    usual = size.sum(axis=0) >= 5
    return np.concatenate([organisations, metadata.regressors(cells), size[:, usual][:, 1:]], axis=1)


def _over_pressure(table: pd.DataFrame) -> np.ndarray:
    """Logarithm of test over nominal pressure, 0 where not known."""
    if "INFLPRES" not in table or "NOMPRES" not in table:
        return np.zeros(len(table))
    ratio = np.asarray(table["INFLPRES"], dtype=float) / np.asarray(table["NOMPRES"], dtype=float)
    return np.where((ratio > 0.3) & (ratio < 3.0), np.log(np.where(ratio > 0.0, ratio, 1.0)), 0.0)


def _cell_means(values: np.ndarray, cell: np.ndarray, weight: np.ndarray | None = None) -> np.ndarray:
    weight = np.ones(len(values)) if weight is None else weight
    total = np.zeros((cell.max() + 1, *values.shape[1:]))
    np.add.at(total, cell, values * weight.reshape(-1, *[1] * (values.ndim - 1)))
    count = np.bincount(cell, weight)
    return total / count.reshape(-1, *[1] * (values.ndim - 1))


def _cell_medians(values: np.ndarray, cell: np.ndarray) -> np.ndarray:
    order = np.argsort(cell, kind="stable")
    places = np.split(order, np.cumsum(np.bincount(cell))[:-1])
    return np.stack([np.median(values[place], axis=0) for place in places])


def _fit_part(
    values: np.ndarray, cell: np.ndarray, over: np.ndarray, known: np.ndarray, components: int
) -> tuple[np.ndarray, ...]:
    """Mean, onto, back, limit, scores of the cells, of each file less its cell's, noise."""
    values = values - over[:, None] * _pressure_slope(values, cell, over)
    middle = _cell_medians(values, cell)
    mean = np.median(middle, axis=0)
    spread = np.maximum(1.4826 * np.median(np.abs(middle - mean), axis=0), 1e-6)
    clipped = np.clip(middle - mean, -6.0 * spread, 6.0 * spread)
    _, _, axes = np.linalg.svd(clipped, full_matrices=False)
    axes = axes[: min(components, len(axes))]
    scores = (values - mean) @ axes.T
    location = _robust_location(scores, cell)
    own = location - known @ np.linalg.lstsq(known, location, rcond=None)[0]
    between = np.atleast_2d(np.cov(np.clip(own, *np.quantile(own, [0.01, 0.99], axis=0)).T))
    usual = np.abs(over) < _NOMINAL
    within = noise_covariance((scores - location[cell])[usual], cell[usual])
    if within is None:
        within = _NOISE_SHARE * between
    within += np.eye(len(within)) * 1e-4 * max(np.trace(between), 1e-6)
    _, turn = eigh(between, within)
    turn = turn[:, ::-1]
    onto = axes.T @ turn
    back = np.linalg.inv(turn) @ axes
    left = (middle - mean) - ((middle - mean) @ onto) @ back
    limit = np.maximum(4.0 * 1.4826 * np.median(np.abs(left), axis=0), 0.05)
    apart = (scores - location[cell]) @ turn
    location = location @ turn
    bound = 6.0 * 1.4826 * np.median(np.abs(location - np.median(location, axis=0)), axis=0) + 3.0
    centre = np.median(location, axis=0)
    location = np.clip(location, centre - bound, centre + bound)
    return mean, onto, back, limit, location, apart, np.ones(onto.shape[1])


def _pressure_slope(values: np.ndarray, cell: np.ndarray, over: np.ndarray) -> np.ndarray:
    """Change of the features with the logarithm of pressure, from differences within cells."""
    apart = over - _cell_means(over, cell)[cell]
    power = float(apart @ apart)
    if power < 1e-6:
        return np.zeros(values.shape[1])
    return apart @ (values - _cell_means(values, cell)[cell]) / power


def _robust_location(scores: np.ndarray, cell: np.ndarray) -> np.ndarray:
    """Location of every cell: files unlike the rest of their cell count little."""
    location = _cell_medians(scores, cell)
    several = np.bincount(cell)[cell] >= 3
    for _ in range(3):
        apart = scores - location[cell]
        scale = np.maximum(1.4826 * np.median(np.abs(apart[several]), axis=0), 1e-6) if several.any() else 1.0
        distance = ((apart / scale) ** 2).mean(axis=1)
        weight = 1.0 / (1.0 + (distance / 2.5) ** 2)
        location = _cell_means(scores, cell, weight)
    return location


def noise_covariance(apart: np.ndarray, cell: np.ndarray) -> np.ndarray | None:
    """Return the covariance of one file about its cell, without worn and odd ones.

    Parameters
    ----------
    apart : ndarray, shape (n, k)
        Each file's scores less the mean of its cell.
    cell : ndarray of int, shape (n,)
        Number of each file's cell.

    Returns
    -------
    ndarray, shape (k, k), or None
        None if too few files repeat. Zero where most files of a cell are alike: copies, or files without
        coefficients for these features.
    """
    from sklearn.covariance import MinCovDet

    count = np.bincount(cell)
    several = count[cell] >= _FEWEST_REPEATS
    if several.sum() < 10 * apart.shape[1]:
        return None
    lost = 1.0 - 1.0 / count[cell[several]].mean()
    try:
        with warnings.catch_warnings():  # files that are nearly alike: what was found best so far is kept
            warnings.filterwarnings("ignore", message="Determinant has increased|The covariance matrix")
            robust = MinCovDet(support_fraction=_USUAL_SHARE, random_state=0).fit(apart[several])
    except ValueError as error:
        if "equal to 0" not in str(error):
            raise
        return np.zeros((apart.shape[1], apart.shape[1]))
    return robust.covariance_ / lost
