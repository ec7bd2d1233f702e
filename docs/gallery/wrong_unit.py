"""A channel in another unit.

The force of the rig run is converted to pounds-force, but still labelled as newtons. The unit is found from
its exact factor and repaired before any physics is looked for.

Picture: Recorded and predicted forces lie on each other, in pounds-force: the prediction returns what the
rig would record.
"""

import numpy as np

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.recordings import read_recording
from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
run = read_recording("examples/rig_run.csv", axes="ISO")
wrong = run.assign(fy=run["fy"] / 4.4482216)
report = explain_mismatch(tire, wrong)
print(report.verdict)
for effect in report.effects:
    print(f"{effect.kind}: {effect.title}")

figure, axes = new_figure(width=6.0, height=3.4)
for number, (name, fy) in enumerate(
    (("as recorded", wrong["fy"]), ("predicted", report.corrected.predict(wrong)["fy"]))
):
    axes.plot(np.degrees(wrong["slip_angle"]), fy, ".", ms=2, color=colour_of(number), label=name)
axes.set_xlabel("slip angle (deg)")
axes.set_ylabel("lateral force (lbf)")
axes.legend()
