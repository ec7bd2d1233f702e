"""Translate one file, with its band.

A translator learns from the fleet's files. It then predicts what D would have measured of a tire that A
measured. The 90% band shows how certain the prediction is.
"""

import numpy as np
import pandas as pd

from tire_pipeline.fleet import FleetSettings, make_fleet
from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.representations import make_representation
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table import dedupe_and_filter, from_models, normalize_table
from tire_pipeline.translation import make_translator


def as_table(files: dict[str, str]) -> pd.DataFrame:
    models = ((n, n.split("/")[-2], read_tir(t.encode("cp1252"), path=n)) for n, t in files.items())
    return normalize_table(from_models(models), 6000.0)


fleet = make_fleet(FleetSettings(seed=1, files=400, hidden_tires=4, tuning_tires=4))
needed = make_representation("coefficients").feature_names
training, _ = dedupe_and_filter(as_table(fleet.files), features=needed)
translator = make_translator("mixed_model").fit(training, target="D", seed=1)

name = next(name for name in sorted(fleet.evaluation) if name.startswith("hidden/A/"))
result = translator.translation(as_table({name: fleet.evaluation[name]}))
print(result.report.iloc[0]["verdict"])

band = result.bands["fy"]
load = len(band.normal_load) // 2
at = float(band.normal_load[load])
source = read_tir(fleet.evaluation[name].encode("cp1252"), path=name)
figure, axes = new_figure(width=6.5, height=3.8)
degrees = np.degrees(band.slip)
axes.fill_between(degrees, band.low[0, load] / 1e3, band.high[0, load] / 1e3, alpha=0.3, label="90% band")
axes.plot(degrees, band.middle[0, load] / 1e3, color=colour_of(0), label="translated to D")
fy = source.forces(slip_angle=band.slip, normal_load=at, limits="ignore").fy
axes.plot(degrees, fy / 1e3, color=colour_of(1), label="as A measured it")
axes.set_xlabel("slip angle (deg)")
axes.set_ylabel(f"lateral force at {at / 1e3:g} kN (kN)")
axes.legend()
