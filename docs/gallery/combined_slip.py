"""Braking and cornering at once.

Each curve has one slip angle; the slip ratio goes from free rolling to strong braking. The more force the
tire uses for braking, the less is left for cornering.

Picture: Each curve begins at free rolling on the right. The side force falls as braking grows to the
left.
"""

import numpy as np

from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
slip_ratio = np.linspace(0.0, -0.2, 81)

figure, axes = new_figure(width=5.5, height=4.2)
for number, degrees in enumerate((2, 4, 8)):
    forces = tire.forces(slip_angle=np.radians(degrees), slip_ratio=slip_ratio, normal_load=4000.0)
    axes.plot(forces.fx / 1e3, forces.fy / 1e3, color=colour_of(number), label=f"{degrees} degrees")
axes.set_xlabel("longitudinal force (kN)")
axes.set_ylabel("lateral force (kN)")
axes.legend(title="slip angle")
