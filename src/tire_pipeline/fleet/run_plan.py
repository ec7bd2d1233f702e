"""Run every measurement of a plan through its regime and its fit."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.fleet.manufacturer_fits.fit_sweeps import FitTask, fit_all
from tire_pipeline.fleet.manufacturer_fits.habits import habit_of
from tire_pipeline.fleet.plan import Plan
from tire_pipeline.fleet.rig.regimes import Regime, regime_of
from tire_pipeline.fleet.rig.sweeps import draw_sessions, measure_lateral, measure_longitudinal
from tire_pipeline.fleet.settings import FleetSettings
from tire_pipeline.fleet.tire_population import thermal_parameters
from tire_pipeline.progress import track

INTERACTION = {"additive": 0.0, "interacting": 0.75, "drifting": 0.0}


def regimes_of(plan: Plan, settings: FleetSettings) -> dict[str, Regime]:
    """Regimes in force, by ``category/protocol``.

    Parameters
    ----------
    plan : Plan
    settings : FleetSettings

    Returns
    -------
    dict of str to Regime
    """
    names = plan.measurements["regime"].drop_duplicates()
    split = {name: name.split("/") for name in names}
    return {name: regime_of(own[0], own[1], settings.bias_size) for name, own in split.items()}


def measure_all(plan: Plan, settings: FleetSettings, rng: np.random.Generator) -> pd.DataFrame:
    """Measure and fit everything that the plan names.

    Parameters
    ----------
    plan : Plan
    settings : FleetSettings
    rng : numpy.random.Generator

    Returns
    -------
    pandas.DataFrame
        Coefficients and ``FNOMIN``, one row a measurement of the plan, in its order.
    """
    tires = thermal_parameters(plan.tires, INTERACTION[settings.kind])
    freeze = pd.Series(rng.random(len(tires)), index=tires.index)
    tasks, indices = [], []
    regimes = regimes_of(plan, settings)
    for key, regime in track(regimes.items(), "measuring the fleet", total=len(regimes)):
        rows = plan.measurements[plan.measurements["regime"] == key]
        for _, batch in rows.groupby(np.arange(len(rows)) // 400):
            tasks.append(_task(batch, plan, tires, freeze, regime, rng))
            indices.append(batch.index)
    tables = fit_all(tasks, settings.threads)
    parts = [table.set_index(index) for table, index in zip(tables, indices, strict=True)]
    return pd.concat(parts).sort_index()


def _task(
    batch: pd.DataFrame,
    plan: Plan,
    tires: pd.DataFrame,
    freeze: pd.Series,
    regime: Regime,
    rng: np.random.Generator,
) -> FitTask:
    """Measure a batch; a re-fit takes the raw data of its first measurement."""
    first = np.where(batch["same_data"] >= 0, batch["same_data"], batch.index)
    raw = plan.measurements.loc[np.unique(first)]
    own = tires.loc[raw["tire"]]
    session = draw_sessions(len(raw), rng)
    back = np.searchsorted(raw.index.to_numpy(), first)
    tested = tires.loc[batch["tire"]]
    return FitTask(
        lateral=measure_lateral(own, raw, regime, session, rng).of_tires(back),
        longitudinal=measure_longitudinal(own, raw, regime, session, rng).of_tires(back),
        rated_load=tested["rated_load"].to_numpy(),
        radius=tested["UNLOADED_RADIUS"].to_numpy(),
        habit=habit_of(str(batch["category"].iloc[0])),
        freeze_draw=freeze.loc[batch["tire"]].to_numpy(),
        weight_twist=batch["weight_twist"].to_numpy(),
    )
