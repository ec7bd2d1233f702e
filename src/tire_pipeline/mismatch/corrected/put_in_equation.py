"""An equation of unnamed physics, added to forces: where it holds, and where its clock or way is known."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tire_pipeline.channels import ALIGNING_MOMENT
from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedPhysics
from tire_pipeline.mismatch.unnamed_physics.language.symbols import table_of

Array = np.ndarray


def put_equation(
    equation: UnnamedPhysics,
    data: Data,
    changes: Sequence[Change],
    forces: dict[str, Array],
    last: float,
    later: float,
) -> list[str]:
    """Add an equation to forces, and return what there is to say of it.

    Parameters
    ----------
    equation : UnnamedPhysics
    data : Data
    changes : sequence of (name, parameters)
        Effects that are in.
    forces : dict of ndarray, shape (n,)
        N, and N m for moments; what the equation adds is added here.
    last : float
        Time of the last sample of the recording that was explained, s.
    later : float
        Part of it that is added after that, if it goes with the way rolled.
    """
    for channel in equation.channels:
        if channel not in data.channels and not (channel == "time" and data.time is not None):
            raise RecordingError(
                f"{equation.title} needs the channel {channel}", where=channel, todo="add the column"
            )
    moments = (ALIGNING_MOMENT,) if equation.of_moment else ()
    table, _ = table_of(data, changes, equation.nominal, moments)
    known, after = np.ones(data.size, bool), np.zeros(data.size, bool)
    if equation.of_one_recording and data.wheel.known_way is not None and data.time is not None:
        known = np.isfinite(data.wheel.known_way)
        after = known & (data.time > last)
    weight = equation.weight(table, known)
    added = np.where(known, np.where(after, later, 1.0) * weight, 0.0)
    for name, change in equation.unweighted(table).items():
        if name in forces:
            forces[name] = forces[name] + change * added
    notes = []
    if not known.all():
        notes.append(
            f"{equation.title}: left out at {np.mean(~known):.1%} of the samples, which neither are of the "
            "recording that was explained nor follow it at once: it goes with that one's clock, or the way "
            "rolled since its start"
        )
    if (after & (weight > 0.0)).any():
        notes.append(
            f"{equation.title}: {np.mean(after):.1%} of the samples follow the recording that was explained; "
            f"{later:.0%} of it is added there, as far as earlier sweeps predicted later ones"
        )
    faded = float(np.mean(known & (weight < 1.0)))
    if faded:
        notes.append(f"{equation.title}: faded outside of its range at {faded:.1%} of the samples")
    return notes
