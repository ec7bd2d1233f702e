"""Check a recording before anything is explained.

A copy of the rig run gets two faults: a gap of two seconds, and a block without numbers.

Picture: The side force over time. At 20 s time itself is missing, just before 40 s only the numbers.
"""

import numpy as np

from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.recordings import check_recording, read_recording

run = read_recording("examples/rig_run.csv", axes="ISO")
damaged = run.drop(index=range(500, 550)).reset_index(drop=True)
damaged.loc[900:960, "fy"] = np.nan
for issue in check_recording(damaged):
    print(issue)

figure, axes = new_figure(width=7.5, height=3.0)
axes.plot(damaged["time"], damaged["fy"] / 1e3, ".", ms=2, color=colour_of(0))
axes.set_xlabel("time (s)")
axes.set_ylabel("lateral force (kN)")
