"""What fits to few points are drawn to: how much tires differ, and what drawing does to the fit.

Run: python benchmarks/few_points.py [--tires 60] [--points 18 39]

The spreads are those of `fitting/setup/typical.py` and of the public files in ../shared/tir. The fits are to
brush tires of the rig simulator at some points of pure lateral slip, with and without being drawn; the error
is that of the whole range beside the points, over the largest force.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pandas as pd
from real_recordings import error

from tire_pipeline.concealed.brush_rig.constants import draw_constants
from tire_pipeline.concealed.brush_rig.recorded_run import BrushRig
from tire_pipeline.concealed.brush_rig.schedule import CHANNELS
from tire_pipeline.errors import TirePipelineError
from tire_pipeline.magic_formula.fitting import fit_magic_formula, output_fit, stage_fit
from tire_pipeline.magic_formula.fitting.setup.typical import SPREAD
from tire_pipeline.tir import read_tir

FILES = Path(__file__).resolve().parents[2] / "shared" / "tir"
NOISE = 0.005
"""Of the forces, over the largest one."""
LOADS = np.array([0.5, 1.0, 1.5])
ANGLES = np.radians(np.linspace(-12.0, 12.0, 13))
SETTINGS = {"drawn": stage_fit.most_typical, "not drawn": lambda problem, bounds, best, *_: best}
"""How the values are chosen among those that leave nearly as little."""


def spreads() -> pd.DataFrame:
    """Return half of the range of the middle four fifths, and the standard deviation, by coefficient."""
    values: dict[str, list[float]] = {name: [] for name in SPREAD}
    for path in sorted(FILES.glob("*.tir")):
        try:
            coefficients = read_tir(path).coefficients
        except TirePipelineError as error:
            print(f"left out: {error}")
            continue
        for name, some in values.items():
            if name in coefficients:
                some.append(abs(coefficients[name]) if name == "PKY1" else coefficients[name])
    rows = {
        name: {
            "files": len(some),
            "half range": 0.5 * float(np.subtract(*np.quantile(some, [0.9, 0.1]))),
            "deviation": float(np.std(some)),
            "in use": SPREAD[name],
        }
        for name, some in values.items()
    }
    return pd.DataFrame(rows).T


def forces(rig: BrushRig, slip_angle: np.ndarray, normal_load: np.ndarray) -> pd.DataFrame:
    """Return steady points of pure lateral slip of a brush tire."""
    frame = pd.DataFrame(0.0, index=range(slip_angle.size), columns=["time", *CHANNELS])
    frame["time"] = np.arange(slip_angle.size) * 0.02
    frame["slip_angle"], frame["normal_load"] = slip_angle, normal_load
    frame["speed"], frame["pressure"] = rig.constants.nominal_speed, rig.constants.nominal_pressure
    return rig.run(frame, {})[["slip_angle", "normal_load", "fy"]]


def errors(seed: int, points: int) -> dict[str, float]:
    """Fit one tire at some of the points, and return the error elsewhere by setting."""
    rng = np.random.default_rng([seed, points])
    constants = draw_constants(rng)
    rig = BrushRig(constants, np.zeros(0), 1.0, {}, {}, 24)
    load, angle = (a.ravel() for a in np.meshgrid(LOADS * constants.nominal_load, ANGLES))
    few = rng.choice(load.size, size=min(points, load.size), replace=False)
    many = np.meshgrid(
        constants.nominal_load * np.linspace(0.5, 1.5, 7), np.linspace(ANGLES[0], ANGLES[-1], 49)
    )
    truth = forces(rig, many[1].ravel(), many[0].ravel())
    largest = float(truth["fy"].abs().max())
    seen = forces(rig, angle[few], load[few])
    seen["fy"] += NOISE * largest * rng.standard_normal(len(seen))
    out = {}
    for name, instead in SETTINGS.items():
        with (
            patch.object(stage_fit, "most_typical", instead),
            patch.object(output_fit, "most_typical", instead),
        ):
            model = fit_magic_formula(seen, nominal_load=constants.nominal_load).model
        out[name] = error(model, truth) / largest
    return out


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tires", type=int, default=60)
    parser.add_argument("--points", type=int, nargs="+", default=[18, 39])
    asked = parser.parse_args()
    if FILES.is_dir():
        print(spreads().round(4).to_string())
    for points in asked.points:
        table = pd.DataFrame([errors(seed, points) for seed in range(asked.tires)])
        print(f"\n{asked.tires} brush tires, {points} points: error elsewhere, % of the largest force")
        print((100.0 * table.agg(["mean", "median", "max"])).round(2).to_string())


if __name__ == "__main__":
    main()
