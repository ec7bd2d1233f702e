"""The model with effects added: channels -> slips at the tire -> forces -> what is recorded."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from tire_pipeline.mismatch.effects import Effect, State, catalogue
from tire_pipeline.mismatch.model.data import Data

Array = np.ndarray
Change = tuple[str, Mapping[str, float]]


def simulate(data: Data, changes: Sequence[Change] = ()) -> dict[str, Array]:
    """Simulate the recording with effects added.

    Parameters
    ----------
    data : Data
        The prepared recording; it holds the tire.
    changes : sequence of (name, parameters)
        Effects and their parameters; one that is not given does nothing.

    Returns
    -------
    dict of ndarray
        One array for each of ``data.outputs``, N.
    """
    state, effects = _at_the_tire(data, changes)
    state.forces = data.simulation.forces(state)
    for effect, p in effects:
        effect.outputs(state, data, p)
    return {name: state.forces[name] for name in data.outputs}


def simulate_moments(data: Data, changes: Sequence[Change], names: Sequence[str]) -> dict[str, Array]:
    """Simulate moments with effects added.

    Effects act on the slips and on the tire. A lag of the recorded forces is one of the moments, too; a gain
    or an offset of a force leaves them as they are.

    Parameters
    ----------
    data : Data
    changes : sequence of (name, parameters)
    names : sequence of str
        Some of ``mx, my, mz``.

    Returns
    -------
    dict of ndarray, shape (n,)
        N m.
    """
    if not changes:
        return {name: data.simulation.base_moments[name] for name in names}
    state, effects = _at_the_tire(data, changes)
    state.forces = data.simulation.moments(state, names)
    for effect, p in effects:
        effect.moments(state, data, p)
    return state.forces


def _at_the_tire(
    data: Data, changes: Sequence[Change]
) -> tuple[State, list[tuple[Effect, Mapping[str, float]]]]:
    """What the tire sees and what it is like, and the effects in their order."""
    effects: list[tuple[Effect, Mapping[str, float]]] = [
        (catalogue()[name], {**catalogue()[name].zeros(data), **p}) for name, p in changes
    ]
    effects.sort(key=lambda e: e[0].order)
    state = data.simulation.as_recorded()
    for effect, p in effects:
        effect.inputs(state, data, p)
    if not any(effect.instead_of_file for effect, _ in effects):
        data.simulation.relax(state)
    for effect, p in effects:
        effect.tire(state, data, p)
    return state, effects
