"""Everything a file holds beside the 58 pure-slip coefficients: combined slip, ranges, stiffness."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.fleet.rig.regimes import Regime


def other_values(
    tires: pd.DataFrame,
    coefficients: pd.DataFrame,
    regime: Regime,
    condition: pd.DataFrame,
    rng: np.random.Generator,
) -> pd.DataFrame:
    """Combined slip, overturning, rolling resistance, ranges and metadata of n files.

    Combined-slip coefficients are not measured by these rigs: they follow from the pure-slip ones,
    as practice has it, with a little scatter.

    Parameters
    ----------
    tires : pandas.DataFrame
        n physical tires.
    coefficients : pandas.DataFrame
        n rows of :func:`.fits.fit.fit_all`.
    regime : Regime
    condition : pandas.DataFrame
        n rows with ``pressure``.
    rng : numpy.random.Generator

    Returns
    -------
    pandas.DataFrame
        n rows, columns by ``.tir`` key, SI.
    """
    count = len(tires)
    rated = tires["rated_load"].to_numpy()
    soft = tires["carcass_softness"].to_numpy()
    fnomin = coefficients["FNOMIN"].to_numpy()

    def scatter(mean: np.ndarray | float, share: float) -> np.ndarray:
        return mean * (1.0 + share * rng.normal(0.0, 1.0, count))

    values: dict[str, np.ndarray | float] = {
        "RBX1": scatter(12.5, 0.05),
        "RBX2": scatter(-10.0, 0.05),
        "RCX1": scatter(1.08, 0.01),
        "REX1": scatter(-0.3, 0.2),
        "REX2": scatter(-0.05, 0.5),
        "RHX1": 0.0,
        "RBY1": scatter(10.0, 0.06),
        "RBY2": scatter(8.0, 0.06),
        "RBY3": rng.normal(0.0, 0.01, count),
        "RCY1": scatter(1.05, 0.01),
        "REY1": scatter(-0.2, 0.2),
        "REY2": scatter(-0.05, 0.5),
        "RHY1": rng.normal(0.005, 0.002, count),
        "RHY2": rng.normal(0.0, 0.002, count),
        "RVY1": rng.normal(0.03, 0.01, count),
        "RVY2": rng.normal(-0.02, 0.01, count),
        "RVY3": rng.normal(-0.3, 0.05, count),
        "RVY4": scatter(12.0, 0.1),
        "RVY5": scatter(1.9, 0.02),
        "RVY6": scatter(-12.0, 0.1),
        "PTX1": scatter(1.2, 0.05),
        "PTX2": scatter(-0.05, 0.3),
        "PTX3": scatter(0.2, 0.1),
        "PTY1": scatter(1.9 * np.sqrt(soft), 0.03),
        "PTY2": scatter(1.8, 0.03),
        "QSX1": rng.normal(0.0, 0.004, count),
        "QSX2": scatter(0.9, 0.05),
        "QSX3": scatter(0.07 * soft, 0.05),
        "QSY1": scatter(0.009, 0.06),
        "QSY2": 0.0,
        "QSY3": scatter(0.001, 0.2),
        "QSY4": scatter(0.0004, 0.2),
        "SSZ1": rng.normal(0.01, 0.004, count),
        "SSZ2": scatter(0.004, 0.2),
        "SSZ3": rng.normal(0.2, 0.05, count),
        "SSZ4": rng.normal(-0.1, 0.04, count),
        "QTZ1": scatter(0.2, 0.02),
        "MBELT": np.round(0.55 * tires["MASS"].to_numpy(), 3),
        "VERTICAL_STIFFNESS": np.round(scatter(2.1e5 * (rated / 6500.0) ** 0.6, 0.02), -2),
        "VERTICAL_DAMPING": np.full(count, 50.0),
        "BREFF": scatter(8.0, 0.05),
        "DREFF": scatter(0.25, 0.05),
        "FREFF": scatter(0.07, 0.1),
        "FNOMIN": fnomin,
        "VXLOW": 1.0,
        "LONGVL": np.full(count, round(regime.speed, 2)),
        "KPUMIN": np.full(count, -round(regime.slip_ratio_range, 3)),
        "KPUMAX": np.full(count, round(regime.slip_ratio_range, 3)),
        "ALPMIN": np.full(count, -round(regime.slip_range, 4)),
        "ALPMAX": np.full(count, round(regime.slip_range, 4)),
        "CAMMIN": np.full(count, -round(regime.camber_range, 4)),
        "CAMMAX": np.full(count, round(regime.camber_range, 4)),
        "FZMIN": np.round(regime.load_low * rated, -1),
        "FZMAX": np.round(regime.load_high * rated, -1),
        "INFLPRES": np.round(tires["NOMPRES"].to_numpy() * condition["pressure"].to_numpy(), -3),
    }
    table = pd.DataFrame(values, index=coefficients.index)
    for name in WRITTEN_METADATA:
        table[name] = tires[name].to_numpy()
    return table


WRITTEN_METADATA: tuple[str, ...] = (
    "UNLOADED_RADIUS",
    "WIDTH",
    "ASPECT_RATIO",
    "RIM_RADIUS",
    "RIM_WIDTH",
    "MASS",
    "NOMPRES",
)
