"""One tire as six organisations measure it.

The dashed curve is the true one, which only a generated fleet has. Rig, surface and fit make each
organisation's file differ from it.

Picture: The files agree in shape, and differ most in the largest force.
"""

import numpy as np

from tire_pipeline.fleet import FleetSettings, make_fleet
from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.tir import read_tir

fleet = make_fleet(FleetSettings(seed=1, files=400, hidden_tires=2, tuning_tires=2))
measured = fleet.truth.first  # the target's own measurements too, which no method may see
names = sorted(name for name in measured if name.startswith("hidden/"))
tire = names[0].rsplit("/", 1)[1]
slip_angle = np.linspace(-0.2, 0.2, 101)

figure, axes = new_figure(width=6.5, height=3.8)
for number, name in enumerate(name for name in names if name.endswith(tire)):
    model = read_tir(measured[name].encode("cp1252"), path=name)
    fy = model.forces(slip_angle=slip_angle, normal_load=6000.0, limits="ignore").fy
    axes.plot(np.degrees(slip_angle), fy / 1e3, color=colour_of(number), label=name.split("/")[1])
curves = fleet.truth.curves["hidden"]
axes.plot(np.degrees(curves["slip_angle"]), curves["fy"][0, 1] / 1e3, "k--", label="true")
axes.set_xlabel("slip angle (deg)")
axes.set_ylabel("lateral force at 6 kN (kN)")
axes.legend(title="measured by")
