"""How strong an effect is: measured in the recording, and scaled to what was drawn."""

from __future__ import annotations

import math
from collections.abc import Callable

from tire_pipeline.concealed.brush_rig import artefacts, unknown_effects

PHYSICS_GUESS: dict[str, float] = {
    "friction_scale": 0.04,
    "stiffness_scale": 0.06,
    "load_sensitivity": 0.05,
    "camber": 0.4,
    "combined_slip": 0.3,
    "inflation_pressure": 0.5,
    "temperature": 0.2,
    "speed_dependence": 0.04,
    "relaxation_length": 0.6,
    "wear": 0.06,
    "plysteer_conicity": 1.0,
    "turn_slip": 0.5,
    "nonuniformity": 1.0,
    "compliance": 0.003,
    "surface_change": 0.05,
}
"""Strength from which the wanted one is searched, in the brush's terms."""

PHYSICS_LIMITS: dict[str, tuple[float, float]] = {
    "friction_scale": (0.003, 0.4),
    "stiffness_scale": (0.005, 0.5),
    "load_sensitivity": (0.003, 0.3),
    "camber": (0.02, 1.5),
    "combined_slip": (0.02, 1.2),
    "inflation_pressure": (0.02, 2.0),
    "temperature": (0.01, 1.2),
    "speed_dependence": (0.003, 0.25),
    "relaxation_length": (0.02, 2.0),
    "wear": (0.004, 0.4),
    "plysteer_conicity": (0.05, 8.0),
    "turn_slip": (0.05, 2.0),
    "nonuniformity": (0.05, 8.0),
    "compliance": (1e-4, 0.02),
    "surface_change": (0.004, 0.5),
}
"""Smallest and largest strength that is still a tire or a rig."""

SIGNED = (
    "friction_scale",
    "stiffness_scale",
    "surface_change",
    "combined_slip",
    "load_rate",
    "slip_rate",
)
"""Effects whose sign is drawn as well."""

STRENGTH_GUESS = PHYSICS_GUESS | artefacts.ARTEFACT_GUESS | unknown_effects.UNKNOWN_GUESS
STRENGTH_LIMITS = PHYSICS_LIMITS | artefacts.ARTEFACT_LIMITS | unknown_effects.UNKNOWN_LIMITS


def draw_ratio(rng, low: float, high: float) -> float:
    """Draw effect over misfit: 45% of the draws below twice the misfit, the rest above."""
    if rng.random() < 0.45:
        return float(rng.uniform(low, 2.0))
    return float(rng.uniform(2.0, high))


def find_strength(
    measure: Callable[[float], float], wanted: float, guess: float, limits: tuple[float, float]
) -> tuple[float, float]:
    """Find the strength whose effect measures ``wanted``.

    Parameters
    ----------
    measure : callable
        Strength -> effect over misfit. About proportional.
    wanted, guess : float
    limits : (low, high)

    Returns
    -------
    strength, measured : float
        The best of five trials at most; near ``wanted`` unless a limit stops it.
    """
    tried: list[tuple[float, float]] = []
    x = guess
    for _ in range(5):
        got = measure(x)
        tried.append((x, got))
        if abs(got / wanted - 1.0) < 0.15:
            break
        slope = 1.0
        if len(tried) > 1 and tried[-2][1] > 0 and got > 0 and tried[-2][0] != x:
            run = math.log(x / tried[-2][0])
            slope = min(max(math.log(got / tried[-2][1]) / run, 0.3), 3.0)
        step = (wanted / got) ** (1.0 / slope) if got > 0 else 4.0
        new = min(max(x * min(max(step, 0.05), 20.0), limits[0]), limits[1])
        if new == x:
            break
        x = new
    return min(tried, key=lambda pair: abs(math.log(max(pair[1], 1e-9) / wanted)))
