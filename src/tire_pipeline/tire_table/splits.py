"""Training and test sets: at random as in the thesis, and by physical tire."""

from __future__ import annotations

import warnings

import numpy as np
import numpy.typing as npt
import pandas as pd

from tire_pipeline.errors import DomainError

Rows = npt.NDArray[np.intp]


def random_split(categories: npt.ArrayLike, *, seed: int, test_share: float = 0.2) -> tuple[Rows, Rows]:
    """Split rows at random with the same shares of categories on both sides (thesis, section 4.1.2).

    Variants of one physical tire fall on both sides, so the accuracy on the test set says little about a new
    tire: see :func:`split_by_tire`.

    Parameters
    ----------
    categories : array_like of str, shape (n,)
    seed : int
    test_share : float

    Returns
    -------
    train, test : int arrays
        Row numbers, ascending.

    Raises
    ------
    DomainError
        A category has a single row, or a side would have fewer rows than there are categories.
    """
    from sklearn.model_selection import StratifiedShuffleSplit  # slow to import

    labels = np.asarray(categories)
    split = StratifiedShuffleSplit(n_splits=1, test_size=test_share, random_state=seed)
    try:
        train, test = next(split.split(np.zeros(len(labels)), labels))
    except ValueError as error:
        raise DomainError(
            f"the files cannot be split into training and test set: {error}",
            todo="give more files of each category",
        ) from error
    return np.sort(train), np.sort(test)


def split_by_tire(
    categories: npt.ArrayLike, tires: npt.ArrayLike, *, seed: int, test_share: float = 0.2
) -> tuple[Rows, Rows]:
    """Split rows so that no physical tire is on both sides, with nearly the same shares of categories.

    Parameters
    ----------
    categories : array_like of str, shape (n,)
    tires : array_like of str, shape (n,)
        ``tire_id`` of each row.
    seed : int
    test_share : float
        Of one over a whole number: 0.5, 0.33, 0.25, 0.2, 0.1...

    Returns
    -------
    train, test : int arrays
        Row numbers, ascending.

    Raises
    ------
    DomainError
        There are fewer tires than parts (1 / ``test_share``).
    """
    from sklearn.model_selection import StratifiedGroupKFold  # slow to import

    labels, groups = np.asarray(categories), np.asarray(tires)
    parts = round(1.0 / test_share)
    count = len(np.unique(groups))
    if parts < 2 or count < parts:
        raise DomainError(
            f"{count} physical tires cannot be split into training and test set of {test_share:.0%}",
            todo="give files of more tires, with their size and mass in [DIMENSION] and [INERTIA]",
        )
    split = StratifiedGroupKFold(n_splits=parts, shuffle=True, random_state=seed)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="The least populated class")
        try:
            train, test = next(split.split(np.zeros(len(labels)), labels, groups))
        except ValueError as error:
            raise DomainError(
                f"the tires cannot be split into training and test set: {error}",
                todo="give files of more tires of each category",
            ) from error
    return np.sort(train), np.sort(test)


def split_table(table: pd.DataFrame, *, seed: int, test_share: float = 0.2) -> pd.DataFrame:
    """Return both splits of a tire table.

    Parameters
    ----------
    table : DataFrame
        Has ``file``, ``category`` and ``tire_id``.
    seed : int
    test_share : float

    Returns
    -------
    DataFrame
        ``file``, ``random`` and ``by_tire``, each ``"train"`` or ``"test"``, in the table's order.
    """
    categories, tires = table["category"].to_numpy(), table["tire_id"].to_numpy()
    result = table[["file"]].reset_index(drop=True)
    _, random_test = random_split(categories, seed=seed, test_share=test_share)
    _, tire_test = split_by_tire(categories, tires, seed=seed, test_share=test_share)
    for name, test in (("random", random_test), ("by_tire", tire_test)):
        side = np.full(len(table), "train", dtype=object)
        side[test] = "test"
        result[name] = pd.Series(side, dtype="str")
    return result
