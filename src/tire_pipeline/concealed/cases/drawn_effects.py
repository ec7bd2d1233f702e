"""Which effects a case conceals, and the decoys of those that conceal none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tire_pipeline.concealed.effect_names import (
    AMBIGUOUS_SETS,
    ARTEFACTS,
    HEAT_OR_WEAR,
    PHYSICS,
    UNKNOWN_EFFECTS,
)

KIND_SHARES: dict[str, float] = {
    "nothing": 0.20,
    "single": 0.35,
    "pair": 0.15,
    "ambiguous": 0.10,
    "artefact": 0.10,
    "unknown": 0.10,
}
"""Share of each kind among the cases."""

_CONFOUNDED_PAIRS = (
    {"relaxation_length", "time_delay"},
    {"temperature", "wear"},
    {"plysteer_conicity", "force_offset"},
    {"plysteer_conicity", "slip_angle_offset"},
    {"stiffness_scale", "compliance"},
    {"friction_scale", "force_gain"},
    {"stiffness_scale", "force_gain"},
    {"friction_scale", "surface_change"},
)
_IN_PAIRS = ("force_offset", "slip_angle_offset", "time_delay", "crosstalk", "sensor_drift")
_CHOSEN_ARTEFACTS = tuple(name for name in ARTEFACTS if name not in ("camber_offset", "load_gain"))


@dataclass(frozen=True)
class Choice:
    """What is concealed and what the schedule is made for."""

    effects: tuple[str, ...]
    focus: tuple[str, ...]
    ambiguous: int | None
    hide_temperature: bool


def choose(rng: np.random.Generator, kind: str) -> Choice:
    """Draw the effects of a case and the focus of its schedule.

    Where nothing physical is concealed the focus is a decoy: drawn as if the case were a single,
    a pair or an ambiguous one, in their proportions.

    Parameters
    ----------
    rng : numpy.random.Generator
    kind : str
        One of ``effect_names.KINDS``.
    """
    if kind in ("nothing", "artefact", "unknown"):
        as_if = str(rng.choice(["single", "pair", "ambiguous"], p=[35 / 60, 15 / 60, 10 / 60]))
        if kind != "nothing":
            as_if = str(rng.choice(["single", "pair"], p=[0.7, 0.3]))
        decoy = choose(rng, as_if)
        if kind == "nothing":
            return Choice((), decoy.focus, decoy.ambiguous, decoy.hide_temperature)
        name = str(rng.choice(_CHOSEN_ARTEFACTS if kind == "artefact" else UNKNOWN_EFFECTS))
        return Choice((name,), (*decoy.focus, name), decoy.ambiguous, decoy.hide_temperature)
    if kind == "single":
        names: tuple[str, ...] = (str(rng.choice(PHYSICS)),)
        return Choice(names, names, None, _hidden(rng, names))
    if kind == "pair":
        names = _draw_pair(rng)
        return Choice(names, names, None, _hidden(rng, names))
    which = int(rng.choice(len(AMBIGUOUS_SETS), p=[0.3, 0.3, 0.3, 0.1]))
    name = str(rng.choice(AMBIGUOUS_SETS[which][: 1 if which == 3 else 2]))
    return Choice((name,), (name,), which, which == HEAT_OR_WEAR)


def _draw_pair(rng: np.random.Generator) -> tuple[str, ...]:
    while True:
        first = str(rng.choice(PHYSICS))
        second = str(rng.choice(PHYSICS if rng.random() < 0.75 else _IN_PAIRS))
        if first != second and {first, second} not in _CONFOUNDED_PAIRS:
            return (first, second)


def _hidden(rng: np.random.Generator, names: tuple[str, ...]) -> bool:
    return bool(rng.random() < (0.5 if "temperature" in names else 0.3))
