"""A force channel that cannot go beyond a limit."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tire_pipeline.mismatch.effects.base import Array, Effect, Finding, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.shared import CLIPPED


class Clipping(Effect):
    """The recorded force stops at a limit, whatever the tire does."""

    name = "clipping"
    kind = "artefact"
    title = "a clipped channel"
    equation = "F recorded = min(max(F, -limit), limit)"
    source = "range of amplifier or converter"
    own_inputs = True
    least_gain = 100.0  # a limit leaves equal samples, which `detect` finds; else it is the misfit's peak
    parameters = (
        Parameter("fy", "N", 1.0, 1e7, 1.0, zero=1e7, output="fy"),
        Parameter("fx", "N", 1.0, 1e7, 1.0, zero=1e7, output="fx"),
    )
    looks_like = {"friction_scale": "friction limits the force in proportion to load; clipping at one value"}
    experiment = "repeat with a larger range of the amplifier"
    order = 99

    def starts(self, data: object) -> list[dict[str, float]]:
        """Limits somewhat below the largest recorded force, of either output."""
        out = []
        for name in data.outputs:  # type: ignore[attr-defined]
            if not data.driven(name):  # type: ignore[attr-defined]
                continue
            largest = float(np.quantile(np.abs(data.recorded[name]), 0.995))  # type: ignore[attr-defined]
            other = {n.name: n.zero for n in self.parameters}
            out += [{**other, name: share * largest} for share in (0.99, 0.95)]
        return out

    def free(self, data: object, start: Parameters) -> tuple[str, ...]:
        """Return the one limit that the start sets."""
        return tuple(p.name for p in self.parameters if start[p.name] != p.zero)

    def outputs(self, state: State, data: object, p: Parameters) -> None:
        """Clip the forces."""
        for name in ("fx", "fy"):
            if name in state.forces:
                state.forces[name] = np.clip(state.forces[name], -p[name], p[name])

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
            found.append(Finding(self.name, name, text, values, {}, bad))
        return found


def _at_the_ends(x: Array, in_time: bool) -> tuple[Array | None, list[float]]:
    """Samples exactly at the largest or smallest value, if these are many and the rest is not.

    In time they must stay there three samples on end; of steady points four at one end are enough, if all
    others differ.
    """
    finite = x[np.isfinite(x)]
    if finite.size < (50 if in_time else 20) or np.ptp(finite) == 0.0:
        return None, []
    _, counts = np.unique(finite, return_counts=True)
    usual = np.quantile(counts, 0.99 if in_time else 0.9)
    least = max(12.0, 4.0 * usual) if in_time else 4.0 * usual
    bad = np.zeros(x.size, bool)
    limits = []
    for value in (finite.max(), finite.min()):
        at = x == value
        runs = np.diff(np.flatnonzero(np.diff(np.r_[0, at.astype(np.int8), 0])))[::2]
        stays = not in_time or (runs.size and runs.max() >= 3)
        if at.sum() >= least and stays and at.mean() < 0.6:
            bad |= at
            limits.append(float(value))
    return (bad, limits) if limits else (None, [])
