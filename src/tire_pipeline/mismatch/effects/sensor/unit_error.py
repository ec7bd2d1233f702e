"""A channel in another unit than stated."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tire_pipeline.channels import FORCE_OF_SLIP
from tire_pipeline.mismatch.effects.base import Array, Effect, Finding
from tire_pipeline.mismatch.effects.context import Context, Simulate
from tire_pipeline.mismatch.effects.sensor.repairs import AS_WELL, best_repair, unexplained
from tire_pipeline.recordings.conventions.plausible import PLAUSIBLE_VALUES, in_another_unit
from tire_pipeline.unit_definitions import DEGREE, GRAVITY, POUND_FORCE, PSI

FORCE_FACTORS = {1.0 / POUND_FORCE: ("lbf", "N"), 1e-3: ("kN", "N"), 1.0 / GRAVITY: ("kgf", "N")}
"""Recorded over true -> the unit of the values, and the one that they were taken for."""
_FACTORS_BY_CHANNEL: dict[str, dict[float, tuple[str, str]]] = {
    "slip_angle": {1.0 / DEGREE: ("degrees", "radians")},
    "camber": {1.0 / DEGREE: ("degrees", "radians")},
    "slip_ratio": {100.0: ("percent", "a ratio")},
    "normal_load": FORCE_FACTORS,
    "fx": FORCE_FACTORS,
    "fy": FORCE_FACTORS,
}
_GAINS_OF_SLIP = np.geomspace(min(FORCE_FACTORS), 1.0 / min(FORCE_FACTORS), 61)
"""Gains of a slip that are tried, as far from one as the units of a force."""
_PRESSURE_FACTORS = {
    1e3 / PSI: ("psi", "kPa"),
    1.0 / PSI: ("psi", "Pa"),
    1e-3: ("kPa", "Pa"),
    1e-5: ("bar", "Pa"),
    PSI / 1e3: ("kPa", "psi"),
}
"""Recorded over true -> the unit of the values, and the one that they were taken for."""
_USUAL_PRESSURE = 2.3e5
"""Of a tire whose file states none, Pa."""
_PRESSURE_RANGE = 4.0
"""Tires are run at the nominal pressure times or over so much."""


class UnitError(Effect):
    """A channel is wrong by exactly 57.3, 4.448, 6.895, 9.81, 3.6, 100 or 1000.

    Covers one such factor for angles, slip, load, forces and pressure. A force in another unit is no finding
    where a gain of its slip explains far more. Load and forces that are all in one other unit are asked
    about, not repaired: so may be another tire. Not covered: time, speed and
    temperature, of which the forces say too little, and units with an offset.
    """

    name = "unit_error"
    found_in = "factors"
    kind = "artefact"
    title = "a channel in the wrong unit"
    equation = "x recorded = ratio x, ratio one of 57.30, 4.448, 6.895, 9.807, 3.6, 100, 1000 or its inverse"
    source = "SI units, their definitions"
    looks_like = {"force_gain": "a gain need not be an exact ratio"}
    experiment = "look at the channel's unit in the acquisition"

    def absent(self, data: Context) -> str | None:
        """Never a candidate of the fit: exact ratios are tried before."""
        return "exact ratios are tried before the fit"

    def detect(self, channels: Mapping[str, Array], simulate: Simulate) -> list[Finding]:
        """Try the exact ratios: forces must fit far better, or the channel must be impossible as it is."""
        found = _pressure(channels) + _impossible(channels)
        channels = {**channels, **{n: x for f in found for n, x in f.repaired.items()}}
        trials = [
            (name, factor, _taken(*units[::power]))
            for name, factors in _FACTORS_BY_CHANNEL.items()
            if name in channels
            for base, units in factors.items()
            for power in (1, -1)
            for factor in (base**power,)
            if name != "normal_load" or _nearer(channels, 1.0 / factor)
        ]
        best = best_repair(channels, simulate, [({n: 1.0 / f}, (n, f, t)) for n, f, t in trials])
        both = best_repair(
            channels,
            simulate,
            [
                ({"fx": 1.0 / f**k, "fy": 1.0 / f**k}, ("fx, fy", f**k, _taken(*units[::k])))
                for f, units in FORCE_FACTORS.items()
                for k in (1, -1)
                if "fx" in channels and "fy" in channels
            ],
        )
        if both is not None and (best is None or both[0] < 0.7 * best[0]):
            best = both
        if best is not None and not _by_slip(channels, simulate, best[0], best[1]):
            factors, (name, factor, text) = best[1], best[2]
            repaired = {n: channels[n] * f for n, f in factors.items()}
            parameters = {"ratio": (float(factor), 0.0, "times")}
            found.append(
                Finding(self.name, name, f"{name} is wrong by {factor:.5g} ({text})", parameters, repaired)
            )
        return found


def _by_slip(
    channels: Mapping[str, Array], simulate: Simulate, left: float, forces: Mapping[str, float]
) -> bool:
    """Whether some gain of a slip explains far more than another unit of its force does."""
    plain = simulate(channels)
    return any(
        unexplained(channels, simulate, {slip: float(gain)}, plain)[1] * AS_WELL < left
        for slip, force in FORCE_OF_SLIP.items()
        if force in forces and slip in channels
        for gain in _GAINS_OF_SLIP
    )


def _taken(of: str, as_if: str) -> str:
    """Say in which unit the values are, and which one they were taken for."""
    return f"{of} taken for {as_if}"


def _nearer(channels: Mapping[str, Array], factor: float) -> bool:
    """Whether a factor brings the load nearer to the model's nominal load, where that is known."""
    if "_nominal_load" not in channels:
        return True
    ratio = float(np.nanmedian(np.abs(channels["normal_load"]))) / float(channels["_nominal_load"][0])
    return abs(np.log(max(ratio * factor, 1e-9))) < abs(np.log(max(ratio, 1e-9)))


