"""Write the published proofs' scores into docs/explanation, none by hand: concealed.md, concealed_results.md.

python benchmarks/proof_table.py                          # prints what follows from the committed tables
python benchmarks/proof_table.py --data data              # from the last run's scores and misses
python benchmarks/proof_table.py --data data --write      # and writes those into the tables and pages
"""

from __future__ import annotations

import argparse
import json
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path
from typing import Any

import pandas as pd
from doc_tables import markdown, write_between
from miss_tables import missed_effects

from tire_pipeline.concealed.real.published import published, published_text
from tire_pipeline.concealed.scoring.words import in_words, outcome
from tire_pipeline.reporting.proof.proof_tables import METHODS

ROOT = Path(__file__).parent.parent
RESULTS = ROOT / "benchmarks" / "results"
PAGE = ROOT / "docs" / "explanation" / "concealed.md"
RESULTS_PAGE = ROOT / "docs" / "explanation" / "concealed_results.md"
REAL = ROOT / "src" / "tire_pipeline" / "concealed" / "real" / "published.csv"
RUNS = RESULTS / "real_proof_runs.csv"
MISSES = ("real_proof_misses.csv", "proof_misses.csv")
BEGIN_SHORT = "<!-- in short, from proof_table.py -->"
BEGIN_MISSES = "<!-- misses, from proof_table.py -->"
BEGIN_POOLED = "<!-- pooled, from proof_table.py -->"
POOLED = 3
"""Runs of the real half that are pooled: chance decides some hundredths of each."""
BEGIN_GOALS = "<!-- goals, from proof_table.py -->"
BEGIN = "<!-- from proof_table.py -->"
BEGIN_REAL = "<!-- real, from proof_table.py -->"
LARGEST = "held-out error over the model's own, largest"
OWN = "explain_mismatch"
INVENTED, FALSE = "false physics, nothing missing", "false physics"
FIRST, AMONG = "right name first, twice the misfit", "truth among the names, twice the misfit"
ANY, WRONG = "truth among the names, any strength", "sets that hold nothing of the truth"
WORSE, REMOVED = "held-out error above the model's own", "held-out share of the oracle's"
OFF = "calibration error of the findings"
CHANCE = f"{OFF}, by chance alone"
NAIVE, FLOOR, ORACLE = "bic_stepwise", "floor", "oracle"


@dataclass
class Taken:
    """The committed tables as the last run leaves them.

    Attributes
    ----------
    texts : dict of Path to str
        Of the tables that the run changes.
    real : tuple of pandas.DataFrame and dict, optional
        Its scores on real recordings and what they were made with.
    """

    texts: dict[Path, str] = field(default_factory=dict)
    real: tuple[pd.DataFrame, dict[str, Any]] | None = None

    def table(self, path: Path) -> pd.DataFrame:
        """A table, as the run leaves it or as it is committed."""
        return pd.read_csv(StringIO(self.texts[path])) if path in self.texts else pd.read_csv(path)

    def write(self) -> None:
        """Replace the committed tables."""
        for path, text in self.texts.items():
            path.write_text(text, encoding="utf-8", newline="")


def take(data: Path) -> Taken:
    """Read scores and misses of the last ``prove_concealed`` below a data folder, or of the half that ran."""
    taken = Taken()
    for name in ("proof_scores.csv", "proof_misses.csv"):
        if (data / "07_model_output" / name).is_dir():
            taken.texts[RESULTS / name] = _text(_last(data, name))
    if not (data / "07_model_output" / "real_proof_details.json").is_dir():
        return taken
    made = json.loads(_last(data, "real_proof_details.json").read_text())
    if not made["published"]:
        name = "real_proof_misses.csv"
        taken.texts[RESULTS / name] = _text(_last(data, name))
        scores = pd.read_csv(_last(data, "real_proof_scores.csv"))
        taken.texts[REAL] = published_text(scores, made["made"])
        taken.texts[RUNS] = _with_run(scores, made["made"])
        taken.real = scores, made["made"]
    return taken


def _with_run(scores: pd.DataFrame, made: dict[str, Any]) -> str:
    """A run's own scores beside those of the runs before."""
    own = scores[(scores["method"] == OWN) & (scores["source"] == "all")][["name", "value", "n"]]
    before = pd.read_csv(RUNS)
    run = own.assign(seed=made["seed"], code=made["code"])[before.columns]
    return pd.concat([before[before["seed"] != made["seed"]], run]).to_csv(index=False)


