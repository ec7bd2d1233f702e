"""What a formula leaves over the load, of friction and of stiffness: a curvature that all forces share.

Friction and slip stiffness over the load are polynomials of low degree in the formula, and a fit of forces
hardly weighs small loads. So a fit leaves some percent of the force there, of the longitudinal and the
lateral one alike, and nothing of the level or of the slope over load, which the fit has met.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.simulated import DIFFERENCE

Array = np.ndarray
FAMILY = "load"


def load_curvature(data: Data) -> list[Mapping[str, Array]]:
    """Return the change of the forces by the friction, and by the stiffness; nothing at one load.

    Parameters
    ----------
    data : Data

    Returns
    -------
    list of dict of ndarray, shape (n, 1)
        For each output, N. Between three loads and more it is what a parabola has beside a straight line,
        which is fitted by the weight of the squared force.
    """
    if not data.varies("normal_load"):
        return []
    base = data.simulation.base
    weight = np.sqrt(sum(force**2 for force in base.values()))
    excess = data.nominal.load_excess(data.get("normal_load"))
    line, parabola = np.column_stack([np.ones(excess.size), excess]), excess**2
    bend = parabola - line @ np.linalg.lstsq(line * weight[:, None], parabola * weight, rcond=None)[0]
    return [_changed(data, friction=bend), _changed(data, stiffness=bend)]


def _changed(
    data: Data, *, friction: Array | float = 0.0, stiffness: Array | float = 0.0
) -> dict[str, Array]:
    """Return the derivative of the forces by a change of friction or stiffness, times its size."""
    simulation, ends = data.simulation, []
    for sign in (1.0, -1.0):
        state = simulation.as_recorded()
        state.log_friction = state.log_friction + sign * DIFFERENCE * friction
        state.log_stiffness = state.log_stiffness + sign * DIFFERENCE * stiffness
        simulation.relax(state)
        ends.append(simulation.forces(state))
    up, down = ends
    return {o: ((up[o] - down[o]) / (2.0 * DIFFERENCE))[:, None] for o in data.outputs}
