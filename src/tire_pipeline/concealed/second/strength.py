"""How large a cause is made: its change of the forces in multiples of noise and misfit."""

import json
from importlib.resources import files

import numpy as np

from tire_pipeline.concealed.second.causes import Cause, Draw
from tire_pipeline.concealed.second.rig import Rig, noise_size
from tire_pipeline.concealed.second.run import Run

TRIES = 8
NEAR = 0.01
SCANNED = 150
WEAKEST, STRONGEST = 0.5, 6.0


def formula_misfit() -> np.ndarray:
    """RMS that a fitted Magic Formula leaves of this simulator's tires, over the force's RMS, (3,).

    Measured by `python -m tire_pipeline.concealed.second.measure_misfit`, which writes the file read here.
    """
    text = files("tire_pipeline.concealed.second").joinpath("misfit.json").read_text(encoding="utf-8")
    return np.array(json.loads(text)["relative_misfit"])


def unit(rig: Rig, forces: np.ndarray, misfit: np.ndarray) -> np.ndarray:
    """One misfit of each force, (3,): noise and the formula's misfit together; N, N, N m."""
    return np.hypot(noise_size(rig), misfit * np.sqrt(np.mean(forces**2, axis=1)))


def reached(change: np.ndarray, one: np.ndarray) -> float:
    """RMS of a change (3, n) in the force it shows in most, in multiples of `one` (3,)."""
    return float(np.max(np.sqrt(np.mean(change**2, axis=1)) / one))


def sized(
    run: Run, cause: Cause, draw: Draw, without: np.ndarray, one: np.ndarray, wanted: float
) -> tuple[float, float]:
    """The size of a cause that changes the forces by `wanted` multiples, and what it reached.

    Secant steps on logarithms between the sizes tried: a change grows with a power of its size, nearly. What
    acts in the load cell alone costs next to nothing, and is scanned where steps do not meet (rounding to
    coarse steps goes up and down). Where physics ends first, `reached` is less than wanted.
    """
    if cause.fixed:
        return cause.begin, reached(run.forces(((cause, cause.begin, draw),)) - without, one)
    still = run.rolled()[0] if cause.on_cell is not None else None

    def strength(size: float) -> float:
        placed = ((cause, size, draw),)
        forces = run.forces(placed) if still is None else run.measured(still, placed)
        return reached(forces - without, one)

    size, slope = cause.begin, 1.0
    below, above = 0.0, cause.most
    tried = strength(size)
    for _ in range(TRIES):
        if abs(tried / wanted - 1.0) < NEAR or (size == cause.most and tried < wanted):
            break
        below, above = (size, above) if tried < wanted else (below, size)
        step = (wanted / max(tried, 1e-9)) ** (1.0 / slope)
        ahead = float(np.clip(size * np.clip(step, 0.05, 20.0), 0.0, cause.most))
        if not below < ahead < above and ahead != cause.most:
            ahead = 0.5 * (below + above)
        found = strength(ahead)
        if ahead != size and found > 0.0 and tried > 0.0:
            slope = float(np.clip(np.log(found / tried) / np.log(ahead / size), 0.3, 3.0))
        size, tried = ahead, found
    if still is not None and abs(tried / wanted - 1.0) > NEAR:
        scanned = [(each, strength(each)) for each in np.geomspace(1e-3, 1.0, SCANNED) * cause.most]
        scanned.append((size, tried))
        size, tried = min(scanned, key=lambda pair: abs(pair[1] - wanted))
    return float(size), tried
