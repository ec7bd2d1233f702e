"""When the recording cannot tell.

A constant force is added to the run, and only the samples at one load are kept. At one load an offset of
the force channel, conicity and an offset of the slip angle look alike. The report names one and lists
the others as alternatives.

Picture: Top: recorded minus simulated side force of each point, over slip angle and load. Bottom: the
same over time. Before the correction all points are off by the same force; after it they scatter within
the noise.
"""

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.recordings import read_recording
from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
run = read_recording("examples/rig_run.csv", axes="ISO")
kept = run["pressure"].between(2.4e5, 2.6e5) & run["normal_load"].between(4800.0, 5600.0)
one_load = run[kept].reset_index(drop=True).drop(columns="pressure")
report = explain_mismatch(tire, one_load.assign(fy=one_load["fy"] + 400.0))
print(report.verdict)
for effect in report.effects:
    print(f"{effect.title}, or: {', '.join(effect.alternatives) or 'nothing else'}")
print("next:", report.next_experiment)

figure = report.plot()
