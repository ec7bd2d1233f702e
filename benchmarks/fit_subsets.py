"""Fits to random subsets of real sweeps beside the least that random starts of the same formula reach.

python benchmarks/fit_subsets.py --subsets 120      # goes on where it stopped
python benchmarks/fit_subsets.py --table            # what was measured
python benchmarks/fit_subsets.py --write            # the same, into the documentation

Subsets: those of ``drawn_subsets.py``. Each is fitted in 5.2 and 6.1, every sixth in 6.2, whose steady
equations are those of 6.1.

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
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from doc_tables import markdown, write_between
from drawn_subsets import Subset, calspan, subset
from threadpoolctl import threadpool_limits

from tire_pipeline import magic_formula
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import FitResult, fit_magic_formula
from tire_pipeline.magic_formula.fitting.least_squares.solve import Problem, quick
from tire_pipeline.magic_formula.fitting.setup import given
from tire_pipeline.magic_formula.fitting.setup.measured import FEWEST_POINTS, columns
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import BOUNDS, PRESSURE_BOUNDS, STAGES
from tire_pipeline.magic_formula.fitting.setup.starts import typical_values
from tire_pipeline.magic_formula.fitting.setup.typical import FEW_POINTS, pull
from tire_pipeline.magic_formula.parameters.coefficients import family_of
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS

RESULTS = Path(__file__).parent / "results" / "fit_subsets.csv"
LEAST = RESULTS.with_name("fit_subsets_least.csv")
"""Coefficients of the least that random starts reach, of forces: the moment's depend on our fit."""
LEAST_COLUMNS = ["seed", "family", "force", "coefficient", "value"]
STARTS = 30
ROUNDS = ((350, 30, 60), (1500, 5, 60), (10**9, 1, 20))
"""Of the least: rows at most, searches that go on, evaluations of the derivatives."""
VERSIONS = ("5.2", "6.1", "6.2")
_STIFFNESS = "cornering_stiffness"
REACH = np.linspace(0.5, 1.5, 11)
"""Loads, over the one of a single-load fit, at which its cornering stiffness has to be plausible."""


@cache
def code() -> str:
    """Hash of the fit."""
    total = hashlib.sha256()
    for path in sorted(Path(magic_formula.__file__).parent.rglob("*.py")):
        total.update(path.read_bytes())
    return total.hexdigest()[:12]


# The least that random starts reach


def names_of(output: str, family: int) -> list[str]:
    """Return all coefficients that the stages of an output free."""
    return [name for stage in STAGES if stage.output == output for name in stage.over(family)]


def rows_of(table: pd.DataFrame, model: TireModel) -> list[np.ndarray]:
    """Return the inputs of the formula at a table's rows."""
    points, *_ = columns(table, model.version)
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
    if len(part.left_out) >= FEWEST_POINTS and not part.one_load:
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
                        " ".join(name).strip(),
                        f"{goal:g}",
                        share,
                        str(len(x)),
                        f"{x.median():.2f}",
                        _largest(x.max()),
                    ]
                )
    first, last = table["date"].min(), table["date"].max()
    when = first if first == last else f"{first} to {last}"
    one = table.dropna(subset=["stiffness_low"])
    low, high = one["stiffness_low"].min(), one["stiffness_high"].max()
    below = (
        f"{table['seed'].nunique()} subsets, {when}, code "
        f"{', '.join(sorted(set(table['code'])))}. From one load, the cornering stiffness at 0.5 to 1.5 of "
        f"it is {low:.2f} to {high:.2f} times that of a fit to all loads ({len(one)} fits)."
    )
    head = ["ratio", "of", "goal, at most", "share that meets it", "fits", "median", "largest"]
    return markdown(head, rows) + "\n\n" + below


def _largest(ratio: float) -> str:
    """A ratio; one to nearly nothing only says so."""
    return f"{ratio:.2f}" if ratio < 100.0 else "over 100"


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
