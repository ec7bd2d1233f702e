"""A mechanism that is in no catalogue: what it needs, what it does, and how large it is made."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from tire_pipeline.concealed.open_world.world import World

TRIES = 30
NEAR = 0.005
WEAKEST, STRONGEST = 0.5, 6.0

Shape = dict[str, float]


def no_shape(rng: np.random.Generator) -> Shape:
    """A mechanism whose only number is its size."""
    return {}


@dataclass(frozen=True)
class Mechanism:
    """One mechanism.

    `change(world, size, shape)` gives the change of the forces, (n, 3); size zero changes nothing. `drivers`
    are what it depends on beside the force that it is a part of: recorded channels, "memory of" one, "path"
    or "time"; `acts_on` is the tire or the rig. `expressions` has the change of each force as text for sympy
    in the symbols of `world.SYMBOLS` where a closed form exists, else nothing.
    """

    name: str
    source: str
    drivers: tuple[str, ...]
    acts_on: str
    change: Callable[[World, float, Shape], np.ndarray]
    shape: Callable[[np.random.Generator], Shape] = no_shape
    expressions: dict[str, str] = field(default_factory=dict)
    begin: float = 0.01


@dataclass(frozen=True)
class Added:
    """What was put in: change of the forces (n, 3), size, shape, and its strength in misfits."""

    mechanism: str
    change: np.ndarray
    size: float
    shape: Shape
    strength: float


def strength_of(change: np.ndarray, unit: np.ndarray) -> float:
    """RMS of a change (n, 3) in the force it shows in most, over one misfit of each force (3,)."""
    return float(np.max(np.sqrt(np.mean(change**2, axis=0)) / unit))


def put_in(
    mechanism: Mechanism,
    world: World,
    unit: np.ndarray,
    rng: np.random.Generator,
    strength: float | None = None,
) -> Added:
    """A mechanism at a size that changes the forces by so many misfits.

    Parameters
    ----------
    unit
        One misfit of fx, fy, mz, (3,): N, N, N m.
    strength
        None: drawn, even on a logarithmic scale from 0.5 to 6.

    Raises
    ------
    ValueError
        Where the run does not excite the mechanism, so that no size changes the forces by that much.
    """
    wanted = strength or float(np.exp(rng.uniform(np.log(WEAKEST), np.log(STRONGEST))))
    shape = mechanism.shape(rng)
    size = mechanism.begin
    for _ in range(TRIES):
        change = mechanism.change(world, size, shape)
        found = strength_of(change, unit)
        if found == 0.0:
            break
        if abs(found / wanted - 1.0) < NEAR:
            return Added(mechanism.name, change, size, shape, found)
        size *= float(np.clip(wanted / found, 0.1, 10.0))
    needed = ", ".join(mechanism.drivers)
    raise ValueError(f"{mechanism.name}: no size makes {wanted:.2g} misfits in this run; excite {needed}")
