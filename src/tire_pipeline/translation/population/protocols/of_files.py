"""Categories that changed how they measure: which, when, and under which protocol a file was measured.

A change is a day. Files of its category from that day on are of the new protocol, files before it of the old
one; a file without a date counts as both, by their shares. Every change is one regressor of the mixed model.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import pandas as pd

_AS_TEXT = ("category", "day", "earliest", "latest")
"""Attributes of a change that are text."""


@dataclass(frozen=True)
class Change:
    """A category's change of protocol.

    Attributes
    ----------
    category : str
    day : str
        First day of the new protocol, ``YYYY-MM-DD``: the most probable one.
    earliest, latest : str
        Days between which it lies with 90% probability.
    probability : float
        That there was a change at all.
    before, after : int
        Dated tires of the category under the old and the new protocol.
    """

    category: str
    day: str
    earliest: str
    latest: str
    probability: float
    before: int
    after: int

    @property
    def share(self) -> float:
        """Share of the tires under the new protocol."""
        return self.after / (self.before + self.after)


@dataclass(frozen=True)
class Protocols:
    """All changes that were found; none: every category has one protocol.

    Attributes
    ----------
    changes : tuple of Change
        At most one a category.
    """

    changes: tuple[Change, ...] = ()

    def code(self, table: pd.DataFrame) -> np.ndarray:
        """Regressors of n files, (n, changes), by their categories and dates.

        Zero for files of other categories and for files without a date: the mean of both protocols. Else the
        file's protocol, new 1 or old 0, less the share of the new one among the training tires.
        """
        code = np.zeros((len(table), len(self.changes)))
        days = days_of(table)
        category = table["category"].to_numpy(dtype=str)
        for k, change in enumerate(self.changes):
            own = (category == change.category) & ~np.isnat(days)
            code[own, k] = (days[own] >= np.datetime64(change.day)) - change.share
        return code

    def unsure(self, table: pd.DataFrame) -> np.ndarray:
        """Variance of what :meth:`code` should have been, (n, changes): 0 but for files without a date."""
        undated = np.isnat(days_of(table))
        category = table["category"].to_numpy(dtype=str)
        spread = [(undated & (category == c.category)) * c.share * (1.0 - c.share) for c in self.changes]
        return np.stack(spread, axis=1) if spread else np.zeros((len(table), 0))

    def newest(self, category: str, count: int) -> np.ndarray:
        """Regressors, (count, changes), of what ``category`` would measure now: by its newest protocol."""
        now = [(1.0 - one.share) * (one.category == category) for one in self.changes]
        return np.tile(np.array(now), (count, 1))

    def in_words(self, table: pd.DataFrame) -> np.ndarray:
        """Say under which protocol each of n files was measured; "" where its category has but one."""
        said = np.full(len(table), "", dtype=object)
        days = days_of(table)
        category = table["category"].to_numpy(dtype=str)
        for change in self.changes:
            own = category == change.category
            new = days >= np.datetime64(change.day)
            said[own] = np.where(new[own], f"from {change.day} on", f"before {change.day}")
            said[own & np.isnat(days)] = f"no date: mean of before and from {change.day} on"
        return said

    def to_state(self) -> dict[str, Any]:
        """Return the arrays that restore it."""
        return {
            **{f"protocol_{n}": np.array([getattr(c, n) for c in self.changes], dtype=str) for n in _AS_TEXT},
            "protocol_probability": np.array([c.probability for c in self.changes], dtype=float),
            "protocol_tires": np.array([(c.before, c.after) for c in self.changes], dtype=int).reshape(-1, 2),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned; states from before there were protocols have none."""
        if "protocol_category" not in state:
            return cls()
        rows = zip(
            *(state[f"protocol_{name}"] for name in _AS_TEXT),
            state["protocol_probability"],
            state["protocol_tires"],
            strict=True,
        )
        return cls(
            tuple(
                Change(str(name), str(day), str(low), str(high), float(chance), int(tires[0]), int(tires[1]))
                for name, day, low, high, chance, tires in rows
            )
        )


NO_PROTOCOL_CHANGE = Protocols()
"""No category changed its protocol."""


def days_of(table: pd.DataFrame) -> np.ndarray:
    """Day of each file from the column ``date`` (``YYYY-MM-DD``), datetime64[D]; NaT where there is none."""
    if "date" not in table:
        return np.full(len(table), np.datetime64("NaT", "D"))
    found = pd.to_datetime(table["date"], format="%Y-%m-%d", errors="coerce")
    return np.asarray(found.to_numpy(dtype="datetime64[D]"))
