"""Which coefficients move the side force, and where.

`jacobian` gives exact derivatives. Each curve is the change of the side force when a coefficient grows
by 1% of its value.

Picture: The cornering stiffness (PKY1) acts at small slip angles, peak friction (PDY1) at large ones,
with opposite signs on the two sides of zero.
"""

import numpy as np

from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
slip_angle = np.linspace(-0.2, 0.2, 201)
names = ["PKY1", "PDY1", "PCY1", "PEY1"]
slopes = tire.jacobian(names, slip_angle=slip_angle, normal_load=4000.0)["fy"]

figure, axes = new_figure(width=6.5, height=3.4)
for number, name in enumerate(names):
    change = 0.01 * tire.coefficients[name] * slopes[..., number]
    axes.plot(np.degrees(slip_angle), change, color=colour_of(number), label=name)
axes.set_xlabel("slip angle (deg)")
axes.set_ylabel("change of the side force (N)")
axes.legend()
