"""Fit a tire model to a recording.

The rig run is cut to one inflation pressure, because a 5.2 model has no coefficient of pressure.
`undetermined` lists the coefficients that the data leave open. Do not rely on them.

Picture: Left: the fit at three loads. Right: model minus measured side force. No pattern over the slip
angle is left, only noise.
"""

from tire_pipeline.magic_formula import fit_magic_formula
from tire_pipeline.recordings import read_recording

run = read_recording("examples/rig_run.csv", axes="ISO")
steady = run[run["pressure"].between(2.4e5, 2.6e5)].reset_index(drop=True)
result = fit_magic_formula(steady, starts=2)
for output, share in result.relative_rms.items():
    print(f"{output}: RMS error {share:.2%} of the largest force")
for text in result.undetermined[:3]:
    print("open:", text)

figure = result.plot()