def _text(path: Path) -> str:
    """A file's text with the ends of lines that it has."""
    with path.open(encoding="utf-8", newline="") as file:
        return file.read()


def _last(data: Path, name: str) -> Path:
    return max((data / "07_model_output" / name).glob(f"*/{name}"))


def goals(simulated: pd.DataFrame, real: pd.DataFrame) -> str:
    """The scores of both halves that have a goal, a table each, beside naive baseline, floor and oracle."""
    parts = []
    for half, scores, methods in (
        ("Simulated cases", simulated, (NAIVE,)),
        ("Cases from real recordings", real, (NAIVE, FLOOR, ORACLE)),
    ):
        aimed = scores[scores["target"].map(lambda goal: isinstance(goal, str))]
        values = _beside(scores)
        rows = [
            [*_own(row), *(_cell(values.get(method, {}).get(row.name), 2) for method in methods)]
            for row in aimed[aimed["method"] == OWN].itertuples()
        ]
        head = ["score", "value", "95% interval", "cases", "goal", "result", *map(_method, methods)]
        parts += [f"{half}:", markdown(head, rows)]
    return "\n\n".join(parts)


def table(scores: pd.DataFrame) -> str:
    """Own scores with interval and goal, the baselines' values beside them."""
    own, others = scores[scores["method"] == OWN], _beside(scores).drop(columns=OWN)
    head = ["score", "value", "95% interval", "cases", "goal", "result", *map(_method, others.columns)]
    rows = [[*_own(row), *(_cell(value, 2) for value in others.loc[row.name])] for row in own.itertuples()]
    return markdown(head, rows)


def real_tables(scores: pd.DataFrame, made: dict) -> str:
    """Scores on real recordings: all of them, by source, and those of the other methods."""
    everywhere = scores[scores["source"] == "all"]
    own = everywhere[everywhere["method"] == OWN]
    first = ["score", "value", "95% interval", "cases", "goal", "result"]
    whole = markdown(first, [_own(row) for row in own.itertuples()])
    mine = scores[scores["method"] == OWN].set_index(["name", "source"])
    sources = list(made["by_source"])
    by_source = [
        [
            in_words(name),
            *(_with_count(mine.loc[(name, s)]) for s in sources),
        ]
        for name in own["name"]
    ]
    others = _beside(everywhere).drop(columns=OWN)
    beside = [[in_words(name), *(_cell(value, 2) for value in others.loc[name])] for name in own["name"]]
    count = ", ".join(f"{n} from {source}" for source, n in made["by_source"].items())
    said = (
        f"{made['cases']} cases ({count}) of seed {made['seed']}, run on {made['date']}; hash of the code "
        f"that was judged {made['code']}, of the answers `{made['sha256']}`; {made['sealed_sweeps']} sweeps "
        f"sealed, {made['development_sweeps']} for development."
    )
    return "\n\n".join(
        [
            said,
            whole,
            "By source, with the number of cases:",
            markdown(["score", *sources], by_source),
            "The other methods on the same cases:",
            markdown(["score", *map(_method, others.columns)], beside),
        ]
    )


def pooled_table(runs: pd.DataFrame) -> str:
    """Shares of the last runs on real recordings together, and each run's own beside."""
    seeds = sorted(runs["seed"].unique())[-POOLED:]
    rows = []
    for name in runs.loc[runs["seed"] == seeds[-1], "name"]:
        each = runs[runs["name"] == name].set_index("seed").reindex(seeds)
        if name == LARGEST or each["n"].isna().any():
            continue
        mean = float((each["value"] * each["n"]).sum() / each["n"].sum())
        rows.append(
            [in_words(name), _cell(mean, 3), f"{each['n'].sum():.0f}", *(_cell(v, 3) for v in each["value"])]
        )
    return markdown(["score", "together", "cases", *(f"seed {seed}" for seed in seeds)], rows)


