"""Effects taken out of the catalogue, on real recordings: is the driver found, and how much recovered?

The flat-belt rig's model knows neither the other pressure nor camber (:mod:`flat_belt_hidden`). Each
recording is explained twice: with the whole catalogue, and without the true effect, whose channel stays.
Judged on the loads that were left out. It needs the shared recordings:
``python benchmarks/unnamed_hidden.py [rates]``.
"""

from __future__ import annotations

import sys
import time

import pandas as pd
from flat_belt_hidden import CHANNELS, LEFT_OUT, forces, model, rms, sweeps

from tire_pipeline.mismatch import MismatchReport, explain_mismatch

TAKEN_OUT = {"pressure": "inflation_pressure", "camber": "camber"}


def recordings(rate: int, hidden: str) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return what is explained and what it is judged on."""
    table = sweeps(rate)
    rows = (table["low"].eq(False) | (hidden == "pressure")) & (
        table["leaning"].eq(False) | (hidden == "camber")
    )
    judged = table["load"].isin(LEFT_OUT)
    channels = [*CHANNELS, "tread_temperature"]
    given, left = (table[rows & part][channels].reset_index(drop=True) for part in (~judged, judged))
    return given, left


def said(report: MismatchReport) -> str:
    """The names, and what has none."""
    names = ", ".join(e.name for e in report.effects) or "-"
    found = report.unnamed
    if found is None:
        return f"{report.verdict}: {names}"
    equation = "; ".join(f"{o} += {t}" for o, t in found.physics.equations.items()) if found.physics else "-"
    first = ", ".join(f"{n} {p:.2f}" for n, p in list(found.drivers.items())[:3])
    return f"{report.verdict}: {names}; drivers {first}; {equation} {found.why_not}"


def compare(rate: int, hidden: str) -> None:
    """Explain with the whole catalogue and without the effect, and print both."""
    tire = model(rate)
    given, left = recordings(rate, hidden)
    before = rms(left["fy"] - forces(tire, left))
    for label, without in (("named", ()), ("unnamed", (TAKEN_OUT[hidden],))):
        begin = time.process_time()
        report = explain_mismatch(tire, given, without=without)
        seconds = time.process_time() - begin
        after = rms(left["fy"] - report.corrected.predict(left)["fy"])
        print(
            f"{hidden:9} {rate:4} {label:8} {before:6.1f} {after:6.1f} {seconds:5.1f} s  {said(report)}",
            flush=True,
        )


if __name__ == "__main__":
    print("hidden      Hz  catalogue before  after  processor  said")
    for each in [int(x) for x in sys.argv[1:]] or [50, 20, 10]:
        for what in TAKEN_OUT:
            compare(each, what)
