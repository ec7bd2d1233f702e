"""Write the published proof's scores into docs/concealed.md, none by hand.

python benchmarks/proof_table.py                          # prints benchmarks/results/proof_scores.csv
python benchmarks/proof_table.py --data data --write      # takes the last run's scores and misses first
"""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

import pandas as pd
from doc_tables import markdown, write_between

ROOT = Path(__file__).parent.parent
RESULTS = ROOT / "benchmarks" / "results"
PAGE = ROOT / "docs" / "concealed.md"
BEGIN = "<!-- from proof_table.py -->"
OWN = "explain_mismatch"


def take(data: Path) -> None:
    """Copy scores and misses of the last ``prove_concealed`` below a data folder."""
    for name in ("proof_scores.csv", "proof_misses.csv"):
        last = max((data / "07_model_output" / name).glob(f"*/{name}"))
        shutil.copyfile(last, RESULTS / name)


def table(scores: pd.DataFrame) -> str:
    """Own scores with interval and goal, the baselines' values beside them."""
    own = scores[scores["method"] == OWN].set_index("name")
    others = scores[scores["method"] != OWN].pivot(index="name", columns="method", values="value")
    head = ["score", "value", "95% interval", "n", "goal", "met", *others.columns]
    rows = []
    for name, row in own.iterrows():
        goal = row["target"] if isinstance(row["target"], str) else ""
        met = {"True": "yes", "False": "no"}.get(str(row["met"]), "")
        cells = [
            name,
            f"{row['value']:.3f}",
            f"{row['low']:.3f} to {row['high']:.3f}",
            f"{row['n']:.0f}",
            goal,
            met,
            *(f"{value:.2f}" if pd.notna(value) else "" for value in others.loc[name]),
        ]
        rows.append(cells)
    return markdown(head, rows)


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


if __name__ == "__main__":
    main()