def in_short(simulated: pd.DataFrame, real: pd.DataFrame, runs: pd.DataFrame) -> str:
    """The answers that most readers look for, a line each, and how many goals are met.

    Parameters
    ----------
    simulated, real : pandas.DataFrame
        Scores of the last run of each half; of `real` those over all sources.
    runs : pandas.DataFrame
        Own scores of the runs on real recordings.
    """
    share, cases = _together(runs)
    own = simulated[simulated["method"] == OWN].set_index("name")
    mine = real[real["method"] == OWN].set_index("name")["value"]

    def together(name: str) -> str:
        return f"{share[name]:.1%}"

    lines = [
        f"**When it names something**, {1 - share[WRONG]:.1%} of its findings hold a true name "
        f"({cases[WRONG]:.0f} findings on real recordings).",
        f"**When nothing is missing**, it invents physics in {together(INVENTED)} of "
        f"{cases[INVENTED]:.0f} real cases, and in {own['value'][FALSE]:.1%} of "
        f"{own['n'][FALSE]:.0f} simulated ones.",
        f"**A strong effect** (twice the misfit) is named first in {together(FIRST)} of "
        f"{cases[FIRST]:.0f} real cases, and is among the names in {together(AMONG)}. At any strength, "
        f"{together(ANY)} are among the names.",
        f"**A correction** makes held-out sweeps worse in {together(WORSE)} of {cases[WORSE]:.0f} "
        f"real cases. It removes {together(REMOVED)} of the squared error that "
        "the true model removes, on average.",
        f"**Confidence**: how often a finding holds a true name differs from what it says by {mine[OFF]:.3f} "
        f"on average (last real run) and by {own['value'][OFF]:.3f} in simulated cases. Were each confidence "
        f"exact, chance alone would show {mine[CHANCE]:.3f} and {own['value'][CHANCE]:.3f}.",
        f"**Goals** of the simulated half: {_met(simulated)}. Of the real half: {_met(real)}.",
    ]
    return "\n".join(f"- {line}" for line in lines)


def _met(scores: pd.DataFrame) -> str:
    """How many goals are met, missed, or have too few cases to tell."""
    own = scores[scores["method"] == OWN]
    results = [found for row in own.itertuples() if (found := outcome(row._asdict()))]
    told = [f"{results.count(each)} {each}" for each in ("met", "missed")]
    few = results.count("too few cases")
    return ", ".join([*told, f"{few} with too few cases to tell"]) if few else " and ".join(told)


def _together(runs: pd.DataFrame) -> tuple[pd.Series, pd.Series]:
    """Shares of the last runs together, and the number of cases, by name."""
    last = runs[runs["seed"].isin(sorted(runs["seed"].unique())[-POOLED:])]
    cases = last.groupby("name")["n"].sum()
    return (last["value"] * last["n"]).groupby(last["name"]).sum() / cases, cases


def _method(name: str) -> str:
    return METHODS.get(name, name)


def _with_count(row: Any) -> str:
    """A score and its number of cases; nothing where there is none."""
    return f"{_cell(row['value'], 3)} ({row['n']:.0f})" if row["n"] else ""


def _beside(scores: pd.DataFrame) -> pd.DataFrame:
    """Score -> method -> value, over all sources."""
    whole = scores[scores["source"] == "all"] if "source" in scores else scores
    return whole.pivot(index="name", columns="method", values="value")


def _own(row: Any) -> list[str]:
    """Score, value, interval, cases, goal, result."""
    return [
        in_words(str(row.name)),
        _cell(row.value, 3),
        f"{_cell(row.low, 3)} to {_cell(row.high, 3)}" if row.low < row.high else "",
        f"{row.n:.0f}",
        _goal(row.target) if isinstance(row.target, str) else "",
        outcome(row._asdict()),
    ]


def _goal(target: str) -> str:
    """A goal on one line."""
    return target.replace("<=", "≤").replace(">=", "≥").replace(" ", "\u00a0")


def _cell(value: float | None, digits: int) -> str:
    return f"{value:.{digits}f}" if pd.notna(value) else ""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path)
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    taken = take(asked.data) if asked.data else Taken()
    if asked.write:
        taken.write()
    simulated = taken.table(RESULTS / "proof_scores.csv")
    scores, made = taken.real or published()
    everywhere = scores[scores["source"] == "all"] if made else scores
    runs, misses = taken.table(RUNS), [taken.table(RESULTS / name) for name in MISSES]
    parts = [
        (PAGE, BEGIN_GOALS, goals(simulated, everywhere)),
        (RESULTS_PAGE, BEGIN, table(simulated)),
        (RESULTS_PAGE, BEGIN_POOLED, pooled_table(runs)),
        (RESULTS_PAGE, BEGIN_SHORT, in_short(simulated, everywhere, runs)),
        (RESULTS_PAGE, BEGIN_MISSES, missed_effects(*misses)),
    ]
    if made:
        parts.append((RESULTS_PAGE, BEGIN_REAL, real_tables(scores, made)))
    for page, begin, text in parts:
        print(f"{text}\n")
        if asked.write:
            write_between(page, begin, text)


if __name__ == "__main__":
    main()
