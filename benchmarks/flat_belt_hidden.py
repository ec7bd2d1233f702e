"""Physics hidden from a model of the flat-belt rig's tire: is it named, and does the correction hold?

The model is fitted to 82 kPa and no camber. It then meets recordings of the other pressure, the other camber,
or both, at three of five loads. The other two loads judge the correction, beside a formula that is refitted
to the rows that were explained. It needs the shared recordings:
``python benchmarks/flat_belt_hidden.py [rates]``, which writes ``benchmarks/results/flat_belt_hidden.csv``;
``--write`` puts the stored table into docs/explanation/concealed_results.md.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
from doc_tables import markdown, write_between

from tire_pipeline.code_hash import code_hash
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.recordings import read_recording

FILE = Path(__file__).parents[2] / "shared/recordings/calspan/cornering_part.mat"
CHANNELS = ["time", "slip_angle", "camber", "normal_load", "speed", "pressure", "fy"]
RESULTS = Path(__file__).parent / "results" / "flat_belt_hidden.csv"
PAGE = Path(__file__).parent.parent / "docs" / "explanation" / "concealed_results.md"
BEGIN = "<!-- from flat_belt_hidden.py -->"
HIDDEN = ("nothing", "pressure", "camber", "camber and pressure")
LOADS = (800.0, 1350.0, 1900.0, 2450.0)
"""Between the five levels, N."""
LEFT_OUT = (2, 4)


@dataclass(frozen=True)
class Row:
    """One recording: what was named, and the RMS error at the loads left out, N."""

    hidden: str
    rate: int
    temperature: bool
    verdict: str
    names: tuple[str, ...]
    before: float
    after: float
    seconds: float
    given: pd.DataFrame
    left: pd.DataFrame

    @property
    def refitted(self) -> float:
        """RMS error at the loads left out of a formula that is fitted to the rows that were explained, N."""
        tire = fit_magic_formula(self.given[["slip_angle", "camber", "normal_load", "fy"]]).model
        return rms(self.left["fy"] - forces(tire, self.left))


@cache
def sweeps(rate: int) -> pd.DataFrame:
    """Return all sweeps at a rate (Hz), neighbours averaged, with ``load``, ``low``, ``leaning``."""
    whole = read_recording(FILE, axes="SAE")[[*CHANNELS, "tread_temperature"]]
    run = np.r_[0, np.cumsum(np.diff(whole["time"]) > 0.5)]
    count = 100 // rate
    parts = []
    for _, part in whole.groupby(run):
        rows = len(part) // count * count
        mean = part.iloc[:rows].to_numpy().reshape(-1, count, part.shape[1]).mean(axis=1)
        table = pd.DataFrame(mean, columns=part.columns)
        load = float(np.searchsorted(LOADS, table["normal_load"].median()))
        parts.append(
            table.assign(
                load=load,
                low=table["pressure"].median() < 76_000.0,
                leaning=np.degrees(table["camber"].median()) > 0.8,
            )
        )
    return pd.concat(parts, ignore_index=True)


@cache
def model(rate: int) -> TireModel:
    """Fit the model to 82 kPa and no camber, all loads."""
    table = sweeps(rate)
    return fit_magic_formula(
        table[~table["low"] & ~table["leaning"]][["slip_angle", "normal_load", "fy"]]
    ).model


def judge(hidden: str, rate: int, temperature: bool) -> Row:
    """Explain one recording and judge it at the loads left out."""
    table, tire = sweeps(rate), model(rate)
    rows = (table["low"].eq(False) | ("pressure" in hidden)) & (
        table["leaning"].eq(False) | ("camber" in hidden)
    )
    channels = CHANNELS + ["tread_temperature"] * temperature
    judged = table["load"].isin(LEFT_OUT)
    given, left = (table[rows & part][channels].reset_index(drop=True) for part in (~judged, judged))
    begin = time.perf_counter()
    report = explain_mismatch(tire, given)
    seconds = time.perf_counter() - begin
    return Row(
        hidden,
        rate,
        temperature,
        report.verdict,
        tuple(e.name for e in report.effects),
        rms(left["fy"] - report.corrected.as_it_came.predict(left)["fy"]),
        rms(left["fy"] - report.corrected.predict(left)["fy"]),
        seconds,
        given,
        left,
    )


def forces(tire: TireModel, table: pd.DataFrame) -> np.ndarray:
    """Return the model's side force, N."""
    inputs = {n: table[n].to_numpy() for n in ("slip_angle", "camber", "normal_load")}
    return np.asarray(tire.forces(**inputs, limits="ignore", outputs=("fy",)).fy)


def rms(x: pd.Series) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(x))))


def rows(rates: list[int]) -> Iterator[Row]:
    """Yield all recordings at some rates (Hz)."""
    for rate in rates:
        for hidden in HIDDEN:
            for temperature in (True, False):
                yield judge(hidden, rate, temperature)


def main() -> None:
    """Judge all recordings, or write what was judged into the documentation."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rates", nargs="*", type=int, default=[100, 50, 20, 10], help="Hz")
    parser.add_argument("--write", action="store_true", help="the stored table, into docs/")
    options = parser.parse_args()
    if options.write:
        write_between(PAGE, BEGIN, written(pd.read_csv(RESULTS)))
        return
    table = []
    for row in rows(options.rates):
        table.append(
            {
                "hidden": row.hidden,
                "rate": row.rate,
                "temperature": row.temperature,
                "verdict": row.verdict,
                "names": ", ".join(row.names),
                "before": round(row.before, 1),
                "after": round(row.after, 1),
                "refitted": round(row.refitted, 1),
                "code": code_hash("mismatch", "magic_formula"),
                "date": f"{datetime.now(UTC):%Y-%m-%d}",
            }
        )
        print(*table[-1].values(), sep="  ", flush=True)
    pd.DataFrame(table).to_csv(RESULTS, index=False)


def written(table: pd.DataFrame) -> str:
    """Return the table of the documentation, one recording a row."""
    head = ["hidden", "rate (Hz)", "tread temperature", "named", "before (N)", "after (N)", "refitted (N)"]
    lines = [
        [
            str(row.hidden),
            str(row.rate),
            "recorded" if row.temperature else "not recorded",
            row.names if isinstance(row.names, str) else "nothing",
            *(f"{value:.0f}" for value in (row.before, row.after, row.refitted)),
        ]
        for row in table.itertuples()
    ]
    told = f"Hash of the code {table['code'].iloc[0]}, {table['date'].iloc[0]}."
    return f"{markdown(head, lines)}\n\n{told}"


if __name__ == "__main__":
    main()