def inflates_no_tire(pressure: Array) -> bool:
    """Whether a recorded pressure, Pa, is none that a tire has."""
    median = float(np.nanmedian(pressure))
    return not PLAUSIBLE_VALUES["pressure"].low < median < PLAUSIBLE_VALUES["pressure"].high


def _pressure(channels: Mapping[str, Array]) -> list[Finding]:
    """A pressure that no tire has, and that one ratio alone brings near the nominal one.

    Where several do (75 may be kPa or psi), the unit stays open.
    """
    if "pressure" not in channels or not inflates_no_tire(channels["pressure"]):
        return []
    median = float(np.nanmedian(channels["pressure"]))
    nominal = float(channels["_nominal_pressure"][0]) if "_nominal_pressure" in channels else _USUAL_PRESSURE
    able = [
        (factor, _taken(*units))
        for factor, units in _PRESSURE_FACTORS.items()
        if median > 0.0 and abs(np.log(median / factor / nominal)) < np.log(_PRESSURE_RANGE)
    ]
    if len(able) != 1:
        return []
    factor, text = able[0]
    repaired = {"pressure": channels["pressure"] / factor}
    parameters = {"ratio": (float(factor), 0.0, "times")}
    return [
        Finding(
            UnitError.name, "pressure", f"pressure is wrong by {factor:.5g} ({text})", parameters, repaired
        )
    ]


_OF_UNIT = {"deg": 1.0 / DEGREE, "%": 100.0}


def _impossible(channels: Mapping[str, Array]) -> list[Finding]:
    """Angles beyond what a wheel can have: degrees, percent."""
    found = []
    for name, limits in PLAUSIBLE_VALUES.items():
        if name in channels and in_another_unit(name, channels[name]):
            factor = _OF_UNIT[limits.read_as]
            text = _taken(*_FACTORS_BY_CHANNEL[name][factor])
            parameters = {"ratio": (factor, 0.0, "times")}
            repaired = {name: channels[name] / factor}
            found.append(
                Finding(
                    UnitError.name, name, f"{name} is wrong by {factor:.5g} ({text})", parameters, repaired
                )
            )
    return found
