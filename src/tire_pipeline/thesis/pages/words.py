"""Numbers as words: every sentence of the page is made from the numbers it is about."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence

import pandas as pd

from tire_pipeline.pages.numbers_in_words import in_digits


def plus_minus(value: float, spread: float, digits: int = 3) -> str:
    """Return a value with its spread to the same decimals.

    These are the decimals of two digits of the spread, but the value has no more digits than ``digits``.

    Examples
    --------
    >>> plus_minus(0.17, 0.0047), plus_minus(2.912, 2.4), plus_minus(0.17, float("nan"))
    ('0.170 ± 0.005', '2.9 ± 2.4', '0.17')
    >>> plus_minus(0.99772, 0.00022)
    '0.998 ± <0.001'
    """
    if pd.isna(value) or pd.isna(spread) or spread == 0.0:
        return in_digits(value, digits)  # of one training, or the same in all
    of_spread = max(0, 1 - math.floor(math.log10(abs(spread))))
    most = max(0, digits - 1 - math.floor(math.log10(max(abs(value), abs(spread)))))
    decimals = min(of_spread, most)
    seen = f"{spread:,.{decimals}f}" if round(spread, decimals) else f"<{10.0**-decimals:.{decimals}f}"
    return f"{value:,.{decimals}f} ± {seen}"


def points(ours: float, theirs: float) -> str:
    """How far a share is from the thesis', in percentage points."""
    gap = (ours - theirs) * 100
    if abs(gap) < 0.05:
        return "the same as in the thesis"
    return f"{abs(gap):.1f} percentage points {'above' if gap > 0 else 'below'} the thesis"


def action_in_words(action: str) -> str:
    """Return an agent's action with the load that a key attribute belongs to.

    Examples
    --------
    >>> action_in_words("peak_slip_angle_4000_up"), action_in_words("PEY2_up")
    ('peak slip angle at 4000 N up', 'PEY2 up')
    """
    return re.sub(r"_(\d+)_", r" at \1 N ", action).replace("_", " ")


def listed(names: Iterable[str]) -> str:
    """a, b and c."""
    items = list(names)
    if len(items) < 2:
        return "".join(items) or "none"
    return f"{', '.join(items[:-1])} and {items[-1]}"


def rank_agreement(first: Sequence[float], second: Sequence[float]) -> float:
    """Spearman's rank correlation; NaN if there are fewer than three pairs or one side is constant."""
    pairs = pd.DataFrame({"a": first, "b": second}).dropna()
    if len(pairs) < 3 or pairs["a"].nunique() < 2 or pairs["b"].nunique() < 2:
        return float("nan")
    ranks = pairs.rank()
    return float(ranks["a"].corr(ranks["b"]))


def agreement(value: float) -> str:
    """A rank correlation in words."""
    if pd.isna(value):
        return "too few configurations were run to compare their order"
    kind = "the same" if value > 0.7 else "a similar" if value > 0.3 else "another"
    if value < -0.3:
        kind = "nearly the opposite"
    return f"the configurations come in {kind} order (rank correlation {value:.2f})"


def least_within(frame: pd.DataFrame, over: str, *, margin: float = 0.005) -> int:
    """Where a curve levels off: the least ``over`` whose accuracy is within ``margin`` of the best."""
    near = frame[frame["accuracy"] >= frame["accuracy"].max() - margin]
    return int(near[over].min())
