"""The same tire with another nominal load.

Coefficients depend on the nominal load they were fitted with. `nominal_load_changed` rewrites them so
that the forces stay the same; only then can the coefficients of two files be compared. In the picture
the dots lie on the line. If only the number `FNOMIN` is replaced, the file describes another tire.

Picture: The dots lie on the line: the rewritten tire has the same forces. The dashed line is the tire of
which only `FNOMIN` was replaced.
"""

import numpy as np

from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
other = tire.nominal_load_changed(6000.0)
for name in ("FNOMIN", "PDY1", "PDY2", "PKY1", "PKY2"):
    print(f"{name:8s}{tire.coefficients[name]:12.4f}{other.coefficients[name]:12.4f}")

loads = np.linspace(1600.0, 8400.0, 61)
only_the_number = tire.replace(FNOMIN=6000.0)
figure, axes = new_figure(width=6.0, height=3.4)
for number, (label, model, line) in enumerate(
    (("as it is", tire, "-"), ("rewritten", other, "o"), ("FNOMIN alone replaced", only_the_number, "--"))
):
    fy = np.abs(model.forces(slip_angle=0.06, normal_load=loads).fy) / 1e3
    axes.plot(loads / 1e3, fy, line, markevery=5, color=colour_of(number), label=label)
axes.set_xlabel("normal load (kN)")
axes.set_ylabel("side force at 3.4 degrees (kN)")
axes.legend()
