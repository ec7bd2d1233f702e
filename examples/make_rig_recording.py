"""Make the rig recording of README, tutorials and gallery, and the tire file that belongs to it.

Run: python examples/make_rig_recording.py

A simulated rig (``tire_pipeline.concealed``: a bristle brush tire, not a Magic Formula) sweeps the slip angle
of one tire. ``tire.tir`` is fitted to a run at one inflation pressure and one camber. Then two runs are
recorded at other pressures too: ``rig_run.csv`` to explain, ``rig_check.csv`` to hold out. So the tire file
lacks what the inflation pressure does, and nothing else of note.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd

from tire_pipeline.concealed.brush_rig.constants import draw_constants
from tire_pipeline.concealed.brush_rig.recorded_run import BrushRig, add_noise, draw_noise
from tire_pipeline.concealed.brush_rig.schedule import CHANNELS, CasePlan
from tire_pipeline.concealed.cases.clean_run import fit_clean
from tire_pipeline.tir import write_tir
from tire_pipeline.tir.format.values import COMPUTED_DIGITS

HERE = Path(__file__).resolve().parent
SEED = 7
RATE = 25.0
"""Samples a second."""
RUN = {"pressures": (1.0, 0.8, 1.2), "loads": (0.5, 1.0, 1.5)}
CHECK = {"pressures": (1.1, 0.9), "loads": (0.75, 1.25)}
"""As shares of the nominal pressure and load; the check run has levels that the first one never has."""
ISO = -1.0
"""Sign of the slip angle: the simulator counts it the other way round."""
ODD_IN_CAMBER = ("PEY4", "PHY3", "PVY3", "PVY4")
"""Coefficients that change their sign with that of camber, which the simulator counts the other way, too."""
UNITS = {"time": "s", "slip_angle": "deg", "normal_load": "N", "pressure": "kPa", "speed": "km/h", "fy": "N"}
TITLES = {"time": "ET", "slip_angle": "SA", "normal_load": "FZ", "pressure": "P", "speed": "V", "fy": "FY"}


def sweeps(plan: CasePlan, pressures: tuple[float, ...], loads: tuple[float, ...]) -> pd.DataFrame:
    """One sweep of the slip angle to both sides at each pressure and load."""
    period = 4.0 * plan.amplitude / plan.rate
    phase = np.arange(round(period * RATE)) / RATE / period
    parts = []
    for pressure in pressures:
        for load in loads:
            part = pd.DataFrame(0.0, index=range(phase.size), columns=list(CHANNELS))
            part["slip_angle"] = plan.amplitude * np.sin(2.0 * np.pi * phase)
            part["normal_load"] = load * plan.nominal_load
            part["pressure"], part["speed"] = pressure * plan.pressure, plan.speed
            parts.append(part)
    table = pd.concat(parts, ignore_index=True)
    table.insert(0, "time", np.arange(len(table)) / RATE)
    return table


def write_rig_file(frame: pd.DataFrame, path: Path) -> None:
    """Write the run as a rig does: its own channel names, and their units in a second line."""
    out = pd.DataFrame({TITLES[name]: frame[name] for name in TITLES})
    out["SA"], out["P"], out["V"] = np.degrees(out["SA"]), out["P"] / 1e3, out["V"] * 3.6
    digits = {"ET": "%.2f", "SA": "%.3f", "FZ": "%.1f", "P": "%.2f", "V": "%.2f", "FY": "%.1f"}
    lines = [",".join(TITLES.values()), ",".join(UNITS.values())]
    lines += [",".join(digits[name] % value for name, value in row.items()) for row in out.to_dict("records")]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def main(folder: Path = HERE) -> None:
    """Draw the tire, fit the file, record both runs."""
    rng = np.random.default_rng(SEED)
    constants = draw_constants(rng)
    plan = CasePlan(
        blocks=(),
        single_speed=True,
        single_load=False,
        loads=tuple(share * constants.nominal_load for share in RUN["loads"]),
        held_out_load=constants.nominal_load,
        cambers=(0.05,),
        pressures=(),
        speeds=(),
        speed=constants.nominal_speed,
        pressure=constants.nominal_pressure,
        nominal_load=constants.nominal_load,
        amplitude=0.2,
        rate=0.12,
        shape="sine",
        sweeps=1,
    )
    rig = BrushRig(constants, rng.random(4), ISO, {}, {"fx": 0.0, "fy": 0.0}, 24)
    largest = float(rig.run(sweeps(plan, (1.0,), RUN["loads"]), {})["fy"].abs().max())
    tire, _ = fit_clean(rig, plan, noise=0.002 * largest, rng=rng)
    tire = tire.replace(**{name: -tire.coefficients[name] for name in ODD_IN_CAMBER})
    write_tir(tire, folder / "tire.tir", overwrite=True, digits=COMPUTED_DIGITS)
    noise = draw_noise(rng, constants, largest)
    for name, levels in (("rig_run", RUN), ("rig_check", CHECK)):
        frame = rig.run(sweeps(plan, levels["pressures"], levels["loads"]), {"inflation_pressure": 1.0})
        write_rig_file(add_noise(frame.drop(columns="wear"), noise, rng), folder / f"{name}.csv")


if __name__ == "__main__":
    main()
