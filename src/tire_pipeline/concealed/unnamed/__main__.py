"""The open-world half of the proof, case by case; a run that was stopped goes on where it was.

python -m tire_pipeline.concealed.unnamed tuning --cases 24 --folder data/08_reporting/unnamed
python -m tire_pipeline.concealed.unnamed sealed --cases 24 --folder data/08_reporting/unnamed --write .

With --write the table goes into benchmarks/results and its scores into docs/explanation/concealed_results.md.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from tire_pipeline.code_hash import code_hash
from tire_pipeline.concealed.open_world.mechanism import Mechanism
from tire_pipeline.concealed.unnamed.baselines import ON_RESIDUAL
from tire_pipeline.concealed.unnamed.cases import OpenCase, draw_open_case
from tire_pipeline.concealed.unnamed.judge import judged, oracle_of, removed, squared
from tire_pipeline.concealed.unnamed.open_world_table import table
from tire_pipeline.mismatch import explain_mismatch

SEEDS = {"tuning": 20261124, "sealed": 10296229}
"""Each sealed run has its own, drawn before it: 20261129 was that of 2026-11-24."""
ROWS = 4000
_BELOW_ONE = 1e-9


def mechanisms_of(half: str) -> tuple[Mechanism, ...]:
    """The mechanisms of one half; the sealed ones are not imported unless they are asked for."""
    if half == "sealed":
        from tire_pipeline.concealed.open_world.sealed import MECHANISMS as SEALED

        return SEALED
    from tire_pipeline.concealed.open_world.tuning import MECHANISMS as TUNING

    return TUNING


def drawn(half: str, number: int) -> tuple[int, OpenCase, tuple[Mechanism, ...]]:
    """Return the seed of a case, the case, and what is in it: one mechanism after the other.

    Every sixth round has two at a time. A run that does not excite a mechanism is drawn again.
    """
    every = mechanisms_of(half)
    chosen = [every[number % len(every)]]
    if (number // len(every)) % 6 == 5:
        chosen.append(every[(number * 5 + 3) % len(every)])
    for attempt in range(20):
        seed = SEEDS[half] + 1000 * number + attempt
        try:
            return seed, draw_open_case(seed, chosen, rows=ROWS), tuple(chosen)
        except ValueError:
            continue
    raise ValueError(f"case {number}: no run of 20 excites {chosen[0].name}")


def run(half: str, number: int) -> dict[str, Any]:
    """Make, explain and judge one case, beside the baselines."""
    seed, case, chosen = drawn(half, number)
    begun = time.process_time()
    report = explain_mismatch(case.tire, case.recording)
    row = {"case": number, "seed": seed, **judged(case, chosen, report)}
    row["seconds"] = time.process_time() - begun
    before, oracle = oracle_of(case)
    for name, fitted in ON_RESIDUAL.items():
        after = squared(case, fitted(case.tire, case.recording)(case.held_out))
        row[f"removed_{name}"] = removed(before, after, oracle)[0]
        row[f"worse_{name}"] = any(after[f] > before[f] * (1.0 + _BELOW_ONE) for f in after)
    return row


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not np.isfinite(value) else value


def main(arguments: Sequence[str] | None = None) -> None:
    """Run what is missing, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("half", choices=sorted(SEEDS))
    parser.add_argument("--cases", type=int, default=24)
    parser.add_argument("--folder", type=Path, default=Path("data/08_reporting/unnamed"))
    parser.add_argument("--write", type=Path, help="folder of the project whose pages take the table")
    asked = parser.parse_args(arguments)
    code = code_hash("mismatch", "magic_formula", "tir")
    folder = asked.folder / asked.half / code
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for number in range(asked.cases):
        file = folder / f"{number:04d}.json"
        if not file.exists():
            row = {k: _plain(v) for k, v in run(asked.half, number).items()}
            file.write_text(json.dumps(row, indent=1), encoding="utf-8")
            print(f"{number:4d} {row['mechanism']:30} {row['verdict']:16} {row['drivers']}", flush=True)
        rows.append(json.loads(file.read_text(encoding="utf-8")))
    made = f"seed {SEEDS[asked.half]}, code {code}, {datetime.now(UTC):%Y-%m-%d}"
    head = f"{asked.half}, {asked.cases} cases, {made}"
    text = table(rows, head)
    (asked.folder / f"{asked.half}.md").write_text(text, encoding="utf-8")
    print(text)
    if asked.write is not None:
        write(asked.half, text, asked.write)


def write(half: str, text: str, project: Path) -> None:
    """Put the table into ``benchmarks/results`` and its scores between two marks of the page."""
    (project / "benchmarks" / "results" / f"unnamed_{half}.md").write_text(text, encoding="utf-8")
    page = project / "docs" / "explanation" / "concealed_results.md"
    mark, end = f"<!-- unnamed {half}, from concealed.unnamed -->", "<!-- end -->"
    before, after = page.read_text(encoding="utf-8").split(mark)
    scores = text.split("\n\n| case ")[0]
    page.write_text(f"{before}{mark}\n\n{scores}\n\n{end}{after.split(end, 1)[1]}", encoding="utf-8")


if __name__ == "__main__":
    main()
