"""Draw docs/assets/readme.png: the example recording and its model, before and after.

Run: python docs/figures/make_readme_figure.py
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch import explain_recordings
from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.recordings import read_recording
from tire_pipeline.tir import read_tir

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"


def main() -> None:
    """Explain the run, predict the held-out run, draw both."""
    tire = read_tir(EXAMPLES / "tire.tir")
    runs = {name: read_recording(EXAMPLES / f"{name}.csv", axes="ISO") for name in ("rig_run", "rig_check")}
    report = explain_recordings(tire, runs, held_out="rig_check")
    figure, axes = new_figure(1, 2, width=10.0, height=3.8, sharey=True)
    names = ", ".join(effect.title for effect in report.effects)
    error = report.held_out.errors["fy"]
    fit = report.fit["fy"]
    texts = {
        "rig_run": f"explained by: {names}\nRMS {fit.rms_before:.0f} N before, {fit.rms_after:.0f} N after",
        "rig_check": f"held out\nRMS {error.rms_before:.0f} N before, {error.rms_after:.0f} N after",
    }
    for ax, (name, run) in zip(axes, runs.items(), strict=True):
        draw(ax, run, tire, report.corrected.predict(run)["fy"].to_numpy(), fit.noise_floor)
        ax.set_title(f"{name}.csv, {texts[name]}", fontsize=10)
    axes[0].set_ylabel("lateral force, recorded minus simulated (N)")
    axes[0].legend(fontsize=9, loc="lower left")
    figure.savefig(ROOT / "docs/assets/readme.png", dpi=90)


def draw(ax: Any, run: pd.DataFrame, tire: TireModel, after: np.ndarray, noise: float) -> None:
    """Draw what the model and the corrected model leave of the recorded force, over the slip angle."""
    inputs = {name: run[name].to_numpy() for name in ("slip_angle", "normal_load")}
    before = tire.forces(**inputs, limits="ignore").fy
    degrees, recorded = np.degrees(inputs["slip_angle"]), run["fy"].to_numpy()
    ax.axhspan(-noise, noise, color="#A0A0A0", alpha=0.6, lw=0, label="noise (one sigma)")
    for k, (name, simulated) in enumerate((("tire.tir", before), ("with what was found", after))):
        ax.plot(degrees, recorded - simulated, ".", ms=3, color=colour_of(1 - k), label=name)
    ax.set_xlabel("slip angle (deg)")


if __name__ == "__main__":
    main()
