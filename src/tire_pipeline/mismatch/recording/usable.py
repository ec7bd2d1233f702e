"""Whether a recording can be explained: slip must drive most of the force, with the right sign."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_OF_SLIP, SLIP_AND_LOAD, TANGENTIAL_FORCES
from tire_pipeline.magic_formula.fitting.report.verdict import MOST_LEFT
from tire_pipeline.mismatch.effects.sensor.repairs import unexplained
from tire_pipeline.mismatch.effects.sensor.unit_error import FORCE_FACTORS, inflates_no_tire
from tire_pipeline.mismatch.effects.shared import GAINS, LONGEST_DELAY
from tire_pipeline.mismatch.model.channels import ABSOLUTE_SPREAD, DOES_NOTHING, SMALL, largest, moves
from tire_pipeline.mismatch.model.nominal import loads_of_file
from tire_pipeline.mismatch.model.plain_forces import forces_at, plain_forces
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.pages.numbers_in_words import how_many, in_digits
from tire_pipeline.recordings.check import of_both_signs, unit_stated
from tire_pipeline.recordings.unit_jumps import unit_jumps

Array = np.ndarray

LEAST = 0.5
"""Less than half: most of the force comes from something other than the recorded slip. In the real
recordings at hand it is 0.79 at least (a drive of a few seconds whose friction changed), in simulated ones
0.94."""
_FAR_BETTER = 0.1
"""Squared difference in the right units over that in the wrong ones, at most."""
_PLANNED = (1.0 / 3.0, 1.7)
"""Median load of a test plan, over the nominal load of the file that is fitted to it."""
_STANDS = 0.05
"""Of the largest speed: a wheel that is slower stands. The slowest of the recordings at hand have 0.17."""


@dataclass(frozen=True)
class Drive:
    """How much of one recorded force the recorded slip drives.

    Parameters
    ----------
    output, slip : str
        The force and its slip channel.
    size : float
        Standard deviation of the force, N.
    plain : float
        Share of the force's variance that the model explains as it is; negative where its own mean explains
        more.
    share : float
        The same with the best positive gain, an offset, the best delay that a rig may have, and a part in
        proportion to camber times load, which a model may not know.
    gain : float
        That gain.
    still : float
        ``share`` with the slip held at its mean.
    varies : bool
        Whether the slip is recorded and moves.
    known : bool
        Whether the model has anything of the force: one that was fitted to cornering alone has no Fx.
    """

    output: str
    slip: str
    size: float
    plain: float
    share: float
    gain: float
    still: float
    varies: bool
    known: bool = True

    @property
    def works(self) -> bool:
        """Whether the slip drives most of the force, and its changes are worth something."""
        return self.share >= LEAST and self.sized and (not self.varies or self.share > self.still)

    @property
    def sized(self) -> bool:
        """Whether the force has the size that a model, a friction and a gain may be wrong by."""
        return 1.0 + GAINS[0] <= self.gain <= 1.0 + GAINS[1]


def drives(tire: Any, arrays: Mapping[str, Array], time: Array | None) -> list[Drive]:
    """Return how much of each recorded force slip drives, by rows as they were recorded.

    Parameters
    ----------
    tire : TireModel
    arrays : mapping of ndarray, shape (n,)
        Channels, SI, without holes, signs and units repaired; ``_beside_fy`` is what another simulator has
        beyond the tire model.
    time : ndarray, shape (n,), optional
        s.
    """
    model = _model(tire, arrays)
    out = []
    for slip, output in FORCE_OF_SLIP.items():
        simulated = f"_beside_{output}" in arrays or not any(n.startswith("_beside_") for n in arrays)
        if output not in arrays or not simulated or np.ptp(arrays[output]) == 0.0:
            continue
        recorded = arrays[output]
        varies = slip in arrays and moves(arrays[slip], ABSOLUTE_SPREAD[slip])
        still = model
        if varies:
            still = _model(tire, {**arrays, slip: np.full(recorded.size, np.mean(arrays[slip]))})
        variance = float(np.var(recorded))
        out.append(
            Drive(
                output,
                slip,
                float(np.sqrt(variance)),
                1.0 - float(np.mean((recorded - model[output]) ** 2)) / variance,
                *_share(recorded, model[output], arrays, time),
                _share(recorded, still[output], arrays, time)[0],
                varies,
                bool(np.ptp(model[output]) > DOES_NOTHING * np.ptp(recorded)),
            )
        )
    return out


def judged(found: list[Drive]) -> list[Drive]:
    """Return the forces that count: those that are no side effect, and whose slip is recorded."""
    largest = max((d.size for d in found), default=0.0)
    own = [d for d in found if d.size > SMALL * largest and d.varies]
    return own or [d for d in found if d.size == largest]


def _model(tire: Any, arrays: Mapping[str, Array]) -> dict[str, Array]:
    zero = np.zeros(arrays["normal_load"].size)
    points = {n: arrays.get(n, zero) for n in SLIP_AND_LOAD}
    forces = plain_forces(tire, **points, speed=arrays.get("speed"), pressure=arrays.get("pressure"))
    return {n: f + arrays.get(f"_beside_{n}", 0.0) for n, f in forces.items()}


def _share(
    recorded: Array, model: Array, arrays: Mapping[str, Array], time: Array | None
) -> tuple[float, float]:
    """Share of the variance explained with a gain, an offset, a delay and a part by camber; and the gain."""
    beside = [np.ones(recorded.size)]
    if "camber" in arrays and np.ptp(arrays["camber"]) > ABSOLUTE_SPREAD["camber"]:
        beside.append(arrays["camber"] * arrays["normal_load"])
    q, _ = np.linalg.qr(np.column_stack(beside))
    r, m = (x - q @ (q.T @ x) for x in (recorded, model))
    size, most = float(m @ m), float(r @ r)
    variance = recorded.size * float(np.var(recorded))
    if min(size, most) <= 1e-20 * float(recorded @ recorded):
        return 1.0 - most / variance, 0.0
    gain = max(_product(r, m, time) / size, 0.0)
    return 1.0 - (most - gain**2 * size) / variance, gain


def _product(r: Array, m: Array, time: Array | None) -> float:
    """Largest sum of products over the delays that a rig may have."""
    from scipy.signal import correlate  # slow to import

    if time is None:
        return float(r @ m)
    step = max(float(np.median(np.diff(time))), 1e-9)
    most = min(int(LONGEST_DELAY / step), r.size - 1)
    products = correlate(r, m, mode="full", method="auto")
    middle = m.size - 1
    return float(products[middle - most : middle + most + 1].max())


def judge(
    tire: Any, arrays: dict[str, Array], time: Array | None, notes: list[str]
) -> tuple[Question | None, list[Drive]]:
    """Return why nothing can be explained from a recording (None if something can), and the driven forces.

    A force that its slip does not drive, beside one that is driven, is taken out of ``arrays``, and ``notes``
    say so. So do they where the model explains less of a force than the force's own mean does, though slip
    drives it: friction or a gain is far off then, which is something to explain.
    """
    leave_out_still_slip(tire, arrays, time, notes)
    counted = judged(drives(tire, arrays, time))
    unknown = [d for d in counted if d.varies and not d.known]
    if unknown:
        why = _no_coefficients(unknown)
        for d in unknown:
            del arrays[d.output]
        counted = judged(drives(tire, arrays, time))
        if not counted:
            return _unusable(why, "take a file that was fitted to that, too, or fit one (tire fit)"), []
        notes.append(f"left out: {why}")
    if not any(d.works for d in counted):
        worst = max(counted, key=lambda d: d.size)
        return _unusable(described(worst), look_at(worst, arrays)), []
    for d in counted:
        if not d.works:
            del arrays[d.output]
            notes.append(f"{d.output} is left out: {described(d)}. {look_at(d, arrays)}")
        elif d.plain < 0.0:
            notes.append(f"{described(d)}; slip drives it all the same")
    return None, [d for d in counted if d.works]


def in_two_units(recording: pd.DataFrame) -> Question | None:
    """Return the question whether a channel changes its unit or its sign, if it jumps as one would."""
    load = recording["normal_load"].to_numpy(dtype=float, na_value=np.nan)
    if of_both_signs(load[np.isfinite(load)]):
        rows = f"{int(np.sum(load < 0.0))} of {load.size} rows"
        why = f"normal_load is negative in {rows}, and positive in others"
        return _unusable(why, "bring all rows to one sign, compression positive")
    jumps = unit_jumps(recording)
    if not jumps:
        return None
    said = "; ".join(f"{jump} (it jumps by {in_digits(jump.ratio)})" for jump in jumps)
    why = f"it seems that {said}, while load and slip are the same"
    return _unusable(why, "bring both parts to one unit, or explain each part by itself")


def in_another_unit(tire: Any, arrays: Mapping[str, Array]) -> Question | None:
    """Return the question whether load and forces are all in one other unit, with which they meet the file.

    Forces are nearly proportional to the load, so that in such a unit another tire seems to roll: a peak
    friction, a slip stiffness and their changes with load that are off at once.

    Parameters
    ----------
    tire : TireModel
    arrays : mapping of ndarray, shape (n,)
        Channels, other signs and units repaired.
    """
    names = ["normal_load", *(n for n in TANGENTIAL_FORCES if n in arrays)]
    factors = {1.0 / base: units for base, units in FORCE_FACTORS.items()}
    factors |= {base: units[::-1] for base, units in FORCE_FACTORS.items()}
    load = arrays["normal_load"]
    possible = [factor for factor in factors if _at_its_loads(tire, load * factor, load)]
    if not possible:
        return None
    simulate = partial(forces_at, tire)
    plain, best = simulate(arrays), (0.0, 1.0, "", "")
    for factor in possible:
        before, after = unexplained(arrays, simulate, dict.fromkeys(names, factor), plain)
        if before > MOST_LEFT**2 > after and after < min(best[1], _FAR_BETTER * before):
            best = (before, after, *factors[factor])
    before, after, of, taken_for = best
    if not of:
        return None
    as_read, so_read = (in_digits(100.0 * float(np.sqrt(share))) for share in (before, after))
    listed = f"{', '.join(names[:-1])} and {names[-1]}"
    return _unusable(
        f"it seems that {listed} are in {of}, and were taken for {taken_for} (read in {of}, the forces "
        f"differ from the model by {so_read}% RMS, and by {as_read}% as they are)",
        f"look up the unit of {listed} in the file's source, and state it (units={{...}}, --unit). If they "
        f"are in {taken_for}, this is not the file of this tire",
    )


def _at_its_loads(tire: Any, load: Array, instead_of: Array) -> bool:
    """Whether a load is one for which a file holds, and another one is not: the medians of both, N.

    Where the file states no range, it is that of test plans, around its nominal load.
    """
    low, high = loads_of_file(tire)
    if not np.isfinite(high - low):
        low, high = (share * float(tire.coefficients.get("FNOMIN", np.nan)) for share in _PLANNED)
    return bool(low <= np.median(load) <= high and not low <= np.median(instead_of) <= high)


def _unusable(why: str, todo: str) -> Question:
    return Question(f"the recording cannot be explained: {why}", todo, "unusable")


def standing(arrays: Mapping[str, Array], notes: list[str]) -> Array:
    """Return the samples in which the wheel stands, bool, shape (n,), and note them.

    A wheel that does not roll has neither a slip angle nor a force by it.
    """
    if "speed" not in arrays:
        return np.zeros(arrays["normal_load"].size, bool)
    speed = np.abs(arrays["speed"])
    still = np.asarray(speed < _STANDS * largest(speed))
    if still.any():
        notes.append(
            f"{how_many(int(still.sum()), 'sample')} left out: the wheel stands (speed below "
            f"{_STANDS * largest(speed):.2g} m/s)"
        )
    return still


def leave_out_still_slip(tire: Any, arrays: dict[str, Array], time: Array | None, notes: list[str]) -> None:
    """Take out a slip ratio that stands still far from zero, if the model has the force only without it.

    Rigs write -1 where they do not measure it: a locked wheel.
    """
    if not _stands(arrays, "slip_ratio") or any(d.works for d in judged(drives(tire, arrays, time))):
        return
    without = {n: a for n, a in arrays.items() if n != "slip_ratio"}
    able = [d for d in judged(drives(tire, without, time)) if d.works]
    if able:
        best = max(able, key=lambda d: d.share)
        at = float(np.mean(arrays.pop("slip_ratio")))
        notes.append(
            f"slip_ratio is {at:.3g} throughout and left out: without it the model explains "
            f"{100.0 * best.plain:.0f}% of the variance of {best.output.capitalize()}"
        )


def leave_out_no_pressure(recording: pd.DataFrame, arrays: dict[str, Array], notes: list[str]) -> None:
    """Take out a pressure that no tire has and that no unit explains, or more than one."""
    if "pressure" not in arrays or not inflates_no_tire(arrays["pressure"]):
        return
    low, high = np.nanmin(arrays["pressure"]), np.nanmax(arrays["pressure"])
    del arrays["pressure"]
    notes.append(
        f"pressure is left out: {low:.4g} to {high:.4g} Pa is no tire's, and its unit cannot be told. "
        f"State it, if it is kPa: {unit_stated(recording, 'pressure', 'kPa')}"
    )


def _stands(arrays: Mapping[str, Array], name: str) -> bool:
    """Whether a slip is recorded, does not move, and is not zero."""
    least = ABSOLUTE_SPREAD[name]
    return name in arrays and not moves(arrays[name], least) and abs(float(np.mean(arrays[name]))) > least


def _no_coefficients(unknown: list[Drive]) -> str:
    """Return in words that the model has nothing of some forces."""
    names = " and ".join(d.output.capitalize() for d in unknown)
    return f"the file has no coefficients of {names}, or they are zero (tire show lists what it has)"


def described(d: Drive) -> str:
    """Return in words how much of a force its slip drives."""
    name, by = d.output.capitalize(), d.slip.replace("_", " ")
    plain = f"the model explains {100.0 * d.plain:.0f}% of the variance of {name}"
    if d.plain < 0.0:
        plain = f"the model explains less of {name} than the mean of {name} does (share {d.plain:.2g})"
    if d.works:
        return f"{plain}; with another gain and offset it is {100.0 * d.share:.0f}%"
    if d.share < LEAST:
        return (
            f"{plain}; with the best gain, offset and delay it is {100.0 * max(d.share, 0.0):.0f}%, less "
            f"than half: most of {name} comes from something else than the recorded {by}"
        )
    if not d.sized:
        return f"{plain}; {name} follows the recorded {by} only with a gain of {d.gain:.3g}"
    return (
        f"{plain}, and as much ({100.0 * d.still:.0f}% against {100.0 * d.share:.0f}%) with the {by} held at "
        f"its mean: the changes of the recorded {by} are worth nothing"
    )


def look_at(d: Drive, arrays: Mapping[str, Array]) -> str:
    """Return what to look at where slip does not drive a force."""
    by = d.slip.replace("_", " ")
    if d.slip not in arrays:
        return f"Record the {by}, which is missing"
    x = arrays[d.slip]
    if not d.varies:
        return f"Look at {by}, which hardly moves ({np.min(x):.3g} to {np.max(x):.3g}) while the force does"
    return (
        f"Look at how {by} was measured (lateral and longitudinal speed of the wheel, steering angle, "
        "filters, synchronization with the forces), at the axes of both, and whether the file is of this tire"
    )
