"""Fits to random subsets of real sweeps beside the least that random starts of the same formula reach.

python benchmarks/fit_subsets.py --subsets 120      # goes on where it stopped
python benchmarks/fit_subsets.py --table            # what was measured
python benchmarks/fit_subsets.py --write            # the same, into the documentation

Subsets: sweeps of the flat belt (calspan, by load or at random, thinned by 1 to 20), points of the TYDEX
file, a brush tire of the rig simulator that brakes, drives and corners, and points that other software has
computed for public tire files (with noise), for the stages that the two real recordings lack. Each is fitted
in 5.2 and 6.1, every sixth in 6.2, whose steady equations are those of 6.1.

The least: 30 random starts, half of them anywhere within the bounds of the fit, half around typical values;
each is a search over all coefficients of the force at once, run on at most 350 rows, the best five on 1,500,
and the best of these on all. The moment is asked about with the forces of our fit; the least of the forces
is kept in ``benchmarks/results/fit_subsets_least.csv``.
The RMS is over all rows given, each force apart. Results: ``benchmarks/results/fit_subsets.csv``, one row a
force, with the hash of the code that fitted.
"""

from __future__ import annotations

import argparse
import hashlib
import time
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from doc_tables import markdown, write_between
from threadpoolctl import threadpool_limits

from tire_pipeline import magic_formula
from tire_pipeline.concealed.brush_rig.constants import draw_constants
from tire_pipeline.concealed.brush_rig.schedule import CHANNELS
from tire_pipeline.concealed.brush_rig.simulate import BrushRig
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import FitResult, fit_magic_formula
from tire_pipeline.magic_formula.fitting.least_squares.solve import Problem, quick
from tire_pipeline.magic_formula.fitting.setup import given
from tire_pipeline.magic_formula.fitting.setup.stages import BOUNDS, PRESSURE_BOUNDS, STAGES
from tire_pipeline.magic_formula.fitting.setup.starts import typical_values
from tire_pipeline.magic_formula.fitting.setup.typical import FEW_POINTS, pull
from tire_pipeline.magic_formula.parameters.coefficients import family_of
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS
from tire_pipeline.recordings import read_recording

SHARED = Path(__file__).resolve().parents[2] / "shared"
RESULTS = Path(__file__).parent / "results" / "fit_subsets.csv"
LEAST = RESULTS.with_name("fit_subsets_least.csv")
"""Coefficients of the least that random starts reach, of forces: the moment's depend on our fit."""
LEAST_COLUMNS = ["seed", "family", "force", "coefficient", "value"]
STARTS = 30
ROUNDS = ((350, 30, 60), (1500, 5, 60), (10**9, 1, 20))
"""Of the least: rows at most, searches that go on, evaluations of the derivatives."""
SOURCES = (*["calspan"] * 3, "rig", "tydex", *["calspan"] * 3, "file", "tydex")
"""What the subsets are of, in turn."""
VERSIONS = ("5.2", "6.1", "6.2")
NOISE = 0.01
"""Of computed forces, over the largest."""
LEVELS = np.array([800.0, 1350.0, 1900.0, 2450.0])
"""Between the five loads of the flat belt, N."""
_STIFFNESS = "cornering_stiffness"
REACH = np.linspace(0.5, 1.5, 11)
"""Loads, over the one of a single-load fit, at which its cornering stiffness has to be plausible."""


@dataclass(frozen=True)
class Subset:
    """Rows to fit, rows at loads left out (maybe none), and what they are."""

    seed: int
    source: str
    what: str
    rows: pd.DataFrame = field(repr=False)
    left_out: pd.DataFrame = field(repr=False)
    one_load: bool = False


@cache
def code() -> str:
    """Hash of the fit."""
    total = hashlib.sha256()
    for path in sorted(Path(magic_formula.__file__).parent.rglob("*.py")):
        total.update(path.read_bytes())
    return total.hexdigest()[:12]


# Subsets


