"""Translate one file, with its band.

A translator learns from the fleet's files. It then predicts what D would have measured of a tire that A
measured. The 90% band shows how certain the prediction is.

Picture: Left: side force of the file as A measured it and as translated. Right: the difference from the
translated one. The shaded band holds D's own measurement with 90% probability; at large slip angles A's
file lies outside of it.
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
fy = source.forces(slip_angle=band.slip, normal_load=at, limits="ignore").fy / 1e3
low, middle, high = (each[0, load] / 1e3 for each in (band.low, band.middle, band.high))
degrees = np.degrees(band.slip)
figure, (left, right) = new_figure(1, 2, width=8.5, height=3.6)
left.plot(degrees, middle, color=colour_of(0), label="translated to D")
left.plot(degrees, fy, color=colour_of(1), label="as A measured it")
left.set_ylabel(f"lateral force at {at / 1e3:g} kN (kN)")
left.legend()
right.fill_between(degrees, low - middle, high - middle, alpha=0.3, label="90% band")
right.plot(degrees, fy - middle, color=colour_of(1), label="as A measured it")
right.set_ylabel("minus the translated force (kN)")
right.legend()
for axes in (left, right):
    axes.set_xlabel("slip angle (deg)")
