"""Units that change within a recording: one channel jumps by the ratio of two units."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations
from typing import NamedTuple

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_CHANNELS, FORCE_OF_SLIP, SLIP_OF_FORCE
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.recordings.conventions.channel_names import CANONICAL, Channel
from tire_pipeline.recordings.conventions.units import UNITS_BY_NAME, find_unit

_JUMP_UNITS = {
    "force": ("N", "kN", "lbf"),
    "moment": ("N-m", "kNm", "in-lb"),
    "angle": ("rad", "deg"),
    "ratio": ("-", "%"),
    "pressure": ("Pa", "kPa", "bar", "psi"),
}
"""Dimension -> units in which recordings come."""
_BY_FRICTION = tuple(
    find_unit(one).factor / find_unit(other).factor  # type: ignore[union-attr]
    for one, other in (("ft-lb", "N-m"), ("kgf", "lbf"), ("kgf", "N"))
)
"""Ratios that are told as no unit, whichever of the two a file states: friction, camber or the sign of the
slip may change a force or a moment by as much (1.36, 2.2; 9.8, as from dry road to ice)."""
_DRIVEN_BY = {
    **{force: (slip, "normal_load") for force, slip in SLIP_OF_FORCE.items()},
    **{slip: (force, "normal_load") for slip, force in FORCE_OF_SLIP.items()},
    "normal_load": ("fy", "slip_angle"),
    "pressure": (),
}
"""Channel -> those that have to be the same on both sides of a jump. No run changes the pressure sixfold."""
_JUMP_FEWEST = 15
_JUMP_SHARE = 0.03
"""Rows of a stretch at least, and their share of all."""
_JUMP_CLEAR = 0.3
"""Force over the largest, from which it tells of the slip and the load."""
_JUMP_MOST_ROWS = 400
"""Rows of each side that are compared."""
_JUMP_NEAR = 0.12
"""Distance of two rows with the same conditions, over the size of these."""
_JUMP_WITHIN_SMALL, _JUMP_WITHIN_LARGE, _JUMP_LARGE = 0.06, 0.15, 20.0
"""How far a jump may be from the ratio of two units, of its logarithm, below and above a ratio."""
_JUMP_SCATTER = 0.4
"""Of the logarithms of the ratios of pairs, between quartiles, at most."""
_JUMP_ALIKE = 0.2
"""Of the logarithms of the ratios of small and of large values, at most."""
_JUMP_DEPTH = 4
"""How often a stretch is divided."""
_JUMP_SAME_RATIO, _JUMP_SAME_ROWS = 0.3, 0.1
"""Two jumps are one, seen from two channels, if their ratios are inverse (of the logarithm) and their rows
are near (share of all)."""
_JUMP_DECIDED = 0.5
"""The levels of channels tell which one jumps, if one reading changes them so much less than the other."""
_JUMP_PARTS = ((0.1, 0.5), (0.5, 10.0))
_JUMP_WHOLE = ((0.1, 10.0),)
"""Of the size of the channel (of a force over its load): small and large values, both of which jump by the
ratio. Friction that changes leaves small slips nearly as they are."""


_JumpRatios = Mapping[float, tuple[str, str]]


class UnitJump(NamedTuple):
    """A row from which on a channel is in another unit.

    Parameters
    ----------
    channel : str
    row : int
        From zero.
    time : float
        Seconds; NaN without a time.
    before, after : str
        Units.
    ratio : float
        Of the values after over those before.
    instead : str
        The other reading, if the recording does not tell which of two channels jumps.
    """

    channel: str
    row: int
    time: float
    before: str
    after: str
    ratio: float
    instead: str = ""

    def __str__(self) -> str:
        when = "" if np.isnan(self.time) else f" ({in_digits(self.time, 6)} s)"
        where = f"about row {self.row}{when}"
        said = f"{self.channel} is in {self.before} up to {where}, and in {self.after} from there on"
        return f"{said}, or {self.instead} (the recording does not tell which)" if self.instead else said


def unit_jumps(recording: pd.DataFrame) -> list[UnitJump]:
    """Find channels whose unit changes within a recording.

    Parameters
    ----------
    recording : DataFrame
        Canonical columns, as they were read.

    Returns
    -------
    list of UnitJump

    Notes
    -----
    A stretch of a channel is divided where the size of its values changes most. Rows of both sides with the
    same slip and load (or force) are compared. The ratio of the values has to be that of two units, of small
    values and of large ones. A force that jumps makes its load seem to jump the other way: of two such jumps
    the one is kept with which the levels of both channels stay nearer to what they were.
    """
    known = {c.name: c for c in CANONICAL}
    held = {n: _numbers(recording, n) for n in {*_DRIVEN_BY, "time"} if n in recording}
    found = []
    for name, others in _DRIVEN_BY.items():
        if name not in held or not set(others) <= set(held):
            continue
        ratios = _ratios(known[name], recording.attrs.get("file_units", {}).get(name))
        table = np.abs(np.column_stack([held[n] for n in (name, *others)]))
        rows = np.flatnonzero(np.isfinite(table).all(axis=1))
        jumps = _divided(table[rows], rows, ratios, _JUMP_DEPTH, of_force=name in FORCE_CHANNELS)
        found += [
            UnitJump(name, row, float(held["time"][row]) if "time" in held else np.nan, *units)
            for row, units in jumps
        ]
    return each_once(sorted(found, key=lambda jump: jump.row), held)


def each_once(jumps: list[UnitJump], held: Mapping[str, np.ndarray]) -> list[UnitJump]:
    """Keep one of two jumps that are the same, seen from a channel and from one that drives it.

    Parameters
    ----------
    jumps : list of UnitJump
    held : mapping of ndarray, shape (n,)
        The channels.
    """
    left = list(jumps)
    for one, two in combinations(jumps, 2):
        if one not in left or two not in left or not _same(one, two, held[one.channel].size):
            continue
        row = (one.row + two.row) // 2
        others = [j.row for j in jumps if j not in (one, two)]
        first = max((r for r in others if r < row), default=0)
        last = min((r for r in others if r > row), default=held[one.channel].size)
        changes = [_change_of_level(held[j.channel], first, row, last) for j in (one, two)]
        jumped = [float(np.log(j.ratio)) for j in (one, two)]
        of_one = abs(changes[0] - jumped[0]) + abs(changes[1])
        of_two = abs(changes[0]) + abs(changes[1] - jumped[1])
        at = left.index(one)
        left.remove(two)
        if of_two < _JUMP_DECIDED * of_one:
            left[at] = two
        elif not of_one < _JUMP_DECIDED * of_two:
            other = f"{two.channel} is in {two.before} before it, and in {two.after} after it"
            left[at] = one._replace(instead=other)
    return left


def _same(one: UnitJump, two: UnitJump, rows: int) -> bool:
    driven = two.channel in _DRIVEN_BY[one.channel] or one.channel in _DRIVEN_BY[two.channel]
    near = abs(one.row - two.row) <= _JUMP_SAME_ROWS * rows
    return driven and near and abs(np.log(one.ratio * two.ratio)) < _JUMP_SAME_RATIO


def _change_of_level(values: np.ndarray, first: int, row: int, last: int) -> float:
    """Return the logarithm of the sizes of a channel after a row, over those before it."""
    before, after = (np.abs(part[np.isfinite(part)]) for part in (values[first:row], values[row:last]))
    if not before.size or not after.size:
        return 0.0
    sizes = [np.maximum(np.quantile(part, [0.5, 0.75, 0.95]), 1e-300) for part in (before, after)]
    return float(np.mean(np.log(sizes[1] / sizes[0])))


def _ratios(channel: Channel, stated: str | None) -> _JumpRatios:
    """Return value after over before -> unit before and after, for the unit that a file states."""
    unit = find_unit(stated) or find_unit(channel.unit)
    assert unit is not None
    own, found = str(stated or channel.unit), dict[float, tuple[str, str]]()
    for other in _JUMP_UNITS.get(channel.dimension, ()):
        of_other = UNITS_BY_NAME[other.lower()].factor
        if not np.any(np.isclose(unit.factor / of_other, (1.0, *_BY_FRICTION))):
            found[unit.factor / of_other] = (own, other)
            found[of_other / unit.factor] = (other, own)
    return found


def _numbers(recording: pd.DataFrame, name: str) -> np.ndarray:
    return pd.to_numeric(recording[name], errors="coerce").to_numpy(dtype=float)


def _divided(
    table: np.ndarray, rows: np.ndarray, ratios: _JumpRatios, depth: int, *, of_force: bool
) -> list[tuple[int, tuple[str, str, float]]]:
    """Return rows from which on the first column is in another unit, and the units."""
    least = max(_JUMP_FEWEST, int(_JUMP_SHARE * len(table)))
    if depth == 0 or len(table) < 2 * least or not ratios:
        return []
    at = _largest_change(_size(table, of_force=of_force), least)
    before = _divided(table[:at], rows[:at], ratios, depth - 1, of_force=of_force)
    after = _divided(table[at:], rows[at:], ratios, depth - 1, of_force=of_force)
    first = int(np.searchsorted(rows, before[-1][0])) if before else 0
    last = int(np.searchsorted(rows, after[0][0])) if after else len(rows)
    ratio = _ratio_at_same_conditions(table[first:at], table[at:last], of_force=of_force)
    units = next((u for r, u in ratios.items() if ratio and abs(np.log(ratio / r)) < _within(r)), None)
    return [*before, *([(int(rows[at]), (*units, ratio))] if units else []), *after]


def _size(table: np.ndarray, *, of_force: bool) -> np.ndarray:
    """Return the values of a channel; of a force, over the load."""
    return table[:, 0] / np.maximum(table[:, 2], 1e-9) if of_force else table[:, 0]


def _within(ratio: float) -> float:
    return _JUMP_WITHIN_LARGE if max(ratio, 1.0 / ratio) > _JUMP_LARGE else _JUMP_WITHIN_SMALL


def _largest_change(values: np.ndarray, least: int) -> int:
    """Return where the size of values changes most: the likeliest step of a standard deviation."""
    total = np.cumsum(values**2)
    at = np.arange(least, values.size - least + 1)
    tiny = 1e-12 * max(float(total[-1]), 1e-300)
    before, after = total[at - 1] + tiny, total[-1] - total[at - 1] + tiny
    left = at * np.log(before / at) + (values.size - at) * np.log(after / (values.size - at))
    return int(at[np.argmin(left)])


def _ratio_at_same_conditions(before: np.ndarray, after: np.ndarray, *, of_force: bool) -> float:
    """Return values after over before, where all else is the same; 0 where they tell nothing."""
    sizes = np.maximum(np.quantile(np.vstack([before, after])[:, 1:], 0.9, axis=0), 1e-300)
    one, two = (
        part[np.linspace(0, len(part) - 1, min(len(part), _JUMP_MOST_ROWS)).astype(int)]
        for part in (before, after)
    )
    if not sizes.size:
        return _ratio_of_levels(before[:, 0], after[:, 0])
    if not of_force:  # an input: without a force, or a slip, loads and slips may be any
        one, two = (part[part[:, 1] > _JUMP_CLEAR * sizes[0]] for part in (one, two))
    if not len(one) or not len(two):
        return 0.0
    distance = np.zeros((len(one), len(two)))
    for x, y, size_of in zip(one.T[1:], two.T[1:], sizes, strict=True):  # a short last axis takes long
        np.maximum(distance, np.abs(x[:, None] - y[None, :]) / size_of, out=distance)
    nearest = distance.argmin(axis=0)
    pairs = distance[nearest, np.arange(len(two))] < _JUMP_NEAR
    x, y = one[nearest[pairs], 0], two[pairs, 0]
    if x.size < _JUMP_FEWEST or pairs.mean() < 0.1:
        return 0.0
    size, found = _size(one[nearest[pairs]], of_force=of_force), []
    share = size / max(float(np.quantile(size, 0.95)), 1e-300)
    for low, high in _JUMP_PARTS if of_force else _JUMP_WHOLE:
        some = (share >= low) & (share < high) & (y > 0.0)
        if some.sum() < _JUMP_FEWEST // 3:
            return 0.0
        logs = np.log(y[some] / x[some])
        quartiles = np.quantile(logs, [0.25, 0.75])
        if quartiles[1] - quartiles[0] > _JUMP_SCATTER:
            return 0.0
        found.append(float(np.median(logs)))
    if max(found) - min(found) > _JUMP_ALIKE:
        return 0.0
    return float(np.exp(np.mean(found)))


def _ratio_of_levels(before: np.ndarray, after: np.ndarray) -> float:
    """Return the ratio of two levels, each of which is held; 0 if they are not."""
    (low, one, high), (least, two, most) = (np.quantile(x, [0.1, 0.5, 0.9]) for x in (before, after))
    held = low > 0.0 and least > 0.0 and max(high / low, most / least) < 1.0 + _JUMP_ALIKE
    return float(two / one) if held else 0.0
