"""The same tire in three axis systems.

ISO W: a positive slip angle gives a negative side force. In SAE axes the y axis points to the right, so slip
angle and side force both change their sign, and the curve looks the same. In adapted SAE axes a positive slip
angle gives a positive side force.

Picture: The curves of ISO and SAE lie on each other; that of adapted SAE is their mirror image.
"""

import numpy as np

from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
slip_angle = np.linspace(-0.2, 0.2, 201)

figure, axes = new_figure(width=6.0, height=3.4)
for number, name in enumerate(("ISO", "SAE", "adapted SAE")):
    fy = tire.forces(slip_angle=slip_angle, normal_load=4000.0, axes=name).fy
    axes.plot(np.degrees(slip_angle), fy / 1e3, ("-", "--", ":")[number], color=colour_of(number), label=name)
axes.set_xlabel("slip angle in this system (deg)")
axes.set_ylabel("lateral force in this system (kN)")
axes.legend()
