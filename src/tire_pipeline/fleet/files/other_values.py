"""Everything a file holds beside the 58 pure-slip coefficients: combined slip, ranges, stiffness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from tire_pipeline.fleet.rig.regimes import Regime

WRITTEN_METADATA: tuple[str, ...] = (
    "UNLOADED_RADIUS",
    "WIDTH",
    "ASPECT_RATIO",
    "RIM_RADIUS",
    "RIM_WIDTH",
    "MASS",
    "NOMPRES",
)


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
        n rows of :func:`.manufacturer_fits.fit_sweeps.fit_all`.
    regime : Regime
    condition : pandas.DataFrame
        n rows with ``pressure``.
    rng : numpy.random.Generator

    Returns
    -------
    pandas.DataFrame
        n rows, columns by ``.tir`` key, SI.
    """
    draws = _Draws(len(tires), rng)
    soft = tires["carcass_softness"].to_numpy()
    values = {
        **_combined_slip(draws),
        **_relaxation(draws, soft),
        **_further_moments(draws, soft),
        **_belt_and_spring(draws, tires),
        "FNOMIN": coefficients["FNOMIN"].to_numpy(),
        "VXLOW": 1.0,
        "LONGVL": np.full(len(tires), round(regime.speed, 2)),
        **_ranges(tires, regime),
        "INFLPRES": np.round(tires["NOMPRES"].to_numpy() * condition["pressure"].to_numpy(), -3),
    }
    table = pd.DataFrame(values, index=coefficients.index)
    for name in WRITTEN_METADATA:
        table[name] = tires[name].to_numpy()
    return table


@dataclass(frozen=True)
class _Draws:
    """Draws of one value a tire: a file's values come from the generator in the order they are asked for."""

    count: int
    rng: np.random.Generator

    def about(self, mean: np.ndarray | float, share: float) -> np.ndarray:
        """About a mean, with a standard deviation that is a share of it."""
        return mean * (1.0 + share * self.rng.normal(0.0, 1.0, self.count))

    def normal(self, mean: float, deviation: float) -> np.ndarray:
        """About a mean that may be zero."""
        return self.rng.normal(mean, deviation, self.count)


def _combined_slip(draws: _Draws) -> dict[str, np.ndarray | float]:
    return {
        "RBX1": draws.about(12.5, 0.05),
        "RBX2": draws.about(-10.0, 0.05),
        "RCX1": draws.about(1.08, 0.01),
        "REX1": draws.about(-0.3, 0.2),
        "REX2": draws.about(-0.05, 0.5),
        "RHX1": 0.0,
        "RBY1": draws.about(10.0, 0.06),
        "RBY2": draws.about(8.0, 0.06),
        "RBY3": draws.normal(0.0, 0.01),
        "RCY1": draws.about(1.05, 0.01),
        "REY1": draws.about(-0.2, 0.2),
        "REY2": draws.about(-0.05, 0.5),
        "RHY1": draws.normal(0.005, 0.002),
        "RHY2": draws.normal(0.0, 0.002),
        "RVY1": draws.normal(0.03, 0.01),
        "RVY2": draws.normal(-0.02, 0.01),
        "RVY3": draws.normal(-0.3, 0.05),
        "RVY4": draws.about(12.0, 0.1),
        "RVY5": draws.about(1.9, 0.02),
        "RVY6": draws.about(-12.0, 0.1),
    }


def _relaxation(draws: _Draws, soft: np.ndarray) -> dict[str, np.ndarray]:
    return {
        "PTX1": draws.about(1.2, 0.05),
        "PTX2": draws.about(-0.05, 0.3),
        "PTX3": draws.about(0.2, 0.1),
        "PTY1": draws.about(1.9 * np.sqrt(soft), 0.03),
        "PTY2": draws.about(1.8, 0.03),
    }


def _further_moments(draws: _Draws, soft: np.ndarray) -> dict[str, np.ndarray | float]:
    """Overturning, rolling resistance, and what combined slip adds to the aligning torque."""
    return {
        "QSX1": draws.normal(0.0, 0.004),
        "QSX2": draws.about(0.9, 0.05),
        "QSX3": draws.about(0.07 * soft, 0.05),
        "QSY1": draws.about(0.009, 0.06),
        "QSY2": 0.0,
        "QSY3": draws.about(0.001, 0.2),
        "QSY4": draws.about(0.0004, 0.2),
        "SSZ1": draws.normal(0.01, 0.004),
        "SSZ2": draws.about(0.004, 0.2),
        "SSZ3": draws.normal(0.2, 0.05),
        "SSZ4": draws.normal(-0.1, 0.04),
    }


def _belt_and_spring(draws: _Draws, tires: pd.DataFrame) -> dict[str, np.ndarray]:
    """The belt's turning and mass, and the vertical spring."""
    rated = tires["rated_load"].to_numpy()
    return {
        "QTZ1": draws.about(0.2, 0.02),
        "MBELT": np.round(0.55 * tires["MASS"].to_numpy(), 3),
        "VERTICAL_STIFFNESS": np.round(draws.about(2.1e5 * (rated / 6500.0) ** 0.6, 0.02), -2),
        "VERTICAL_DAMPING": np.full(len(tires), 50.0),
        "BREFF": draws.about(8.0, 0.05),
        "DREFF": draws.about(0.25, 0.05),
        "FREFF": draws.about(0.07, 0.1),
    }


def _ranges(tires: pd.DataFrame, regime: Regime) -> dict[str, np.ndarray]:
    """The ranges that the rig measures in."""
    rated = tires["rated_load"].to_numpy()
    slip_ratio, slip_angle = round(regime.slip_ratio_range, 3), round(regime.slip_range, 4)
    camber = round(regime.camber_range, 4)
    return {
        "KPUMIN": np.full(len(tires), -slip_ratio),
        "KPUMAX": np.full(len(tires), slip_ratio),
        "ALPMIN": np.full(len(tires), -slip_angle),
        "ALPMAX": np.full(len(tires), slip_angle),
        "CAMMIN": np.full(len(tires), -camber),
        "CAMMAX": np.full(len(tires), camber),
        "FZMIN": np.round(regime.load_low * rated, -1),
        "FZMAX": np.round(regime.load_high * rated, -1),
    }
