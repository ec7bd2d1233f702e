"""Recordings that are explained together, one by one: own samples, and the same units and axes in all."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_OF_SLIP, RECORDED_CHANNELS
from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.effects.base import Finding
from tire_pipeline.mismatch.effects.sensor.sign_convention import excludes_sae
from tire_pipeline.mismatch.model.channels import ENOUGH_ROWS
from tire_pipeline.mismatch.model.plain_forces import forces_at
from tire_pipeline.mismatch.recording.exact import repair
from tire_pipeline.mismatch.recording.prepare import whole_rows
from tire_pipeline.mismatch.recording.usable import drives, judged, leave_out_still_slip

_COPIED = 0.5
"""Share of the rows of a recording that another one holds to the last digit, from which it is a copy."""
_BY_VALUE = {"normal_load", "pressure"}
"""Channels whose own values tell of a wrong sign or unit."""
_LEAST_CHANNELS = 3
"""Slip, load and force: rows with fewer channels in common are alike by chance."""


def check_copies(recordings: Mapping[str, pd.DataFrame]) -> None:
    """Refuse a recording whose samples another one holds, too.

    What is in both counts twice in an explanation, and a held-out copy is not unseen.

    Parameters
    ----------
    recordings : mapping of str to DataFrame
        Name -> canonical columns.

    Raises
    ------
    RecordingError
        More than half of the rows of one are in another one, whatever the time.
    """
    for (one, a), (two, b) in combinations(recordings.items(), 2):
        names = [n for n in RECORDED_CHANNELS if n != "time" and n in a and n in b]
        if len(names) < _LEAST_CHANNELS:
            continue
        rows_a, rows_b = (pd.util.hash_pandas_object(f[names].dropna(), index=False) for f in (a, b))
        smaller, copy, of = (rows_a, one, two) if len(rows_a) < len(rows_b) else (rows_b, two, one)
        common = smaller.isin(rows_a if smaller is rows_b else rows_b)
        if len(smaller) and common.mean() > _COPIED:
            raise RecordingError(
                f"{int(common.sum())} of {len(smaller)} samples are in {of}, too, to the last digit",
                where=copy,
                todo="leave one of the two out: a copy counts twice, and a held-out one is not unseen",
            )


def check_conventions(tire: Any, recordings: Mapping[str, pd.DataFrame]) -> None:
    """Refuse a recording whose units or signs are wrong where those of another one are right.

    Beside the others a wrong unit of one recording looks like physics: a force in pounds-force like friction.

    Parameters
    ----------
    tire : TireModel
    recordings : mapping of str to DataFrame
        Name -> canonical columns.

    Raises
    ------
    RecordingError
        Two agree with the model only by different factors.
    """
    each = {name: _OwnConventions.of(tire, frame) for name, frame in recordings.items()}
    for (one, first), (two, second) in combinations(each.items(), 2):
        apart = first.other_units(second) or first.other_signs(second)
        if not apart:
            continue
        odd, other = (two, one) if second.said(apart) else (one, two)
        raise RecordingError(
            f"{each[odd].said(apart)}, and {other} is otherwise",
            where=odd,
            todo=f"{_what_to_do(odd, apart, each[odd].factors)}, or leave it out",
        )


def _what_to_do(name: str, apart: Iterable[str], factors: Mapping[str, float]) -> str:
    """Return what brings a recording to the units or axes of the others."""
    if all(abs(factors.get(n, 1.0)) == 1.0 for n in apart):
        if set(apart) == {"slip_angle", "fy"}:
            return f"state its axes (on the command line --axes {name}:SAE or {name}:ISO)"
        return "turn one of these channels at its source (axes SAE turn slip_angle and fy together)"
    return f"state the unit of that recording (on the command line --unit {name}:COLUMN=UNIT)"


@dataclass(frozen=True)
class _OwnConventions:
    """What the model says about units and signs of one recording.

    Parameters
    ----------
    findings : list of Finding
        Wrong units and signs.
    factors : dict of str to float
        Channel -> what repairs it.
    channels : frozenset of str
        Those that it has.
    tells : bool
        Whether slip drives its forces, so that they tell of signs and units.
    sure : bool
        Whether the forces exclude SAE axes, for the signs as they are.
    """

    findings: list[Finding]
    factors: dict[str, float]
    channels: frozenset[str]
    tells: bool
    sure: bool

    @classmethod
    def of(cls, tire: Any, recording: pd.DataFrame) -> _OwnConventions:
        """Judge a recording; nothing is found in one that is too short."""
        try:
            arrays, time = whole_rows(recording)
        except RecordingError:
            return cls([], {}, frozenset(), False, False)
        leave_out_still_slip(tire, arrays, time, [])
        findings, _, factors = repair(tire, arrays, time)
        known = arrays if time is None else {**arrays, "time": time}
        some = {n: a[:: max(1, a.size // ENOUGH_ROWS)] for n, a in known.items()}
        exact = [f for f in findings if f.bad is None]
        tells = any(d.works and d.varies for d in judged(drives(tire, arrays, time)))
        return cls(exact, factors, frozenset(arrays), tells, excludes_sae(some, partial(forces_at, tire)))

    def other_units(self, other: _OwnConventions) -> list[str]:
        """Return the channels that another recording has in another unit, or the load with another sign."""
        both = self.channels & other.channels
        told = both if self.tells and other.tells else both & _BY_VALUE
        ratios = {n: self.factors.get(n, 1.0) / other.factors.get(n, 1.0) for n in told}
        return [n for n, r in ratios.items() if not np.isclose(r if n == "normal_load" else abs(r), 1.0)]

    def other_signs(self, other: _OwnConventions) -> list[str]:
        """Return the channels that are turned here or there, but not in both."""
        turned, there = (
            {n for n, f in each.factors.items() if f < 0.0 and n != "normal_load"} for each in (self, other)
        )
        if bool(turned) == bool(there) or not (self.tells and other.tells):
            return []
        grossly = any(len({slip, force} & (turned | there)) == 1 for slip, force in FORCE_OF_SLIP.items())
        silent = other if turned else self
        return sorted(turned | there) if grossly or silent.sure else []

    def said(self, channels: Iterable[str]) -> str:
        """What was found of some channels, in words."""
        return "; ".join(f.text for f in self.findings if set(f.channel.split(", ")) & set(channels))