@cache
def calspan() -> pd.DataFrame:
    """All sweeps of the flat belt, with ``sweep``, ``level`` of load, ``low`` pressure, ``leaning``."""
    path = SHARED / "recordings" / "calspan" / "cornering_part.mat"
    table = read_recording(path, axes="ISO")
    names = ["time", "slip_angle", "camber", "normal_load", "speed", "pressure", "fy", "mz"]
    table = table[names].assign(sweep=np.r_[0, np.cumsum(np.diff(table["time"]) > 0.5)])
    middle = table.groupby("sweep")[["normal_load", "pressure", "camber"]].transform("median")
    return table.assign(
        level=np.searchsorted(LEVELS, middle["normal_load"]),
        low=middle["pressure"] < 76_000.0,
        leaning=np.degrees(middle["camber"]) > 0.8,
    )


def of_calspan(seed: int) -> Subset:
    """Some of five loads at some of four settings, or sweeps at random; thinned by 1 to 20."""
    rng = np.random.default_rng([20_241, seed])
    table, step = calspan(), int(rng.integers(1, 21))
    if rng.random() < 0.3:
        number = int(rng.integers(1, 12))
        chosen = np.isin(table["sweep"], rng.choice(table["sweep"].max() + 1, number, replace=False))
        what, other = f"{number} sweeps", np.zeros(len(table), dtype=bool)
        one = table["level"][chosen].nunique() == 1
    else:
        settings = [[(False, False)], [(True, False)], [(False, False), (True, False)]]
        settings += [[(False, False), (False, True)], [(a, b) for a in (False, True) for b in (False, True)]]
        setting = settings[int(rng.integers(len(settings)))]
        where = np.array([pair in setting for pair in zip(table["low"], table["leaning"], strict=True)])
        number = int(rng.integers(1, 6))
        levels = np.sort(rng.choice(5, number, replace=False))
        chosen = where & np.isin(table["level"], levels)
        other, one = where & ~chosen, number == 1
        what = f"loads {''.join(str(n + 1) for n in levels)} of 5 at {len(setting)} settings"
    start = int(rng.integers(step))
    rows = table[chosen].iloc[start::step]
    return Subset(seed, "calspan", f"{what}, every {step}", rows, table[other].iloc[::5], one)


@cache
def tydex() -> pd.DataFrame:
    """The points of the TYDEX file, with the ``level`` of load in fifths."""
    table = read_recording(SHARED / "recordings" / "tydex" / "DT_195_65R15_demo.tdx")
    return table.assign(level=np.searchsorted([2100.0, 3950.0, 5700.0, 7600.0], table["normal_load"]))


def of_tydex(seed: int) -> Subset:
    """Three to five of five loads, all cambers or none; all points, or one in two or three."""
    rng = np.random.default_rng([20_242, seed])
    table = tydex()
    if rng.random() < 0.3:
        table = table[np.degrees(table["camber"].abs()) < 0.3]
    levels = np.sort(rng.choice(5, int(rng.integers(3, 6)), replace=False))
    step = int(rng.integers(1, 4)) if len(table) > 50 else 1
    chosen = np.isin(table["level"], levels)
    what = f"loads {''.join(str(n + 1) for n in levels)} of 5, {len(table)} points, every {step}"
    return Subset(seed, "tydex", what, table[chosen].iloc[::step], table[~chosen])


def of_rig(seed: int) -> Subset:
    """A brush tire that brakes, drives and corners at some of five loads."""
    rng = np.random.default_rng([20_243, seed])
    constants = draw_constants(rng)
    rig = BrushRig(constants, np.zeros(0), 1.0, {}, {}, 24)
    loads = constants.nominal_load * np.linspace(0.3, 1.65, 5)
    ratio, angle = np.linspace(-0.25, 0.25, 61), np.linspace(-0.2, 0.2, 61)
    sides, camber = (0.0, -0.1, -0.05, 0.03, 0.06), 0.06
    points = [(a, k, 0.0, load) for load in loads for a in sides for k in ratio]
    points += [(a, 0.0, g, load) for load in loads for g in (-camber, 0.0, camber) for a in angle]
    frame = pd.DataFrame(points, columns=["slip_angle", "slip_ratio", "camber", "normal_load"])
    frame["speed"], frame["pressure"] = constants.nominal_speed, constants.nominal_pressure
    frame["turn_slip"], frame["time"] = 0.0, np.arange(len(frame)) * 0.02
    table = rig.run(frame[["time", *CHANNELS]], {})
    for force in ("fx", "fy"):
        table[force] += 0.005 * table[force].abs().max() * rng.standard_normal(len(table))
    number, step = int(rng.integers(2, 6)), int(rng.integers(1, 4))
    levels = np.sort(rng.choice(5, number, replace=False))
    chosen = np.isin(table["normal_load"], loads[levels])
    columns = ["slip_angle", "slip_ratio", "camber", "normal_load", "fx", "fy"]
    what = f"loads {''.join(str(n + 1) for n in levels)} of 5, every {step}"
    return Subset(seed, "rig", what, table[chosen][columns].iloc[::step], table[~chosen][columns])


