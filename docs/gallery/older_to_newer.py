"""A 5.2 tire as version 6.1.

`to_version` keeps the forces: the dots lie on the line. `conversion_notes` says what other
software will see differently.

Picture: The dots of version 6.1 lie on the line of version 5.2.
"""

import numpy as np

from tire_pipeline.magic_formula import conversion_notes
from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
newer = tire.to_version("6.1")
for note in conversion_notes(tire, "6.1"):
    print("-", note)

slip_angle = np.linspace(-0.2, 0.2, 101)
figure, axes = new_figure(width=6.0, height=3.4)
for number, (model, line) in enumerate(((tire, "-"), (newer, "o"))):
    fy = model.forces(slip_angle=slip_angle, normal_load=4000.0).fy
    axes.plot(
        np.degrees(slip_angle), fy / 1e3, line, markevery=5, color=colour_of(number), label=model.version
    )
axes.set_xlabel("slip angle (deg)")
axes.set_ylabel("lateral force (kN)")
axes.legend(title="version")
