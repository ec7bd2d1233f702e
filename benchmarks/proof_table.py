"""Write the published proofs' scores into docs/explanation/concealed.md, none by hand.

python benchmarks/proof_table.py                          # prints benchmarks/results/proof_scores.csv
python benchmarks/proof_table.py --data data --write      # takes the last run's scores and misses first
"""

from __future__ import annotations

import argparse
import json
import shutil
from pathlib import Path

import pandas as pd
from doc_tables import markdown, write_between

from tire_pipeline.concealed.real.published import published, published_text
from tire_pipeline.concealed.scoring.words import in_words, outcome

ROOT = Path(__file__).parent.parent
RESULTS = ROOT / "benchmarks" / "results"
PAGE = ROOT / "docs" / "explanation" / "concealed.md"
REAL = ROOT / "src" / "tire_pipeline" / "concealed" / "real" / "published.csv"
BEGIN = "<!-- from proof_table.py -->"
BEGIN_REAL = "<!-- real, from proof_table.py -->"
OWN = "explain_mismatch"


def take(data: Path) -> None:
    """Copy scores and misses of the last ``prove_concealed`` below a data folder, or of the half that ran."""
    for name in ("proof_scores.csv", "proof_misses.csv"):
        if (data / "07_model_output" / name).is_dir():
            shutil.copyfile(_last(data, name), RESULTS / name)
    if not (data / "07_model_output" / "real_proof_details.json").is_dir():
        return
    made = json.loads(_last(data, "real_proof_details.json").read_text())
    if not made["published"]:
        shutil.copyfile(_last(data, "real_proof_misses.csv"), RESULTS / "real_proof_misses.csv")
        scores = pd.read_csv(_last(data, "real_proof_scores.csv"))
        REAL.write_text(published_text(scores, made["made"]))


def _last(data: Path, name: str) -> Path:
    return max((data / "07_model_output" / name).glob(f"*/{name}"))


def table(scores: pd.DataFrame) -> str:
    """Own scores with interval and goal, the baselines' values beside them."""
    own = scores[scores["method"] == OWN].set_index("name")
    others = scores[scores["method"] != OWN].pivot(index="name", columns="method", values="value")
    head = ["score", "value", "95% interval", "cases", "goal", "result", *others.columns]
    rows = []
    for name, row in own.iterrows():
        goal = row["target"] if isinstance(row["target"], str) else ""
        cells = [
            in_words(str(name)),
            f"{row['value']:.3f}",
            f"{row['low']:.3f} to {row['high']:.3f}",
            f"{row['n']:.0f}",
            goal,
            outcome(row.to_dict()),
            *(f"{value:.2f}" if pd.notna(value) else "" for value in others.loc[name]),
        ]
        rows.append(cells)
    return markdown(head, rows)


def real_table(scores: pd.DataFrame, made: dict) -> str:
    """Scores on real recordings by source, and those of the baselines on all."""
    own = scores[scores["method"] == OWN]
    others = scores[(scores["method"] != OWN) & (scores["source"] == "all")]
    beside = others.pivot(index="name", columns="method", values="value")
    sources = list(made["by_source"])
    head = ["score", "all", "95% interval", "cases", "goal", "result", *sources, *beside.columns]
    rows = []
    for row in own[own["source"] == "all"].itertuples():
        parts = own[own["name"] == row.name].set_index("source")
        rows.append(
            [
                in_words(row.name),
                _cell(row.value, 3),
                f"{_cell(row.low, 3)} to {_cell(row.high, 3)}" if row.n else "",
                f"{row.n:.0f}",
                row.target if isinstance(row.target, str) else "",
                outcome(row._asdict()),
                *(f"{_cell(parts.loc[s, 'value'], 3)} ({parts.loc[s, 'n']:.0f})" for s in sources),
                *(_cell(value, 2) for value in beside.loc[row.name]),
            ]
        )
    count = ", ".join(f"{n} from {source}" for source, n in made["by_source"].items())
    first = (
        f"{made['cases']} cases ({count}) of seed {made['seed']}, run on {made['date']}; hash of the code "
        f"that was judged {made['code']}, of the answers `{made['sha256']}`; {made['sealed_sweeps']} sweeps "
        f"sealed, {made['development_sweeps']} for development."
    )
    return f"{first}\n\n{markdown(head, rows)}"


def _cell(value: float, digits: int) -> str:
    return f"{value:.{digits}f}" if pd.notna(value) else ""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path)
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    if asked.data:
        take(asked.data)
    text = table(pd.read_csv(RESULTS / "proof_scores.csv"))
    print(text)
    if asked.write:
        write_between(PAGE, BEGIN, text)
    scores, made = published()
    if made:
        text = real_table(scores, made)
        print(f"\n{text}")
        if asked.write:
            write_between(PAGE, BEGIN_REAL, text)


if __name__ == "__main__":
    main()
