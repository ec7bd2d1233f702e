"""Physical tires: size, class, compound, metadata and the parameters of the true model."""

from __future__ import annotations

import numpy as np
import pandas as pd
from scipy.constants import g as GRAVITY

# width mm, aspect ratio, rim diameter inch, load index kg
SIZES: tuple[tuple[int, int, int, int], ...] = (
    (185, 65, 15, 560),
    (195, 65, 15, 615),
    (205, 55, 16, 615),
    (205, 60, 16, 630),
    (215, 60, 16, 690),
    (225, 45, 17, 615),
    (225, 50, 17, 670),
    (225, 55, 17, 730),
    (235, 45, 18, 670),
    (235, 55, 18, 800),
    (235, 60, 18, 875),
    (245, 40, 18, 650),
    (245, 45, 19, 750),
    (255, 40, 19, 710),
    (255, 50, 19, 875),
    (265, 45, 20, 900),
)
COMPOUNDS: tuple[str, ...] = ("winter", "all-season", "touring", "sport")

# By compound: friction, stiffness factor, best temperature degC, width of the bell K,
# loss of stiffness 1/K, share of hysteresis friction.
_COMPOUND_MEANS: dict[str, tuple[float, ...]] = {
    "winter": (0.95, 0.90, 38.0, 62.0, 0.0052, 0.72),
    "all-season": (1.00, 0.96, 52.0, 66.0, 0.0042, 0.60),
    "touring": (1.04, 1.00, 62.0, 70.0, 0.0034, 0.46),
    "sport": (1.12, 1.07, 78.0, 74.0, 0.0026, 0.34),
}
MEAN_THERMAL: dict[str, float] = {
    "best_temperature": 58.0,
    "temperature_width": 68.0,
    "stiffness_loss": 0.0038,
    "hysteresis_share": 0.53,
    "carcass_softness": 1.0,
}


def draw_tires(count: int, rng: np.random.Generator, first: int = 0) -> pd.DataFrame:
    """Draw physical tires.

    Parameters
    ----------
    count : int
        How many.
    rng : numpy.random.Generator
        Source of all chance.
    first : int, optional
        Number of the first tire, for the index.

    Returns
    -------
    pandas.DataFrame
        One row a tire, indexed ``T0000`` on. Metadata columns (``UNLOADED_RADIUS`` m, ``WIDTH`` m,
        ``ASPECT_RATIO``, ``RIM_RADIUS`` m, ``RIM_WIDTH`` m, ``MASS`` kg, ``NOMPRES`` Pa,
        ``load_index`` kg), ``compound``, and the parameters of :mod:`.rig.true_forces`.
    """
    size = np.array(SIZES)[rng.integers(len(SIZES), size=count)]
    width, aspect = size[:, 0] / 1000.0, size[:, 1] / 100.0
    rim_radius = np.round(size[:, 2] * 0.0254 / 2.0, 4)
    rated = size[:, 3] * GRAVITY
    # Wide, low tires are more often of sport compound: so size tells something about it.
    lowness = (0.55 - aspect) / 0.1 + rng.normal(0.0, 1.0, count)
    compound = np.digitize(lowness, [-0.75, 0.0, 0.75])
    means = np.array([_COMPOUND_MEANS[name] for name in COMPOUNDS])[compound]
    heaviness = rng.normal(0.0, 1.0, count)
    radius = np.round(rim_radius + width * aspect + rng.normal(0.0, 0.0015, count), 4)
    # Of its own generator: the metadata say nothing of the compound beyond what the size says.
    pressure = 2.3 + 0.25 * (rated / 6500.0 - 0.8) + rng.spawn(1)[0].normal(0.0, 0.12, count)
    mass = 9.6 * (width / 0.215) * (radius / 0.32) ** 1.6 * (rated / 6500.0) ** 0.3
    tires = pd.DataFrame(
        {
            "UNLOADED_RADIUS": radius,
            "WIDTH": width,
            "ASPECT_RATIO": aspect,
            "RIM_RADIUS": rim_radius,
            "RIM_WIDTH": np.round(np.round(width * 0.88 / 0.0127) * 0.0127, 4),
            "MASS": np.round(mass * (1.0 + 0.06 * heaviness), 2),
            "NOMPRES": np.round(np.round(pressure, 1) * 1e5),
            "load_index": size[:, 3],
            "compound": np.array(COMPOUNDS)[compound],
        },
        index=pd.Index([f"T{first + i:04d}" for i in range(count)], name="tire"),
    )
    tires = tires.assign(**_true_parameters(tires, means, heaviness, rng))
    return _unique_metadata(tires)


