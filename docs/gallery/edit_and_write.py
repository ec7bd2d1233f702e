"""Change one coefficient and write the file.

`write_tir` keeps order, comments and printed digits. Only the line that was changed differs. The source
file is not touched.

Picture: Solid: the file as it was. Dashed: with 10% more cornering stiffness, which shows at small slip
angles; the peak stays. The example file has no aligning moment.
"""

import tempfile
from pathlib import Path

from tire_pipeline.magic_formula.plots import draw_models
from tire_pipeline.tir import read_tir, write_tir

tire = read_tir("examples/tire.tir")
stiffer = tire.replace(PKY1=1.1 * tire.coefficients["PKY1"])
with tempfile.TemporaryDirectory() as folder:
    path = write_tir(stiffer, Path(folder) / "stiffer.tir")
    old = Path("examples/tire.tir").read_text("utf-8").splitlines()
    new = path.read_text("utf-8").splitlines()
for a, b in zip(old, new, strict=True):
    if a != b:
        print("before:", a)
        print("after: ", b)

figure, _ = draw_models({"tire.tir": tire, "stiffer.tir": stiffer}, loads=[4000.0])
