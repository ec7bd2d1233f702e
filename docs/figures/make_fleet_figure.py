"""Draw docs/figures/fleet_one_tire.svg: one tire as six manufacturers' files give it.

Run: .venv/bin/python docs/figures/make_fleet_figure.py
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np

from tire_pipeline.fleet import MANUFACTURERS, FleetSettings, make_fleet, write_fleet
from tire_pipeline.pages.drawing import colour_of, new_figure
from tire_pipeline.tir import read_tir

HERE = Path(__file__).parent
LOAD = 6000.0


def main() -> None:
    """Make a small fleet and draw its first hidden tire."""
    fleet = make_fleet(FleetSettings(files=400, hidden_tires=1, tuning_tires=1))
    tire = fleet.truth.tires.index[fleet.truth.tires["role"] == "hidden"][0]
    with tempfile.TemporaryDirectory() as folder:
        truth = write_fleet(fleet, folder)["truth"]
        models = {name: read_tir(truth / f"first/hidden/{name}/{tire}.tir") for name in MANUFACTURERS}
    angles = np.linspace(-0.25, 0.25, 201)
    loads = np.linspace(2000.0, 9000.0, 40)
    figure, axes = new_figure(1, 3, width=10.5, height=3.8)
    true = fleet.truth.curves["hidden"]["fy"][0, 1]
    axes[0].plot(np.degrees(fleet.truth.curves["hidden"]["slip_angle"]), true / 1e3, "k--", label="true")
    for k, (name, model) in enumerate(models.items()):
        style = {"color": colour_of(k), "label": name}
        at = {"limits": "ignore"}
        side = model.forces(normal_load=LOAD, slip_angle=angles, **at)
        slope = np.abs(model.forces(normal_load=loads, **at).cornering_stiffness)
        along = model.forces(normal_load=loads[:, None], slip_angle=angles, **at).fy
        axes[0].plot(np.degrees(angles), side.fy / 1e3, **style)
        axes[1].plot(loads / 1e3, slope / 1e3, **style)
        axes[2].plot(loads / 1e3, np.abs(along).max(axis=1) / loads, **style)
    axes[0].set(xlabel="slip angle (deg)", ylabel="lateral force (kN)", title="6 kN")
    axes[1].set(xlabel="normal load (kN)", ylabel="cornering stiffness (kN/rad)")
    axes[2].set(xlabel="normal load (kN)", ylabel="peak friction")
    axes[0].legend(fontsize=8)
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "fleet_one_tire.svg"
    figure.savefig(target, metadata={"Date": None} if target.suffix == ".svg" else None)


if __name__ == "__main__":
    main()
