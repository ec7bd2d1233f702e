"""The open-world half of the proof, case by case; a run that was stopped goes on where it was.

python -m tire_pipeline.concealed.unnamed tuning --cases 24
python -m tire_pipeline.concealed.unnamed sealed --cases 400 --processes 2 --write . --commit

With --write the table goes into benchmarks/results and its scores into a page of the documentation; with
--commit both are committed.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import time
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from tire_pipeline.code_hash import code_hash
from tire_pipeline.concealed.open_world.mechanism import Mechanism
from tire_pipeline.concealed.unnamed.baselines import ON_RESIDUAL
from tire_pipeline.concealed.unnamed.cases import CATALOGUE_NAMES, OpenCase, draw_open_case
from tire_pipeline.concealed.unnamed.judge import judged, oracle_of, removed, squared, worse
from tire_pipeline.concealed.unnamed.open_world_table import table
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.tasks import one_thread

SEEDS = {"tuning": 20261124, "sealed": 20261270}
"""Each sealed run has its own, drawn before it: 20261129 was that of 2026-11-24, 10296229 that of 11-27, and
20261260 that of 11-28, 20261262 that of 11-29."""
PAGE_OF_HALF = {"tuning": "docs/history/proofs.md", "sealed": "docs/explanation/concealed_results.md"}
"""Which page takes the scores of each half."""
ROWS = 4000
ALONE, TWO, BESIDE = "alone", "two", "beside a named one"
PLAN = (ALONE, TWO, ALONE, BESIDE)
"""How each round of all mechanisms has them; then it begins again."""
_MOST_DRAWS = 100


def mechanisms_of(half: str) -> tuple[Mechanism, ...]:
    """The mechanisms of one half; the sealed ones are not imported unless they are asked for."""
    if half == "sealed":
        from tire_pipeline.concealed.open_world.sealed import MECHANISMS as SEALED

        return SEALED
    from tire_pipeline.concealed.open_world.tuning import MECHANISMS as TUNING

    return TUNING


def planned(half: str, number: int) -> tuple[tuple[Mechanism, ...], tuple[str, ...]]:
    """Mechanisms of a case, one after the other in each round, and the named causes beside them."""
    every = mechanisms_of(half)
    rounds, place = divmod(number, len(every))
    kind = PLAN[rounds % len(PLAN)]
    if kind == TWO:
        further = 1 + (rounds // len(PLAN)) % (len(every) - 1)
        return (every[place], every[(place + further) % len(every)]), ()
    causes = tuple(CATALOGUE_NAMES)
    beside = (causes[(place + rounds // len(PLAN)) % len(causes)],) if kind == BESIDE else ()
    return (every[place],), beside


def drawn(half: str, number: int) -> tuple[int, OpenCase, tuple[Mechanism, ...]]:
    """Return the seed of a case, the case, and its mechanisms.

    A run that does not excite a mechanism is drawn again.
    """
    chosen, beside = planned(half, number)
    for attempt in range(_MOST_DRAWS):
        seed = SEEDS[half] + 1000 * number + attempt
        try:
            return seed, draw_open_case(seed, chosen, beside, rows=ROWS), chosen
        except ValueError:
            continue
    raise ValueError(f"case {number}: no run of {_MOST_DRAWS} excites {chosen[0].name}")


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
        row[f"worse_{name}"] = worse(before, after)
    return row


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not np.isfinite(value) else value


def stored(half: str, number: int, file: Path) -> str:
    """Run a case, write its row, and return a line about it."""
    with one_thread():
        row = {k: _plain(v) for k, v in run(half, number).items()}
    part = file.with_suffix(".part")
    part.write_text(json.dumps(row, indent=1), encoding="utf-8")
    part.replace(file)
    return f"{number:4d} {row['mechanism']:40} {row['verdict']:16} {row['drivers']}"


def main(arguments: Sequence[str] | None = None) -> None:
    """Run what is missing, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("half", choices=sorted(SEEDS))
    parser.add_argument("--cases", type=int, default=24)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--folder", type=Path, default=Path("data/08_reporting/unnamed"))
    parser.add_argument("--write", type=Path, help="folder of the project whose pages take the table")
    parser.add_argument("--commit", action="store_true", help="commit what --write has written")
    asked = parser.parse_args(arguments)
    code = code_hash("mismatch", "magic_formula", "tir", "concealed/unnamed")
    folder = asked.folder / asked.half / f"{SEEDS[asked.half]}_{code}"
    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / f"{number:04d}.json" for number in range(asked.cases)]
    missing = [(number, file) for number, file in enumerate(files) if not file.exists()]
    done = Parallel(n_jobs=asked.processes, return_as="generator_unordered", batch_size=1)(
        delayed(stored)(asked.half, number, file) for number, file in missing
    )
    for line in done:
        print(line, flush=True)
    rows = [json.loads(file.read_text(encoding="utf-8")) for file in files]
    made = f"seed {SEEDS[asked.half]}, code {code}, {datetime.now(UTC):%Y-%m-%d}"
    head = f"{asked.half}, {asked.cases} cases, {made}"
    text = table(rows, head)
    (asked.folder / f"{asked.half}.md").write_text(text, encoding="utf-8")
    print(text)
    if asked.write is not None:
        written = write(asked.half, text, asked.write)
        if asked.commit:
            _git(asked.write, "add", *written)
            _git(asked.write, "commit", "-m", f"Mechanisms in no catalogue: {head}", "--", *written)


def _git(project: Path, *words: str) -> None:
    subprocess.run(["git", "-C", str(project), *words], check=True)


def write(half: str, text: str, project: Path) -> list[str]:
    """Put the table into ``benchmarks/results`` and its scores between two marks of the page; return both."""
    written = [f"benchmarks/results/unnamed_{half}.md", PAGE_OF_HALF[half]]
    result, page = (project / name for name in written)
    result.write_text(text, encoding="utf-8")
    mark, end = f"<!-- unnamed {half}, from concealed.unnamed -->", "<!-- end -->"
    before, after = page.read_text(encoding="utf-8").split(mark)
    scores = text.split("\n\n| case ")[0]
    page.write_text(f"{before}{mark}\n\n{scores}\n\n{end}{after.split(end, 1)[1]}", encoding="utf-8")
    return written


if __name__ == "__main__":
    main()
