"""Which real recordings, which kinds and which effects: all from a seed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

SOURCE_SHARES: dict[str, float] = {"calspan": 0.56, "dart": 0.30, "tydex": 0.14}
"""Share of each source among the cases; at most 0.15 from ``tydex``."""

SOURCE_KINDS: dict[str, dict[str, float]] = {
    "calspan": {
        "nothing": 0.27,
        "hidden": 0.21,
        "physics": 0.15,
        "artefact": 0.15,
        "pair": 0.10,
        "ambiguous": 0.09,
        "unknown": 0.03,
    },
    "dart": {
        "nothing": 0.31,
        "physics": 0.22,
        "artefact": 0.24,
        "pair": 0.10,
        "ambiguous": 0.09,
        "unknown": 0.04,
    },
    "tydex": {
        "nothing": 0.27,
        "hidden": 0.18,
        "physics": 0.20,
        "artefact": 0.24,
        "pair": 0.06,
        "ambiguous": 0.05,
    },
}
"""Share of each kind among the cases of a source; 0.28 of all have nothing."""

EFFECTS: dict[str, dict[str, tuple[str, ...]]] = {
    "calspan": {
        "physics": (
            "friction_scale",
            "stiffness_scale",
            "load_sensitivity",
            "temperature",
            "compliance",
            "nonuniformity",
        ),
        "artefact": (
            "force_offset",
            "force_gain",
            "load_offset",
            "slip_angle_offset",
            "sensor_drift",
            "clipping",
            "stuck_channel",
            "sign_convention",
            "unit_error",
        ),
        "ambiguous": (
            "relaxation_length",
            "time_delay",
            "low_pass",
            "crosstalk",
            "camber_offset",
            "load_gain",
            "wear",
            "surface_change",
        ),
    },
    "dart": {
        "physics": ("friction_scale", "stiffness_scale", "speed_dependence", "compliance"),
        "artefact": (
            "slip_angle_offset",
            "sensor_drift",
            "clipping",
            "stuck_channel",
            "sign_convention",
            "unit_error",
        ),
        "ambiguous": (
            "force_offset",
            "force_gain",
            "load_gain",
            "relaxation_length",
            "time_delay",
            "low_pass",
            "wear",
            "surface_change",
        ),
    },
    "tydex": {
        "physics": ("friction_scale", "stiffness_scale", "load_sensitivity", "compliance"),
        "artefact": (
            "force_offset",
            "force_gain",
            "load_offset",
            "slip_angle_offset",
            "clipping",
            "sign_convention",
            "unit_error",
        ),
        "ambiguous": ("crosstalk", "camber_offset", "load_gain"),
    },
}
"""What can be put into the recordings of each source without a tire. *Ambiguous* is what these recordings
can't tell from something else: a lag at one speed or in slow ramps; a slow change of what was not recorded;
a side force that goes with the load; an offset where there is one load; a gain of the load, in which peak and
slope are nearly proportional, and at one load a gain of the force, of which it leaves a tenth at most."""

HIDEABLE: dict[str, tuple[tuple[str, ...], ...]] = {
    "calspan": (
        ("camber",),
        ("inflation_pressure",),
        ("camber", "inflation_pressure"),
        ("load_sensitivity",),
    ),
    "tydex": (("camber",),),
}

LAGGING_EFFECTS: tuple[str, ...] = ("relaxation_length", "time_delay", "low_pass")
SLOW_EFFECTS: tuple[str, ...] = ("wear", "surface_change", "temperature", "sensor_drift")
SIDE_FORCE_EFFECTS: tuple[str, ...] = (
    "force_offset",
    "plysteer_conicity",
    "crosstalk",
    "slip_angle_offset",
    "camber_offset",
)
SCALE_EFFECTS: tuple[str, ...] = ("load_gain", "force_gain", "friction_scale", "load_offset")
ALIKE: dict[str, tuple[str, ...]] = (
    dict.fromkeys(LAGGING_EFFECTS, LAGGING_EFFECTS)
    | dict.fromkeys(("wear", "surface_change"), SLOW_EFFECTS)
    | dict.fromkeys(("force_offset", "crosstalk", "camber_offset"), SIDE_FORCE_EFFECTS)
    | dict.fromkeys(("load_gain", "force_gain"), SCALE_EFFECTS)
)
"""Effect of an ambiguous case -> names that its recording cannot separate from it."""

CONFOUNDED = (
    {"stiffness_scale", "compliance"},
    {"friction_scale", "force_gain"},
    {"stiffness_scale", "force_gain"},
    {"friction_scale", "compliance"},
    {"stuck_channel", "clipping"},
)
"""Never together in one case: each of them with the other is one of something else."""

UNSCALED_EFFECTS = ("stuck_channel", "sign_convention", "unit_error")


@dataclass(frozen=True)
class RealPlan:
    """One case to make: a seed, a source and a kind of ``SOURCE_KINDS``."""

    seed: int
    source: str
    kind: str

    @property
    def case_id(self) -> str:
        """Says nothing about the content."""
        return f"real_{self.seed:010d}"

    def stream(self) -> np.random.SeedSequence:
        """What all draws of this case come from."""
        return np.random.SeedSequence(
            [
                self.seed,
                list(SOURCE_KINDS).index(self.source),
                list(SOURCE_KINDS[self.source]).index(self.kind),
            ]
        )


@dataclass(frozen=True)
class Effects:
    """What a case conceals; ``kind`` is the scorer's (``effect_names.KINDS``)."""

    kind: str
    hidden: tuple[str, ...]
    put_in: tuple[str, ...]
    acceptable: tuple[str, ...]


