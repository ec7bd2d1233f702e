"""Artefacts that show without a fit: what is stuck or clipped; wrong signs and units are repaired."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import scipy

from tire_pipeline.channels import ALIGNING_MOMENT
from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.base import Effect, Finding
from tire_pipeline.mismatch.effects.sensor.sign_convention import beside_sae, turned, with_moment
from tire_pipeline.mismatch.model.channels import ABSOLUTE_SPREAD, ENOUGH_ROWS, SLOW, moves
from tire_pipeline.mismatch.model.plain_forces import forces_at, moment_at
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.recordings.conventions.axis_systems import NOT_STATED

Array = np.ndarray


def repair(
    tire: Any, arrays: dict[str, Array], time: Array | None
) -> tuple[list[Finding], Array, dict[str, float]]:
    """Find exact artefacts, and repair signs and units.

    Parameters
    ----------
    tire : TireModel
    arrays : dict of ndarray, shape (n,)
        Channels; those with a wrong sign or unit are put right in place.
    time : ndarray, shape (n,), optional
        s.

    Returns
    -------
    findings : list of Finding
    bad : ndarray of bool, shape (n,)
        Samples that no repair brings back: stuck or clipped.
    factors : dict of str to float
        Channel -> what it was multiplied by.

    Raises
    ------
    RecordingError
        A repair takes back another one: the channel is not in one unit.
    """
    n = arrays["normal_load"].size
    bad = np.zeros(n, bool)
    findings: list[Finding] = []
    run = partial(forces_at, tire)
    for effect in _found_in("samples"):
        if effect.needs_time and time is None:
            continue
        some = {k: a[~bad] for k, a in arrays.items()}
        if time is None:
            some["_steady_points"] = np.ones(1)
        rows = np.flatnonzero(~bad)
        for finding in effect.detect(some, run):
            hit = np.zeros(n, bool)
            hit[rows[finding.bad]] = True
            at = np.zeros(2) if time is None else time[hit]
            span = (float(at[0]), float(at[-1])) if effect.in_one_stretch else None
            bad |= hit
            findings.append(replace(finding, bad=hit, span=span))
    pick = np.flatnonzero(~bad)
    pick = pick[:: max(1, pick.size // ENOUGH_ROWS)]
    stated = {"_nominal_pressure": "NOMPRES", "_nominal_load": "FNOMIN"}
    c = tire.coefficients
    besides = {n: np.array([float(c[key])]) for n, key in stated.items() if c.get(key, 0.0) > 0.0}
    still = _still(arrays, time)
    if time is not None:
        besides["time"] = time[pick]
    signs: list[Finding] = []
    factors: dict[str, float] = {}
    for _ in range(3):
        again = False
        for effect in _found_in("factors"):
            some = {k: still.get(k, a)[pick] for k, a in arrays.items()} | besides
            for finding in effect.detect(some, run):
                for channel, repaired in finding.repaired.items():
                    factor = _ratio(repaired, some[channel])
                    arrays[channel] = arrays[channel] * factor
                    if channel in still:  # else it would be found, and divided, again
                        still[channel] = still[channel] * factor
                    before = factors.get(channel, 1.0)
                    factors[channel] = before * factor
                    if before != 1.0 and np.isclose(factors[channel], 1.0):
                        raise _of_two_units(channel, finding, findings)
                kept = signs if finding.axes else findings
                kept.append(replace(finding, repaired={}))
                again = True
        if not again:
            break
    signs = turned(signs)
    if factors.get("fy", 1.0) < 0.0 and _moment_is_turned(tire, arrays, pick):
        arrays[ALIGNING_MOMENT] = -arrays[ALIGNING_MOMENT]
        factors[ALIGNING_MOMENT] = -1.0
        signs = [with_moment(f) if "fy" in f.channel.split(", ") else f for f in signs]
    return [*findings, *signs], bad, factors


def _moment_is_turned(tire: Any, arrays: Mapping[str, Array], pick: Array) -> bool:
    """Whether the recorded aligning moment agrees better with the model's of the other sign.

    An axis system that turns the side force turns the moment about the vertical axis or leaves it: of these
    two the likelier one is taken.
    """
    if ALIGNING_MOMENT not in arrays:
        return False
    some = {n: a[pick] for n, a in arrays.items()}
    return float(np.nansum(some[ALIGNING_MOMENT] * moment_at(tire, some))) < 0.0


def _of_two_units(channel: str, last: Finding, findings: Iterable[Finding]) -> RecordingError:
    """Return the error where a repair takes back an earlier one of the same channel."""
    said = "; ".join(f.text for f in [*findings, last] if channel in f.channel)
    return RecordingError(
        f"no one unit fits all values: {said}, one after the other",
        where=channel,
        todo="part of the rows are in another unit: convert them, or explain each part by itself",
    )


def open_axes(
    tire: Any,
    arrays: Mapping[str, Array],
    time: Array | None,
    findings: Iterable[Finding],
    against: str,
    assumed: Iterable[str] = (),
) -> Question | None:
    """Return what is open about the axes of a recording.

    Parameters
    ----------
    tire : TireModel
    arrays : mapping of ndarray, shape (n,)
        Channels as they are used.
    time : ndarray, shape (n,), optional
        s.
    findings : iterable of Finding
    against : str
        What the reader saw in the file that speaks against the axes it was read in.
    assumed : iterable of str
        What the reader assumed: axes that nobody stated are open where others agree better.
    """
    signs = [f for f in findings if f.axes and f.channel != "normal_load"]
    if signs:
        stated = tuple(f.text for f in signs)
        why = f"the recording agrees with the model only in other axes ({'; '.join(stated)})"
        if any(_as_mirrored(f, "camber" in arrays) for f in signs):
            return Question(
                f"{why}, or is of a tire of the other side", _SIDE_OF_FILE + _READ_AGAIN, stated=stated
            )
        return Question(why, _READ_AGAIN, stated=stated)
    known = arrays if time is None else {**arrays, "time": time}
    some = {n: a[:: max(1, a.size // ENOUGH_ROWS)] for n, a in known.items()}
    not_stated = any(text.startswith(NOT_STATED) for text in assumed)
    sae = beside_sae(some, partial(forces_at, tire)) if against or not_stated else None
    if against and not (sae is not None and sae.excluded):
        both = "the forces do not tell whether slip_angle and fy have the other sign too"
        return Question(f"{against}, and {both}", _READ_AGAIN)
    if not_stated and sae is not None and (errors := sae.errors_if_better):
        given, other = (in_digits(x) for x in errors)
        return Question(
            f"the axes of the file were not stated, and in SAE axes the RMS difference of Fy is {other} N "
            f"instead of {given} N",
            _READ_AGAIN,
        )
    return None


def _as_mirrored(finding: Finding, camber: bool) -> bool:
    """Whether a mirrored tire looks the same: all that acts to one side acts to the other one.

    ``camber``: whether it was recorded, and would tell.
    """
    mirrored = {"slip_angle", "camber", "fy"} if camber else {"slip_angle", "fy"}
    turned_sets = (set(finding.channel.split(", ")), *map(set, finding.alike))
    return any(names - {ALIGNING_MOMENT} == mirrored for names in turned_sets)


_SIDE_OF_FILE = "see that the file is of the side on which the tire was mounted (TYRESIDE), "
_READ_AGAIN = (
    'read the file with axes="ISO", "SAE" or "adapted SAE", whichever holds, or turn the channel at its '
    "source, and explain again"
)


def _found_in(where: str) -> list[Effect]:
    """Return the effects of the catalogue that are found in samples, or in exact factors, in their order."""
    return sorted((e for e in catalogue().values() if e.found_in == where), key=lambda e: e.order)


def _still(arrays: Mapping[str, Array], time: Array | None) -> dict[str, Array]:
    """Return slips that do not move, on their mean: noise has no unit and no sign."""
    if time is None:
        return {}
    width = max(int(SLOW / max(float(np.median(np.diff(time))), 1e-9)), 1)
    out = {}
    for name in ("slip_angle", "slip_ratio", "camber"):
        if name in arrays and not moves(
            scipy.ndimage.uniform_filter1d(arrays[name], width), ABSOLUTE_SPREAD[name]
        ):
            out[name] = np.full_like(arrays[name], np.mean(arrays[name]))
    return out


def _ratio(new: Array, old: Array) -> float:
    k = int(np.argmax(np.abs(old)))
    return float(new[k] / old[k])
