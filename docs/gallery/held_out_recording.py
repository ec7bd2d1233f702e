"""Test an explanation on a second recording.

`rig_check.csv` takes no part. The explained model predicts it, at pressures and loads that do not occur
in the first run.

Picture: After the correction, the error of a run that took no part is about as large as the noise.
"""

from tire_pipeline.mismatch import explain_recordings
from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.recordings import read_recording
from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
runs = {name: read_recording(f"examples/{name}.csv", axes="ISO") for name in ("rig_run", "rig_check")}
report = explain_recordings(tire, runs, held_out="rig_check")
error = report.held_out.errors["fy"]
print(f"RMS error of the held-out run: {error.rms_before:.0f} N before, {error.rms_after:.0f} N after")
print(f"ratio, 95% interval: {error.ratio_low:.2f} to {error.ratio_high:.2f}")

noise = report.fit["fy"].noise_floor
figure, axes = new_figure(width=5.0, height=3.2)
axes.bar(["before", "after", "noise"], [error.rms_before, error.rms_after, noise], color=colour_of(0))
axes.set_ylabel("RMS error of the side force (N)")