def real_plan(n: int, seed: int, *, source: str | None = None, kind: str | None = None) -> list[RealPlan]:
    """Plan a set of cases, shuffled.

    Parameters
    ----------
    n, seed : int
    source, kind : str, optional
        Only these.
    """
    rng = np.random.default_rng([seed, 24])
    sources = {source: 1.0} if source else SOURCE_SHARES
    cells = [
        (where, what, part * share)
        for where, part in sources.items()
        for what, share in SOURCE_KINDS[where].items()
        if kind in (None, what)
    ]
    total = sum(share for _, _, share in cells)
    counts = _apportion([n * share / total for _, _, share in cells], n)
    wanted = [(where, what) for (where, what, _), k in zip(cells, counts, strict=True) for _ in range(k)]
    seeds = rng.choice(10**9, size=n, replace=False)
    return [RealPlan(int(seeds[i]), *wanted[j]) for i, j in enumerate(rng.permutation(n))]


def _apportion(shares: Sequence[float], n: int) -> list[int]:
    """Whole numbers that sum to ``n``: the largest remainders are rounded up."""
    low = np.floor(shares).astype(int)
    order = np.argsort(low - np.asarray(shares), kind="stable")
    low[order[: n - int(low.sum())]] += 1
    return [int(k) for k in low]


def draw_effects(rng: np.random.Generator, plan: RealPlan) -> Effects:
    """Draw what a case conceals."""
    table = EFFECTS[plan.source]
    if plan.kind == "nothing":
        return Effects("nothing", (), (), ())
    if plan.kind == "unknown":
        return Effects("unknown", (), ("quantisation",), ())
    if plan.kind == "hidden":
        sets = HIDEABLE[plan.source]
        hidden = sets[int(rng.integers(len(sets)))]
        return Effects("single" if len(hidden) == 1 else "pair", hidden, (), ())
    if plan.kind == "pair":
        return _pair(rng, plan.source)
    name = str(rng.choice(table[plan.kind]))
    if plan.kind == "ambiguous":
        return Effects("ambiguous", (), (name,), ALIKE[name])
    return Effects("single" if plan.kind == "physics" else "artefact", (), (name,), ())


def _pair(rng: np.random.Generator, source: str) -> Effects:
    """Physics with physics or an artefact; hidden physics with an artefact where it can be hidden."""
    table = EFFECTS[source]
    artefacts = [name for name in table["artefact"] if name not in UNSCALED_EFFECTS]
    if source in HIDEABLE and rng.random() < 0.35:
        single = [s for s in HIDEABLE[source] if len(s) == 1]
        return Effects("pair", single[int(rng.integers(len(single)))], (str(rng.choice(artefacts)),), ())
    while True:
        first = str(rng.choice(table["physics"]))
        second = str(rng.choice(table["physics"] if rng.random() < 0.4 else artefacts))
        if first != second and {first, second} not in CONFOUNDED:
            return Effects("pair", (), (first, second), ())
