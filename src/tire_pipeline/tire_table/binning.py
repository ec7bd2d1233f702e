"""Features as bin numbers, scaled by the training set (thesis, section 4.1.1 and Table 2.5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, cast

import numpy as np
import numpy.typing as npt

from tire_pipeline.errors import DomainError

Kind = Literal["equal_width", "equal_frequency"]
BinningState = dict[str, np.ndarray | str | int | float]


@dataclass(frozen=True)
class Binning:
    """How each feature becomes a bin number, and a bin number a value.

    Parameters
    ----------
    names : tuple of str
        The features, in column order.
    low, high : float arrays, shape (features,)
        Smallest and largest value in the training set: they become 0 and 1.
    edges : float array, shape (features, bins + 1)
        Edges of the bins on the scaled feature; the first is 0, the last 1.
    kind : str
        ``"equal_width"`` or ``"equal_frequency"``.
    """

    names: tuple[str, ...]
    low: np.ndarray
    high: np.ndarray
    edges: np.ndarray
    kind: Kind = "equal_width"

    @property
    def n_bins(self) -> int:
        """Bins a feature."""
        return self.edges.shape[1] - 1

    @classmethod
    def fit(
        cls,
        values: npt.ArrayLike,
        n_bins: int,
        kind: Kind = "equal_width",
        names: Sequence[str] | None = None,
    ) -> Binning:
        """Find range and edges on the training set.

        Parameters
        ----------
        values : array_like, shape (rows, features)
        n_bins : int
        kind : str
            ``"equal_width"``: all bins of a feature are as wide. ``"equal_frequency"``: the edges are
            quantiles, so that all bins hold about as many training rows (fewer in some where many values are
            equal).
        names : sequence of str, optional
            ``f0``, ``f1``... if left out.

        Raises
        ------
        DomainError
            No rows, a value that is not finite, fewer than 1 bin, or a kind that is not known.
        """
        data = _checked(values)
        if len(data) == 0 or n_bins < 1:
            raise DomainError(
                f"{len(data)} rows cannot be put into {n_bins} bins", todo="give at least one of each"
            )
        low, high = data.min(axis=0), data.max(axis=0)
        steps = np.linspace(0.0, 1.0, n_bins + 1)
        if kind == "equal_width":
            edges = np.tile(steps, (data.shape[1], 1))
        elif kind == "equal_frequency":
            edges = np.quantile(_scaled(data, low, high), steps, axis=0).T
            edges[:, 0], edges[:, -1] = 0.0, 1.0
        else:
            raise DomainError(
                f"bins of kind {kind!r} are not known", todo="use equal_width or equal_frequency"
            )
        labels = tuple(names) if names is not None else tuple(f"f{i}" for i in range(data.shape[1]))
        return cls(labels, low, high, edges, kind)

    def scale(self, values: npt.ArrayLike) -> np.ndarray:
        """Return the features scaled so that the training set spans 0 to 1; a constant feature becomes 0."""
        return _scaled(_checked(values, len(self.low)), self.low, self.high)

    def transform(self, values: npt.ArrayLike) -> np.ndarray:
        """Return bin numbers 0 to ``n_bins - 1``, shape (rows, features), int64.

        A value outside of the training set's range goes to the first or last bin; one on an edge to the
        upper bin.

        Raises
        ------
        DomainError
            A value is not finite, or the number of features is not the one of the training set.
        """
        scaled = self.scale(values)
        bins = np.empty(scaled.shape, dtype=np.int64)
        for i, edges in enumerate(self.edges):
            bins[:, i] = np.searchsorted(edges[1:-1], scaled[:, i], side="right")
        return bins

    def inverse(self, bins: npt.ArrayLike) -> np.ndarray:
        """Return the value at the centre of each bin, shape (rows, features), in the features' own units.

        Raises
        ------
        DomainError
            A bin number outside 0 to ``n_bins - 1``.
        """
        numbers = np.atleast_2d(np.asarray(bins))
        if numbers.size and (numbers.min() < 0 or numbers.max() >= self.n_bins):
            raise DomainError(f"bin numbers must lie in 0 to {self.n_bins - 1}")
        centres = (self.edges[:, :-1] + self.edges[:, 1:]) / 2.0
        scaled = centres[np.arange(numbers.shape[1]), numbers.astype(np.int64)]
        return self.low + scaled * (self.high - self.low)

    def to_state(self) -> BinningState:
        """Return all of it as arrays and text, for JSON or NPZ."""
        return {
            "names": np.array(self.names, dtype=np.str_),
            "low": self.low,
            "high": self.high,
            "edges": self.edges,
            "kind": self.kind,
        }

    @classmethod
    def from_state(cls, state: Mapping[str, object]) -> Binning:
        """Build it from what ``to_state`` gave.

        Raises
        ------
        DomainError
            Something is missing or its shape does not fit.
        """
        try:
            names = tuple(str(each) for each in np.asarray(state["names"]).ravel())
            low, high, edges = (np.asarray(state[key], dtype=float) for key in ("low", "high", "edges"))
            kind = str(state["kind"])
        except (KeyError, TypeError, ValueError) as error:
            raise DomainError(f"this is not the state of a binning ({error})") from error
        fits = low.shape == high.shape == (len(names),) and edges.ndim == 2 and len(edges) == len(names)
        finite = fits and all(np.isfinite(each).all() for each in (low, high, edges))
        if not finite or edges.shape[1] < 2 or kind not in ("equal_width", "equal_frequency"):
            raise DomainError("this is not the state of a binning", todo="fit it again")
        return cls(names, low, high, edges, cast(Kind, kind))


def _checked(values: npt.ArrayLike, features: int | None = None) -> np.ndarray:
    data = np.asarray(values, dtype=float)
    if data.ndim != 2 or (features is not None and data.shape[1] != features):
        wanted = "rows x features" if features is None else f"rows x {features}"
        raise DomainError(f"features of shape {data.shape} where {wanted} is needed")
    if not np.isfinite(data).all():
        raise DomainError("a feature has no value in some row", todo="drop those rows before binning")
    return data


def _scaled(data: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    width = high - low
    return (data - low) / np.where(width > 0, width, 1.0)
