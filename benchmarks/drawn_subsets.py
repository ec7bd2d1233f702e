"""Subsets of real and simulated sweeps, drawn by number: what ``fit_subsets.py`` fits.

Sweeps of the flat belt (calspan, by load or at random, thinned by 1 to 20), points of the TYDEX file, a brush
tire of the rig simulator that brakes, drives and corners, and points that other software has computed for
public tire files (with noise), for the stages that the two real recordings lack.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd

from tire_pipeline.concealed.brush_rig.constants import draw_constants
from tire_pipeline.concealed.brush_rig.recorded_run import BrushRig
from tire_pipeline.concealed.brush_rig.schedule import CHANNELS
from tire_pipeline.recordings import read_recording

SHARED = Path(__file__).resolve().parents[2] / "shared"
SOURCES = (*["calspan"] * 3, "rig", "tydex", *["calspan"] * 3, "file", "tydex")
"""What the subsets are of, in turn."""
NOISE = 0.01
"""Of computed forces, over the largest."""
LEVELS = np.array([800.0, 1350.0, 1900.0, 2450.0])
"""Between the five loads of the flat belt, N."""


@dataclass(frozen=True)
class Subset:
    """Rows to fit, rows at loads left out (maybe none), and what they are."""

    seed: int
    source: str
    what: str
    rows: pd.DataFrame = field(repr=False)
    left_out: pd.DataFrame = field(repr=False)
    one_load: bool = False


@cache
def calspan() -> pd.DataFrame:
    """All sweeps of the flat belt, with ``sweep``, ``level`` of load, ``low`` pressure, ``leaning``."""
    path = SHARED / "recordings" / "calspan" / "cornering_part.mat"
    table = read_recording(path, axes="ISO")
    names = ["time", "slip_angle", "camber", "normal_load", "speed", "pressure", "fy", "mz"]
    table = table[names].assign(sweep=np.r_[0, np.cumsum(np.diff(table["time"]) > 0.5)])
    middle = table.groupby("sweep")[["normal_load", "pressure", "camber"]].transform("median")
    return table.assign(
        level=np.searchsorted(LEVELS, middle["normal_load"]),
        low=middle["pressure"] < 76_000.0,
        leaning=np.degrees(middle["camber"]) > 0.8,
    )


def of_calspan(seed: int) -> Subset:
    """Some of five loads at some of four settings, or sweeps at random; thinned by 1 to 20."""
    rng = np.random.default_rng([20_241, seed])
    table, step = calspan(), int(rng.integers(1, 21))
    if rng.random() < 0.3:
        number = int(rng.integers(1, 12))
        chosen = np.isin(table["sweep"], rng.choice(table["sweep"].max() + 1, number, replace=False))
        what, other = f"{number} sweeps", np.zeros(len(table), dtype=bool)
        one = table["level"][chosen].nunique() == 1
    else:
        settings = [[(False, False)], [(True, False)], [(False, False), (True, False)]]
        settings += [[(False, False), (False, True)], [(a, b) for a in (False, True) for b in (False, True)]]
        setting = settings[int(rng.integers(len(settings)))]
        where = np.array([pair in setting for pair in zip(table["low"], table["leaning"], strict=True)])
        number = int(rng.integers(1, 6))
        levels = np.sort(rng.choice(5, number, replace=False))
        chosen = where & np.isin(table["level"], levels)
        other, one = where & ~chosen, number == 1
        what = f"loads {''.join(str(n + 1) for n in levels)} of 5 at {len(setting)} settings"
    start = int(rng.integers(step))
    rows = table[chosen].iloc[start::step]
    return Subset(seed, "calspan", f"{what}, every {step}", rows, table[other].iloc[::5], one)


@cache
def tydex() -> pd.DataFrame:
    """The points of the TYDEX file, with the ``level`` of load in fifths."""
    table = read_recording(SHARED / "recordings" / "tydex" / "DT_195_65R15_demo.tdx")
    return table.assign(level=np.searchsorted([2100.0, 3950.0, 5700.0, 7600.0], table["normal_load"]))


def of_tydex(seed: int) -> Subset:
    """Three to five of five loads, all cambers or none; all points, or one in two or three."""
    rng = np.random.default_rng([20_242, seed])
    table = tydex()
    if rng.random() < 0.3:
        table = table[np.degrees(table["camber"].abs()) < 0.3]
    levels = np.sort(rng.choice(5, int(rng.integers(3, 6)), replace=False))
    step = int(rng.integers(1, 4)) if len(table) > 50 else 1
    chosen = np.isin(table["level"], levels)
    what = f"loads {''.join(str(n + 1) for n in levels)} of 5, {len(table)} points, every {step}"
    return Subset(seed, "tydex", what, table[chosen].iloc[::step], table[~chosen])


def of_rig(seed: int) -> Subset:
    """A brush tire that brakes, drives and corners at some of five loads."""
    rng = np.random.default_rng([20_243, seed])
    constants = draw_constants(rng)
    rig = BrushRig(constants, np.zeros(0), 1.0, {}, {}, 24)
    loads = constants.nominal_load * np.linspace(0.3, 1.65, 5)
    ratio, angle = np.linspace(-0.25, 0.25, 61), np.linspace(-0.2, 0.2, 61)
    sides, camber = (0.0, -0.1, -0.05, 0.03, 0.06), 0.06
    points = [(a, k, 0.0, load) for load in loads for a in sides for k in ratio]
    points += [(a, 0.0, g, load) for load in loads for g in (-camber, 0.0, camber) for a in angle]
    frame = pd.DataFrame(points, columns=["slip_angle", "slip_ratio", "camber", "normal_load"])
    frame["speed"], frame["pressure"] = constants.nominal_speed, constants.nominal_pressure
    frame["turn_slip"], frame["time"] = 0.0, np.arange(len(frame)) * 0.02
    table = rig.run(frame[["time", *CHANNELS]], {})
    for force in ("fx", "fy"):
        table[force] += 0.005 * table[force].abs().max() * rng.standard_normal(len(table))
    number, step = int(rng.integers(2, 6)), int(rng.integers(1, 4))
    levels = np.sort(rng.choice(5, number, replace=False))
    chosen = np.isin(table["normal_load"], loads[levels])
    columns = ["slip_angle", "slip_ratio", "camber", "normal_load", "fx", "fy"]
    what = f"loads {''.join(str(n + 1) for n in levels)} of 5, every {step}"
    return Subset(seed, "rig", what, table[chosen][columns].iloc[::step], table[~chosen][columns])


def of_file(seed: int) -> Subset:
    """Points of pure and combined slip that other software has computed for a public file, with noise."""
    rng = np.random.default_rng([20_244, seed])
    files = sorted((SHARED / "reference_forces").glob("*.csv"))
    path = files[seed % len(files)]
    table = pd.read_csv(path).rename(columns=FILE_COLUMNS)[list(FILE_COLUMNS.values())]
    table = table[(table["set"] != "rand") & (table["normal_load"] > 0.0)].drop(columns="set")
    for output in ("fx", "fy", "mz"):
        table[output] += NOISE * table[output].abs().max() * rng.standard_normal(len(table))
    rows = table.sample(frac=float(rng.uniform(0.4, 1.0)), random_state=rng)
    return Subset(seed, "file", f"{path.stem}, {len(rows)} points", rows, table.iloc[:0])


FILE_COLUMNS = {
    "set": "set",
    "Fz_N": "normal_load",
    "kappa": "slip_ratio",
    "alpha_rad": "slip_angle",
    "gamma_rad": "camber",
    "Vx_mps": "speed",
    "p_Pa": "pressure",
    "Fx_N": "fx",
    "Fy_N": "fy",
    "Mz_Nm": "mz",
}
MAKERS = {"calspan": of_calspan, "tydex": of_tydex, "rig": of_rig, "file": of_file}


def subset(number: int) -> Subset:
    """Return a subset by its number."""
    return MAKERS[SOURCES[number % len(SOURCES)]](number)
