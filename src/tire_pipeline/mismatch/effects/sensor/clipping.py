"""A force channel that cannot go beyond a limit."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import scipy

from tire_pipeline.mismatch.effects.base import Array, Effect, Finding
from tire_pipeline.mismatch.effects.shared import CLIPPED


class Clipping(Effect):
    """The recorded force stops at a limit, whatever the tire does.

    Covers channels of which many samples stand exactly at one end of their range, either or both. Not
    covered: a limit that noise or a filter after it has blurred: without samples at it there is no limit to
    see.
    """

    name = "clipping"
    kind = "artefact"
    title = "a clipped channel"
    equation = "F recorded = min(max(F, -limit), limit)"
    source = "range of amplifier or converter"
    looks_like = {"friction_scale": "friction limits the force in proportion to load; clipping at one value"}
    experiment = "repeat with a larger range of the amplifier"
    order = 99
    found_in = "samples"

    def absent(self, data: object) -> str | None:
        """Never a candidate of the fit: at a limit samples stand, or there is none."""
        return "found in the channel itself, not by a fit"

    def detect(self, channels: Mapping[str, Array], simulate: object) -> list[Finding]:
        """Find many samples exactly at one end of a channel's range."""
        found = []
        for name in CLIPPED:
            if name not in channels:
                continue
            x = channels[name]
            bad, limits = _at_the_ends(x, "_steady_points" not in channels)
            if bad is None:
                continue
            text = (
                f"{name} stays exactly at {', '.join(f'{v:.5g}' for v in limits)} for "
                f"{int(bad.sum())} samples"
            )
            values = {f"{name}_limit_{i + 1}": (v, 0.0, "as recorded") for i, v in enumerate(limits)}
            below, above = [v for v in limits if v <= 0.0], [v for v in limits if v > 0.0]
            ends = (max(below, default=-np.inf), min(above, default=np.inf))
            found.append(Finding(self.name, name, text, values, {}, bad, limits=ends))
        return found


def _at_the_ends(x: Array, in_time: bool) -> tuple[Array | None, list[float]]:
    """Samples exactly at the largest or smallest value, if these are many and the rest is not.

    In time they must stay there three samples on end, and be more than the crest of a smooth signal leaves
    in a last step of the channel's resolution; of steady points four at one end are enough, if all others
    differ.
    """
    finite = x[np.isfinite(x)]
    if finite.size < (50 if in_time else 20) or np.ptp(finite) == 0.0:
        return None, []
    values, counts = np.unique(finite, return_counts=True)
    usual = np.quantile(counts, 0.99 if in_time else 0.9)
    least = max(12.0, 4.0 * usual) if in_time else 4.0 * usual
    bad = np.zeros(x.size, bool)
    limits = []
    for value in (values[-1], values[0]):
        at = x == value
        runs = np.diff(np.flatnonzero(np.diff(np.r_[0, at.astype(np.int8), 0])))[::2]
        stays = not in_time or (runs.size and runs.max() >= 3 and not _crest(values, counts, value))
        if at.sum() >= least and stays and at.mean() < 0.6:
            bad |= at
            limits.append(float(value))
    return (bad, limits) if limits else (None, [])


_STEPS_OF_CREST = 10
_LEVEL_OF_CREST = 1e-3


def _crest(values: Array, counts: Array, end: float) -> bool:
    """Whether as many samples at the end of a range are what a smooth crest and the resolution make.

    A parabola spends at most ``steps ** -0.5`` of the time within so many steps of its top in the last of
    them. The resolution is the smallest step between values near the end.
    """
    distance = np.abs(values - end)
    near = np.sort(distance)[: 5 * _STEPS_OF_CREST]
    steps = np.diff(near)
    resolution = float(np.min(steps[steps > 1e-9 * max(abs(end), near[-1])], initial=np.inf))
    if not np.isfinite(resolution):
        return False
    last = int(counts[distance < 0.5 * resolution].sum())
    around = int(counts[distance < (_STEPS_OF_CREST - 0.5) * resolution].sum())
    by_chance = (
        1.0 if last == 0 else float(scipy.special.bdtrc(last - 1, around, _STEPS_OF_CREST**-0.5))
    )  # binomial: so many or more
    return by_chance > _LEVEL_OF_CREST