def of_file(seed: int) -> Subset:
    """Points of pure and combined slip that other software has computed for a public file, with noise."""
    rng = np.random.default_rng([20_244, seed])
    files = sorted((SHARED / "reference_forces").glob("*.csv"))
    path = files[seed % len(files)]
    table = pd.read_csv(path).rename(columns=FILE_COLUMNS)[list(FILE_COLUMNS.values())]
    table = table[(table["set"] != "rand") & (table["normal_load"] > 0.0)].drop(columns="set")
    for output in ("fx", "fy", "mz"):
        table[output] += NOISE * table[output].abs().max() * rng.standard_normal(len(table))
    rows = table.sample(frac=float(rng.uniform(0.4, 1.0)), random_state=rng)
    return Subset(seed, "file", f"{path.stem}, {len(rows)} points", rows, table.iloc[:0])


FILE_COLUMNS = {
    "set": "set",
    "Fz_N": "normal_load",
    "kappa": "slip_ratio",
    "alpha_rad": "slip_angle",
    "gamma_rad": "camber",
    "Vx_mps": "speed",
    "p_Pa": "pressure",
    "Fx_N": "fx",
    "Fy_N": "fy",
    "Mz_Nm": "mz",
}
MAKERS = {"calspan": of_calspan, "tydex": of_tydex, "rig": of_rig, "file": of_file}


def subset(number: int) -> Subset:
    """Return a subset by its number."""
    return MAKERS[SOURCES[number % len(SOURCES)]](number)


# The least that random starts reach


def names_of(output: str, family: int) -> list[str]:
    """Return all coefficients that the stages of an output free."""
    return [name for stage in STAGES if stage.output == output for name in stage.over(family)]


def rows_of(table: pd.DataFrame, model: TireModel) -> list[np.ndarray]:
    """Return the inputs of the formula at a table's rows."""
    points, _ = given.columns(table)
    points["speed"] = given.filled(points["speed"], model.value("LONGVL"))
    points["pressure"] = given.filled(
        points["pressure"], model.value("NOMPRES") if model.family == 6 else 0.0
    )
    return [np.ascontiguousarray(points[name]) for name in POINT_CHANNELS]


