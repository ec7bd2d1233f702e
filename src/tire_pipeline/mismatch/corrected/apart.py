"""Recordings explained together, each against the others: what one has alone is no cause that all share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_OF_SLIP, SLIP_OF_FORCE
from tire_pipeline.mismatch.corrected.model import CorrectedModel
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.channels import ABSOLUTE_SPREAD, moves
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.residual import rms
from tire_pipeline.mismatch.model.simulated import DIFFERENCE

Array = np.ndarray


@dataclass(frozen=True)
class Apart:
    """How one recording differs from the others in one force, as an error of its own would make it differ.

    Parameters
    ----------
    recording, output : str
    size : float
        RMS of the difference in that recording, N.
    others : float
        RMS of all that is left in the others, N.
    kind : str
        The single error that comes nearest: "gain", "slip" or "offset"; "" where more is left beside it.
    value : float
        Its size: a share of the force, rad or 1, N.
    """

    recording: str
    output: str
    size: float
    others: float
    kind: str
    value: float


def apart(corrected: CorrectedModel, joined: pd.DataFrame) -> list[Apart]:
    """Return which recordings differ from the others by more than all that is left in these.

    Parameters
    ----------
    corrected : CorrectedModel
    joined : DataFrame
        Of :func:`tire_pipeline.recordings.join_recordings`.

    Notes
    -----
    The residual of a recording and that of the others are each fitted by a gain of the force, an offset of
    its slip, and one of the force. What the two fits differ by is larger than what is left in the others only
    if the recording has something alone. A surface that changes between two recordings is taken back before:
    it is whatever changes there. Recordings whose slip stands still say nothing.
    """
    model = replace(corrected, changes=_without_seams(corrected.changes, joined), instead=())
    factor = corrected.factors
    predicted, found = model.predict(joined), []
    for slip, output in FORCE_OF_SLIP.items():
        if output not in predicted or slip not in joined:
            continue
        force = predicted[output] * factor.get(output, 1.0)
        left = (joined[output] * factor.get(output, 1.0) - force).to_numpy(dtype=float)
        turn = DIFFERENCE / factor.get(slip, 1.0)
        turned = model.predict(joined.assign(**{slip: joined[slip] + turn}))[output] * factor.get(output, 1.0)
        columns = np.column_stack([force, (turned - force) / DIFFERENCE, np.ones(left.size)])
        whole = np.isfinite(left) & np.isfinite(columns).all(axis=1)
        rows = {}
        for part in joined.attrs["joined"]:
            own = np.zeros(left.size, bool)
            own[part["first"] : part["last"] + 1] = True
            if moves(joined[slip].to_numpy(dtype=float)[own & whole], ABSOLUTE_SPREAD[slip]):
                rows[part["name"]] = own & whole
        found += [each for name in rows if (each := _one(name, output, rows, left, columns))]
    return found


def _one(name: str, output: str, rows: Mapping[str, Array], left: Array, columns: Array) -> Apart | None:
    """Return how a recording differs, None if by no more than what is left in the others."""
    others = np.any([each for other, each in rows.items() if other != name], axis=0)
    own = rows[name]
    if not np.any(others):
        return None
    shared = _fitted(columns[others], left[others])
    beyond = left[own] - columns[own] @ shared
    size, level = rms(columns[own] @ _fitted(columns[own], beyond)), rms(left[others])
    if size <= level:
        return None
    single = [_fitted(columns[own][:, [k]], beyond)[0] for k in range(columns.shape[1])]
    rest = [rms(beyond - columns[own][:, k] * value) for k, value in enumerate(single)]
    best = int(np.argmin(rest))
    kind = ("gain", "slip", "offset")[best] if rest[best] < size else ""
    return Apart(name, output, size if kind else rms(beyond), level, kind, float(single[best]))


def _fitted(columns: Array, left: Array) -> Array:
    """Least squares of a residual."""
    return np.asarray(np.linalg.lstsq(columns, left, rcond=None)[0])


def _without_seams(changes: tuple[Change, ...], joined: pd.DataFrame) -> tuple[Change, ...]:
    """Leave out what jumps between two recordings, such as a surface."""
    if "time" not in joined:
        return changes
    time = joined["time"].to_numpy(dtype=float)
    ends = [(time[part["first"] - 1], time[part["first"]]) for part in joined.attrs["joined"][1:]]
    gaps = [(end - (begin - end), begin + (begin - end)) for end, begin in ends]

    def between(name: str, parameters: Mapping[str, float]) -> bool:
        moments = [parameters[stepped] for stepped in catalogue()[name].stepped]
        return any(low <= moment <= high for low, high in gaps for moment in moments)

    return tuple((name, parameters) for name, parameters in changes if not between(name, parameters))


def in_words(each: Apart) -> str:
    """Return how a recording differs, in a clause."""
    force, slip = each.output.capitalize(), SLIP_OF_FORCE[each.output]
    sizes = f"{each.size:.0f} N RMS of {force}; all that is left in the others is {each.others:.0f} N"
    if not each.kind:
        return f"the recording {each.recording} differs from the others, as no gain or offset would ({sizes})"
    what = f"its {force} were {abs(each.value):.1%} {'larger' if each.value > 0.0 else 'smaller'}"
    if each.kind == "slip":
        off = abs(each.value)
        size = f"{np.degrees(off):.2g} deg" if slip == "slip_angle" else f"{off:.2g}"
        too = "small" if each.value > 0.0 else "large"
        what = f"its {slip.replace('_', ' ')} were recorded {size} too {too}"
    elif each.kind == "offset":
        what = f"its {force} had an offset of {each.value:+.0f} N"
    return f"the recording {each.recording} differs from the others, as if {what} ({sizes})"
