"""A channel with the other sign: another axis system, a mirrored file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping

import numpy as np

from tire_pipeline.mismatch.effects.base import Array, Effect, Finding
from tire_pipeline.mismatch.effects.unit_error import best_repair


class SignConvention(Effect):
    """A channel agrees with the model when its sign is turned."""

    name = "sign_convention"
    kind = "artefact"
    title = "a channel with the other sign"
    equation = "x recorded = -x"
    source = "SAE J670 and ISO 8855 axis systems"
    looks_like = {"crosstalk": "crosstalk needs the other force"}
    experiment = "look at the axis system of the acquisition"

    def absent(self, data: object) -> str | None:
        """Never a candidate of the fit: signs are tried before."""
        return "signs are tried before the fit"

    def detect(
        self,
        channels: Mapping[str, Array],
        simulate: Callable[[Mapping[str, Array]], dict[str, Array]],  # type: ignore[override]
    ) -> list[Finding]:
        """Turn one sign after the other; load must be positive."""
        found = []
        load = channels["normal_load"]
        if np.nanmedian(load) < 0.0:
            repaired = {"normal_load": -load}
            channels = {**channels, **repaired}
            found.append(_finding("normal_load", repaired))
        sets = [("fy",), ("slip_angle",), ("fx",), ("slip_ratio",), ("fy", "fx"), ("slip_angle", "camber")]
        trials = [
            ({n: -1.0 for n in names}, (", ".join(names),))
            for names in sets
            if all(n in channels for n in names)
        ]
        best = best_repair(channels, simulate, trials)
        if best is not None:
            found.append(_finding(best[2][0], {n: -channels[n] for n in best[1]}))
        elif "camber" in channels:
            found += _camber(channels, simulate)
        return found


def turned(findings: Iterable[Finding]) -> list[Finding]:
    """Return one finding for all channels that were turned; what was turned twice is as it was."""
    count = Counter(name for f in findings for name in f.channel.split(", "))
    names = [name for name, times in count.items() if times % 2]
    return [_finding(", ".join(names), {})] if names else []


def _finding(name: str, repaired: dict[str, Array]) -> Finding:
    parameters = {"ratio": (-1.0, 0.0, "1")}
    have = "have" if ", " in name else "has"
    return Finding("sign_convention", name, f"{name} {have} the other sign", parameters, repaired)


def _camber(
    channels: Mapping[str, Array], simulate: Callable[[Mapping[str, Array]], dict[str, Array]]
) -> list[Finding]:
    """Camber's part of the force with factor -1, well determined, says that camber is turned."""
    camber = channels["camber"]
    if "fy" not in channels or np.nanstd(camber) < 0.005:
        return []
    turned = simulate({**channels, "camber": -camber})["fy"]
    as_is = simulate(channels)["fy"]
    part = turned - as_is
    at = np.abs(camber) > 0.5 * np.nanmax(np.abs(camber))
    residual = channels["fy"] - as_is
    size = np.nansum(part[at] ** 2)
    spread = np.nanstd(residual)
    if size <= 0.0 or np.sqrt(np.nanmean(part[at] ** 2)) < 0.5 * spread:
        return []
    share = float(np.nansum(part[at] * residual[at]) / size)
    left = float(np.nanmean((residual - part)[at] ** 2) / np.nanmean(residual[at] ** 2))
    if 0.85 < share < 1.15 and left < 0.3:
        return [_finding("camber", {"camber": -camber})]
    return []
