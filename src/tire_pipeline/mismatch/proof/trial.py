"""Put an effect of the catalogue into a recording by its own mechanism, to see whether it is found."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.effects import State, catalogue
from tire_pipeline.mismatch.effects.base import Effect
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.recording.prepare import prepare


def put_in(tire: Any, recording: pd.DataFrame, name: str, parameters: Mapping[str, float]) -> pd.DataFrame:
    """Return a recording as it would be with one more effect.

    What a rig does to a force acts on the recorded force, what a channel reads wrong on that channel. Of
    physics the force changes by what the model says that it changes.

    Parameters
    ----------
    tire : TireModel
    recording : pandas.DataFrame
        Canonical columns, SI.
    name : str
    parameters : mapping
        Those that are not given do nothing.

    Raises
    ------
    RecordingError
        If the recording has rows that can't be used: leave them out first.
    """
    data = prepare(tire, recording).data
    if data.size != len(recording):
        raise RecordingError(
            f"{len(recording) - data.size} rows can't be used", where="put_in", todo="leave these rows out"
        )
    effect = catalogue()[name]
    values = {**effect.zeros(data), **parameters}
    if effect.wrong_channel:
        true = recording[effect.wrong_channel].to_numpy(float)
        return recording.assign(**{effect.wrong_channel: effect.misread(true, values)})
    if type(effect).outputs is not Effect.outputs and not _of_the_tire(effect):
        zero = np.zeros(data.size)
        state = State(zero, zero, zero, data.get("normal_load"), zero, zero, zero, zero)
        state.forces = {
            **data.simulation.both_forces,
            **{o: recording[o].to_numpy(float) for o in data.outputs},
        }
        effect.outputs(state, data, values)
        return recording.assign(**{o: state.forces[o] for o in data.outputs})
    absent = {**effect.zeros(data), **{k: v for k, v in values.items() if k == "reference"}}
    change, before = simulate(data, [(name, values)]), simulate(data, [(name, absent)])
    return recording.assign(**{o: recording[o].to_numpy(float) + change[o] - before[o] for o in data.outputs})


def _of_the_tire(effect: Effect) -> bool:
    """Whether an effect acts on what the tire sees or is, too."""
    return type(effect).inputs is not Effect.inputs or type(effect).tire is not Effect.tire
