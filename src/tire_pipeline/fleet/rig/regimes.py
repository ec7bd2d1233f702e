"""How each manufacturer measures: rig, surface, temperature, sweeps. Bias begins here."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np


@dataclass(frozen=True)
class Regime:
    """One manufacturer's measurement protocol. All angles rad, loads as a share of the rated load.

    Attributes
    ----------
    adhesion, hysteresis : float
        Test surface: factors on the two kinds of rubber friction (fine grit, coarse texture).
    curvature_radius : float
        1 / drum radius in 1/m; 0 for a flat belt.
    rig_compliance : float
        rad of slip angle lost per N of lateral force (belt and spindle).
    speed : float
        m/s.
    sweep_rate : float
        rad/s of slip angle.
    filter_time : float
        Time constant of the low-pass on the forces, s; causal.
    both_directions : float
        1: up and down sweep are averaged; 0: only the up sweep is used.
    preheat, ambient : float
        degC of the tread at the start and of its surroundings.
    heating : float
        K per J of friction work.
    conditioning : float
        Share of the run-in done before the test.
    pressure : float
        Test pressure over nominal pressure.
    load_low, load_high : float
        Load range over rated load.
    slip_range : float
        Largest slip angle, rad.
    camber_range : float
        Largest camber, rad.
    slip_ratio_range : float
        Largest slip ratio.
    symmetrise : float
        Share of the even part (conicity, ply steer) removed from the curves.
    """

    adhesion: float = 1.0
    hysteresis: float = 1.0
    curvature_radius: float = 0.0
    rig_compliance: float = 1.5e-7
    speed: float = 16.7
    sweep_rate: float = 0.07
    filter_time: float = 0.05
    both_directions: float = 1.0
    preheat: float = 60.0
    ambient: float = 50.0
    heating: float = 2.5e-4
    conditioning: float = 0.8
    pressure: float = 1.0
    load_low: float = 0.25
    load_high: float = 1.40
    slip_range: float = 0.23
    camber_range: float = 0.09
    slip_ratio_range: float = 0.22
    symmetrise: float = 0.3


COMMON = Regime()

REGIMES: dict[str, Regime] = {
    # Flat belt, fine grit, warm tires, slow sweeps both ways: the careful laboratory.
    "A": Regime(
        adhesion=1.14,
        hysteresis=1.09,
        sweep_rate=0.06,
        preheat=68.0,
        ambient=54.0,
        rig_compliance=2.6e-7,
        load_high=1.45,
        slip_range=0.21,
        symmetrise=0.15,
    ),
    # External steel drum with a coarse coating: short contact, soft side force, cold tires.
    "B": Regime(
        adhesion=0.90,
        hysteresis=0.93,
        curvature_radius=0.62,
        rig_compliance=2.0e-7,
        speed=22.0,
        sweep_rate=0.09,
        preheat=52.0,
        ambient=38.0,
        slip_range=0.2,
        symmetrise=0.45,
        load_high=1.3,
    ),
    # Flat belt near the common practice, one direction only and filtered.
    "C": Regime(
        adhesion=1.06,
        hysteresis=1.03,
        both_directions=0.0,
        sweep_rate=0.1,
        filter_time=0.08,
        rig_compliance=3.2e-7,
        preheat=57.0,
        symmetrise=0.4,
        pressure=1.03,
    ),
    # Flat belt, coarse asphalt replica, well run in, high loads.
    "D": Regime(
        adhesion=0.97,
        hysteresis=1.03,
        rig_compliance=0.8e-7,
        conditioning=1.0,
        preheat=60.0,
        load_high=1.5,
        slip_range=0.24,
        symmetrise=0.25,
    ),
    # Trailer on a proving ground: real asphalt, cool, fast one-way sweeps, low peak friction.
    "E": Regime(
        adhesion=0.94,
        hysteresis=0.96,
        both_directions=0.35,
        sweep_rate=0.1,
        speed=19.0,
        preheat=44.0,
        ambient=30.0,
        conditioning=0.4,
        rig_compliance=2.2e-7,
        load_high=1.3,
        slip_range=0.23,
        symmetrise=0.2,
    ),
    # Internal drum: long contact, hot tires, high pressure.
    "F": Regime(
        adhesion=0.97,
        hysteresis=0.95,
        curvature_radius=-0.4,
        rig_compliance=0.8e-7,
        preheat=66.0,
        ambient=58.0,
        pressure=1.04,
        load_high=1.35,
        slip_range=0.2,
        symmetrise=0.35,
    ),
}

# What changes for a manufacturer that changes its protocol half way (kind "drifting").
NEW_PROTOCOL: dict[str, dict[str, float]] = {
    "A": {"adhesion": 1.01, "preheat": 58.0},
    "B": {"adhesion": 0.98, "preheat": 56.0, "ambient": 42.0},
    "C": {"adhesion": 1.05, "sweep_rate": 0.06, "rig_compliance": 1.5e-7},
    "D": {"hysteresis": 1.02, "conditioning": 0.7},
    "E": {"adhesion": 0.97, "hysteresis": 0.97, "rig_compliance": 1.7e-7, "preheat": 48.0},
    "F": {"preheat": 66.0, "ambient": 52.0, "pressure": 1.02},
}

# Categories with under 20 files: small laboratories that copy others' practice with changes.
TINY_REGIMES: dict[str, Regime] = {
    "G": replace(REGIMES["A"], adhesion=1.12, preheat=50.0),
    "H": replace(REGIMES["B"], curvature_radius=0.9, preheat=60.0),
    "I": replace(REGIMES["C"], hysteresis=0.90, sweep_rate=0.06),
    "J": replace(REGIMES["D"], adhesion=0.90, conditioning=0.5),
    "K": replace(REGIMES["F"], curvature_radius=-0.5, pressure=1.0),
}


def regime_of(category: str, protocol: str, bias_size: float) -> Regime:
    """Regime of a manufacturer, moved towards the common one.

    Parameters
    ----------
    category : str
        ``"A"`` to ``"F"``, or a tiny category ``"G"`` to ``"K"``.
    protocol : {"old", "new"}
    bias_size : float
        Every field is ``common + bias_size * (own - common)``.

    Returns
    -------
    Regime
    """
    own = REGIMES[category] if category in REGIMES else TINY_REGIMES[category]
    if protocol == "new":
        own = replace(own, **NEW_PROTOCOL[category])
    values = {}
    for field in fields(Regime):
        common = getattr(COMMON, field.name)
        values[field.name] = common + bias_size * (getattr(own, field.name) - common)
    values["both_directions"] = float(np.clip(values["both_directions"], 0.0, 1.0))
    values["symmetrise"] = float(np.clip(values["symmetrise"], 0.0, 1.0))
    values["conditioning"] = float(np.clip(values["conditioning"], 0.0, 1.0))
    return Regime(**values)


MANUFACTURER_FIELDS: tuple[str, ...] = tuple(field.name for field in fields(Regime))