def _true_parameters(
    tires: pd.DataFrame, means: np.ndarray, heaviness: np.ndarray, rng: np.random.Generator
) -> dict[str, np.ndarray]:
    """Return the parameters of the true model; some follow from the size, some from chance."""
    count = len(tires)
    rated = tires["load_index"].to_numpy() * GRAVITY
    aspect = tires["ASPECT_RATIO"].to_numpy()
    low = (0.52 - aspect) / 0.08
    big = (rated - 6800.0) / 1000.0

    def spread(scale: float) -> np.ndarray:
        return rng.normal(0.0, scale, count)

    softness = 1.0 - 0.13 * low - 0.08 * heaviness + spread(0.08)
    size_friction = 1.0 + 0.030 * low - 0.020 * heaviness
    size_stiffness = 1.0 + 0.075 * low + 0.045 * heaviness
    return {
        "rated_load": rated,
        "friction": means[:, 0] * size_friction * (1.0 + spread(0.018)),
        "friction_load": 0.135 - 0.026 * low + 0.024 * heaviness + spread(0.016),
        "stiffness": 17.0 * means[:, 1] * size_stiffness * (1.0 + spread(0.025)),
        "stiffness_peak": 1.55 + 0.13 * low - 0.08 * big + spread(0.07),
        "stiffness_shape": 1.05 - 0.05 * low + spread(0.06),
        "pressure_shape": 2.80 + 0.24 * low - 0.20 * heaviness + spread(0.18),
        "friction_drop": 0.17 + 0.25 * (means[:, 0] - 1.0) - 0.030 * low + spread(0.025),
        "slide_speed": 4.0 + spread(0.30),
        "ply_steer": spread(0.0018),
        "conicity": spread(0.0070),
        "conicity_load": 0.5 + spread(0.4),
        "ply_steer_load": spread(0.6),
        "camber_thrust": 0.052 + 0.03 * (tires["WIDTH"].to_numpy() - 0.22) / 0.04 * 0.2 + spread(0.003),
        "camber_friction": 1.8 + spread(0.25),
        "camber_stiffness": 0.42 + spread(0.05),
        "contact_length": 0.36 + 0.1 * (aspect - 0.5) + spread(0.012),
        "residual_torque": 0.0035 + spread(0.0006),
        "slip_stiffness": 23.0 * means[:, 1] * (1.0 + spread(0.03)),
        "slip_stiffness_load": 0.20 + spread(0.03),
        "friction_x_ratio": 1.04 + spread(0.015),
        "pressure_shape_x": 2.6 + spread(0.12),
        "best_temperature": means[:, 2] + spread(2.0),
        "temperature_width": means[:, 3],
        "stiffness_loss": means[:, 4] * (1.0 + spread(0.05)),
        "hysteresis_share": means[:, 5] + spread(0.02),
        "carcass_softness": softness,
        "carcass_stiffness": 1.75e5 / np.clip(softness, 0.6, 1.5),
    }


def _unique_metadata(tires: pd.DataFrame) -> pd.DataFrame:
    """Shift masses by 10 g until no two tires have the same metadata."""
    keys = ["UNLOADED_RADIUS", "WIDTH", "ASPECT_RATIO", "RIM_RADIUS"]
    seen: set[tuple[float, ...]] = set()
    masses = []
    for *key, mass in tires[[*keys, "MASS"]].itertuples(index=False):
        while (*key, mass) in seen:
            mass = round(mass + 0.01, 2)
        seen.add((*key, mass))
        masses.append(mass)
    return tires.assign(MASS=masses)


def thermal_parameters(tires: pd.DataFrame, interaction: float) -> pd.DataFrame:
    """Blend each tire's own sensitivities with those of the mean tire.

    Parameters
    ----------
    tires : pandas.DataFrame
        From :func:`draw_tires`.
    interaction : float
        0: all tires react alike to surface, temperature and drum (*additive* bias); 1: each tire as
        its compound and carcass make it react.

    Returns
    -------
    pandas.DataFrame
        The same table with the blended columns.
    """
    blended = {name: mean + interaction * (tires[name] - mean) for name, mean in MEAN_THERMAL.items()}
    return tires.assign(**blended)
