"""What a fitted Magic Formula leaves of this simulator's tires; run with `python -m`, writes misfit.json."""

import json
from pathlib import Path

import numpy as np
import pandas as pd

from tire_pipeline.concealed.second import schedule
from tire_pipeline.concealed.second.rig import draw_rig, driven, filtered
from tire_pipeline.concealed.second.roll import FORCES
from tire_pipeline.concealed.second.run import Run
from tire_pipeline.concealed.second.tire import draw_tire
from tire_pipeline.magic_formula import fit_magic_formula

TIRES = 6
SEED = 27
THIN = 5


def _of_one(rng: np.random.Generator) -> np.ndarray:
    """RMS of the residual over RMS of the force, without noise, (3,)."""
    tire, rig = draw_tire(rng), draw_rig(rng)
    tables = []
    for sections in schedule.reference_sections(tire):
        run = Run(tire, rig, driven(schedule.played(sections, tire), rig, tire, rng), 0.0)
        columns = {"normal_load": 0, "slip_angle": 0, "slip_ratio": 0, "camber": 0, "speed": 0}
        table = pd.DataFrame({name: filtered(getattr(run.course, name), rig) for name in columns})
        for name, force in zip(FORCES, run.forces(), strict=True):
            table[name] = force
        tables.append(table.iloc[::THIN])
    points = pd.concat(tables, ignore_index=True)
    fitted = fit_magic_formula(
        points, nominal_load=tire.nominal_load, unloaded_radius=tire.radius, starts=4, loss="linear"
    )
    found = fitted.forces(**{name: points[name].to_numpy() for name in columns})
    left = [np.sqrt(np.mean((getattr(found, name) - points[name]) ** 2)) for name in FORCES]
    return np.array(left) / np.sqrt(np.mean(points[list(FORCES)].to_numpy() ** 2, axis=0))


def main() -> None:
    """Fit a few tires and write the median of what is left."""
    rng = np.random.default_rng(SEED)
    left = np.array([_of_one(rng) for _ in range(TIRES)])
    result = {
        "relative_misfit": [round(float(value), 4) for value in np.median(left, axis=0)],
        "of": list(FORCES),
        "tires": TIRES,
        "seed": SEED,
        "range": [[round(float(value), 4) for value in row] for row in (left.min(0), left.max(0))],
    }
    path = Path(__file__).with_name("misfit.json")
    path.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    print(path.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
