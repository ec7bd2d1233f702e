"""Explain where a model and a recording differ.

The model was fitted at one inflation pressure. The rig changed the pressure. The report names the
pressure, and the error falls towards the noise on sweeps that took no part in the fit.

Picture: Top: mean of recorded minus simulated side force, over slip angle and load. Bottom: the same over
time. The green bar shows when the pressure differs from that of the model; there the orange error is
large, and the blue one, after the correction, stays near the grey noise.
"""

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.recordings import read_recording
from tire_pipeline.tir import read_tir

report = explain_mismatch(read_tir("examples/tire.tir"), read_recording("examples/rig_run.csv", axes="ISO"))
print(report.verdict)
print(report.summary)

figure = report.plot()