def limits(names: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    """Return the bounds of coefficients."""
    low, high = np.array([BOUNDS.get(name, PRESSURE_BOUNDS)[:2] for name in names]).T
    return low, high


def problem_of(model: TireModel, output: str, table: pd.DataFrame) -> Problem:
    """Return the problem of an output over all its coefficients at all rows."""
    names = names_of(output, model.family)
    drawn = pull(names, typical_values(names, model, False), limits(names))
    measured = table[output].to_numpy(dtype=float)
    return Problem(model.packed.copy(), model.family, output, names, rows_of(table, model), measured, drawn)


def random_starts(problem: Problem, rng: np.random.Generator, number: int = STARTS) -> list[np.ndarray]:
    """Return starts anywhere within the bounds, and around typical values, in turn."""
    low, high = limits(problem.names)
    around = problem.pull.centre + 2.0 * problem.pull.spread * rng.standard_normal((number, low.size))
    return [around[i] if i % 2 else rng.uniform(low, high) for i in range(number)]


def least(problem: Problem, rng: np.random.Generator, number: int = STARTS) -> np.ndarray:
    """Return the values that leave the least RMS of all random starts."""
    floor = 1e-7 * float(np.abs(problem.measured).max())
    found = random_starts(problem, rng, number)
    for rows, kept, most in ROUNDS:
        part = problem.thinned(max(rows, 8 * len(problem.names)))
        found = sorted(found, key=part.misfit)[:kept]
        found = [quick(part.drawn(floor), limits(problem.names), x, steps=most) for x in found]
    return min(found, key=problem.misfit)


def stored_least(problem: Problem, part: Subset, rng: np.random.Generator) -> np.ndarray:
    """Return the least of random starts: of forces, which do not depend on a fit, it is kept."""
    if problem.output == "mz":
        return least(problem, rng)
    kept = pd.read_csv(LEAST) if LEAST.exists() else pd.DataFrame(columns=LEAST_COLUMNS)
    same = (
        (kept["seed"] == part.seed) & (kept["family"] == problem.family) & (kept["force"] == problem.output)
    )
    values = kept[same].set_index("coefficient")["value"]
    if len(values):
        return values[list(problem.names)].to_numpy(dtype=float)
    found = least(problem, rng)
    entry = {"seed": part.seed, "family": problem.family, "force": problem.output}
    table = pd.DataFrame({**entry, "coefficient": problem.names, "value": found}, columns=LEAST_COLUMNS)
    table.to_csv(LEAST, mode="a", header=not LEAST.exists(), index=False, float_format="%.9g")
    return found


# One row of the table


def judged(fit: FitResult, output: str, part: Subset, best: np.ndarray) -> dict[str, Any]:
    """Return the ratio of one force of a fit to the least, and that of the loads left out."""
    here = problem_of(fit.model, output, part.rows)
    own = np.array([fit.model.value(n) for n in here.names])
    row: dict[str, Any] = {
        "force": output,
        "rows": len(part.rows),
        "coefficients": int((np.abs(here.jacobian(best)).max(axis=0) > 0.0).sum()),
        "fit": here.misfit(own),
        "least": min(here.misfit(best), here.misfit(own)),
        "largest": float(part.rows[output].abs().max()),
    }
    if len(part.left_out) >= given.FEWEST_POINTS and not part.one_load:
        there = problem_of(fit.model, output, part.left_out)
        row |= {"left_out": there.misfit(own), "left_out_least": there.misfit(best)}
    return row


@cache
def all_loads() -> TireModel:
    """Fit to all sweeps of the flat belt."""
    return fit_magic_formula(calspan().iloc[::10][["slip_angle", "camber", "normal_load", "fy"]]).model


def stiffness(fit: FitResult, part: Subset) -> dict[str, Any]:
    """Return the range of the cornering stiffness from 0.5 to 1.5 of one load, over that of all loads."""
    load = float(part.rows["normal_load"].median()) * REACH
    found, true = (
        np.asarray(m.forces(normal_load=load, limits="ignore", outputs=(_STIFFNESS,)).cornering_stiffness)
        for m in (fit.model, all_loads())
    )
    return {"stiffness_low": float((found / true).min()), "stiffness_high": float((found / true).max())}


def measured(number: int) -> Iterator[dict[str, Any]]:
    """Fit one subset in all versions, and yield a row a force."""
    part = subset(number)
    forces = [n for n in ("fx", "fy", "mz") if n in part.rows]
    found: dict[tuple[int, str], float] = {}
    simple: dict[str, float] = {}
    for version in VERSIONS if number % 6 == 0 else VERSIONS[:2]:
        begun = time.process_time()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            fit = fit_magic_formula(part.rows, version)
        seconds = time.process_time() - begun
        for output in forces:
            rng = np.random.default_rng([number, family_of(version)])
            best = stored_least(problem_of(fit.model, output, part.rows), part, rng)
            row = judged(fit, output, part, best)
            key = (family_of(version), output)
            row["least"] = found[key] = min(row["least"], found.get(key, np.inf))
            simple.setdefault(output, row["fit"])
            row |= {"over_52": row["fit"] / simple[output], "seconds": seconds}
            if part.one_load and output == "fy" and part.source == "calspan":
                row |= stiffness(fit, part)
            row |= {"seed": number, "source": part.source, "subset": part.what, "version": version}
            yield row | {"ratio": row["fit"] / row["least"], "poor": output in fit.poor}


COLUMNS = (
    "seed source subset version force rows coefficients largest fit least ratio over_52 left_out "
    "left_out_least stiffness_low stiffness_high poor seconds code date"
).split()


def run(number: int) -> None:
    """Measure the subsets that the table lacks, with the present code."""
    RESULTS.parent.mkdir(exist_ok=True)
    done = set(pd.read_csv(RESULTS)["seed"]) if RESULTS.exists() else set()
    for seed in range(number):
        if seed in done:
            continue
        table = pd.DataFrame(measured(seed))
        table["code"], table["date"] = code(), datetime.now(UTC).date().isoformat()
        table = table.reindex(columns=COLUMNS)
        table.to_csv(RESULTS, mode="a", header=not RESULTS.exists(), index=False, float_format="%.5g")
        shown = table[["seed", "source", "version", "force", "rows", "ratio", "over_52", "seconds"]]
        print(shown.round(3).to_string(index=False, header=False), table["subset"][0], flush=True)


GOALS = {
    "ratio": ("fit over the least of random starts", 1.05),
    "over_52": ("6.x over 5.2", 1.02),
    "ahead": ("loads left out, over the best start", 1.2),
}


DOCS = Path(__file__).resolve().parents[1] / "docs" / "explanation" / "magic_formula.md"
MARK = "<!-- from fit_subsets.py -->"
"""Where the page shows the table."""


def documented(table: pd.DataFrame) -> str:
    """Return the shares that meet each goal by source and force, as a table for the documentation."""
    table = table.assign(ahead=table["left_out"] / table["left_out_least"])
    table.loc[table["version"] == "5.2", "over_52"] = np.nan
    few = table["rows"] < FEW_POINTS * table["coefficients"]
    rows = []
    for column, (title, goal) in GOALS.items():
        for name, group in [*table[~few].groupby(["source", "force"]), (("few points", ""), table[few])]:
            x = group[column].dropna()
            if len(x):
                share = f"{(x <= goal).mean():.2f}"
                rows.append(
                    [
                        title,
                        " ".join(name),
                        f"{goal:g}",
                        share,
                        str(len(x)),
                        f"{x.median():.2f}",
                        f"{x.max():.2f}",
                    ]
                )
    one = table.dropna(subset=["stiffness_low"])
    low, high = one["stiffness_low"].min(), one["stiffness_high"].max()
    below = (
        f"{table['seed'].nunique()} subsets, {table['date'].min()} to {table['date'].max()}, code "
        f"{', '.join(sorted(set(table['code'])))}. From one load, the cornering stiffness at 0.5 to 1.5 of "
        f"it is {low:.2f} to {high:.2f} times that of a fit to all loads ({len(one)} fits)."
    )
    head = ["ratio", "of", "goal, at most", "share that meets it", "fits", "median", "largest"]
    return markdown(head, rows) + "\n\n" + below


def summary(table: pd.DataFrame) -> str:
    """Return shares that meet each goal, by source, version and force."""
    table = table.assign(ahead=table["left_out"] / table["left_out_least"])
    table.loc[table["version"] == "5.2", "over_52"] = np.nan
    few = table["rows"] < FEW_POINTS * table["coefficients"]
    groups = [*table[~few].groupby(["source", "version", "force"]), (("few points", "", ""), table[few])]
    lines = [f"{table['seed'].nunique()} subsets, code {', '.join(sorted(set(table['code'])))}"]
    for column, (title, goal) in GOALS.items():
        lines.append(f"\n{title}: share of at most {goal}, number, median, largest")
        for name, group in groups:
            x = group[column].dropna()
            if len(x):
                good = f"{(x <= goal).mean():.3f} {len(x):4} {x.median():8.3f} {x.max():8.3f}"
                lines.append(f"{' '.join(name):24} {good}")
    one = table.dropna(subset=["stiffness_low"])
    if len(one):
        lines.append(
            f"\none load: cornering stiffness from 0.5 to 1.5 of it is {one['stiffness_low'].min():.2f} to "
            f"{one['stiffness_high'].max():.2f} times that of a fit to all loads ({len(one)} fits)"
        )
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--subsets", type=int, default=0)
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--write", action="store_true", help="put the table into the documentation")
    asked = parser.parse_args()
    with threadpool_limits(1):
        run(asked.subsets)
    if asked.table:
        print(summary(pd.read_csv(RESULTS, dtype={"version": str})))
    if asked.write:
        write_between(DOCS, MARK, documented(pd.read_csv(RESULTS, dtype={"version": str})))


if __name__ == "__main__":
    main()
