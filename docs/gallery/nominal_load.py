"""The same tire with another nominal load.

Coefficients depend on the nominal load they were fitted with. `nominal_load_changed` rewrites them so
that the forces stay the same; only then can the coefficients of two files be compared.
"""

import numpy as np

from tire_pipeline.pages.drawing import new_figure
from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
other = tire.nominal_load_changed(6000.0)
for name in ("FNOMIN", "PDY1", "PDY2", "PKY1", "PKY2"):
    print(f"{name:8s}{tire.coefficients[name]:12.4f}{other.coefficients[name]:12.4f}")

loads = np.linspace(1600.0, 8400.0, 60)
before, after = (model.forces(slip_angle=0.06, normal_load=loads).fy for model in (tire, other))
figure, axes = new_figure(width=6.0, height=3.2)
axes.plot(loads / 1e3, np.abs(after - before))
axes.set_xlabel("normal load / kN")
axes.set_ylabel("difference of the side force / N")
axes.set_title(f"largest force here: {np.abs(before).max():.0f} N")
