"""How often the screen loses what a recording holds: no right answer is among the sets that are fitted.

python benchmarks/screen_loss.py           # the tuning cases of calibrate_mismatch; goes on where it stopped
python benchmarks/screen_loss.py --write   # and writes benchmarks/results/screen_loss.csv

A right answer is the set that a case holds, or one that is as right: effects below the formula's misfit may
be left out, and what a recording cannot tell apart may stand in each other's place. The empty set is always
fitted, so cases with nothing that has to be named are left out. So are triples: they are built on fits.
Beside the screen stands its baseline, as many effects drawn at random. Of those lost, some would have no
mass if they were fitted: ``lost_with_mass`` counts the others.
"""

from __future__ import annotations

import argparse
import json
import warnings
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pandas as pd
import yaml
from joblib import Parallel, delayed
from scipy.stats import binomtest

from tire_pipeline.calibration.cases import plans
from tire_pipeline.code_hash import code_hash
from tire_pipeline.errors import TirePipelineError
from tire_pipeline.mismatch.inference.analysis import analyse
from tire_pipeline.mismatch.inference.evidence.hypotheses import hypotheses, log_posterior
from tire_pipeline.mismatch.inference.learnt.sizes import learnt
from tire_pipeline.mismatch.inference.sets.enumerate import enumerate_sets, screened_recording, sets_to_fit
from tire_pipeline.mismatch.inference.sets.screen import EFFECTS_KEPT
from tire_pipeline.mismatch.inference.thinning import thinned
from tire_pipeline.mismatch.recording.prepare import prepare

ROOT = Path(__file__).resolve().parents[1]
TABLE = ROOT / "benchmarks" / "results" / "screen_loss.csv"
MASS = 0.05
"""Probability of a right answer, were it fitted, from which losing it changes what is said."""
ROWS = ROOT / "data" / "09_benchmarks" / "screen_loss"
PARAMETERS = ROOT / "conf" / "base" / "parameters" / "calibrate_mismatch.yml"


def seen(make) -> dict[str, object]:
    """Say of one case whether a right answer is fitted, and how likely that was by chance."""
    try:
        known = make()
        prepared = prepare(known.tire, known.recording)
    except TirePipelineError:
        return {"left_out": "cannot be made"}
    right = [tuple(sorted(names)) for names in known.right]
    if prepared.stopped or () in right or not right:
        return {"left_out": prepared.stopped or "nothing has to be named"}
    if min(map(len, right)) > 2:
        return {"left_out": "three effects"}
    analysis = analyse(thinned(prepared.data))
    looked = screened_recording(analysis, learnt())
    if not set(known.truth) <= set(looked.found.forms):
        return {"left_out": "the recording has no channel for it"}
    singles, pairs = sets_to_fit(looked.found, looked.guess.unknown.expected)
    fitted = {*((name,) for name in singles), *pairs}
    effects = len(looked.found.forms)
    single = [names for names in right if len(names) == 1]
    chance = 1.0 - (1.0 - min(EFFECTS_KEPT / effects, 1.0)) ** len(single) if single else None
    kept = bool(fitted & set(right)) or in_place_of_another(analysis, right)
    mass = None if kept else mass_if_fitted(analysis, known.truth, right)
    return {
        "source": known.source,
        "truth": list(known.truth),
        "kept": kept,
        "mass": mass,
        "chance": chance,
    }


def in_place_of_another(analysis, right) -> bool:
    """Return whether a right answer is fitted because it looks like what is likeliest."""
    return not set(right).isdisjoint(each.names for each in enumerate_sets(analysis, learnt()).sets)


def mass_if_fitted(analysis, truth, right) -> float:
    """Return the probability of the right answers where the true set is fitted in any case."""
    case = enumerate_sets(analysis, learnt(), [tuple(truth)]).case
    probability = np.exp(log_posterior(case, learnt()))
    return float(sum(p for p, h in zip(probability, hypotheses(case), strict=True) if h.names in right))


def rows(processes: int) -> list[dict[str, object]]:
    """Look at all cases that no earlier run has looked at."""
    settings = yaml.safe_load(PARAMETERS.read_text())["calibrate_mismatch"]
    kinds = [settings[name] for name in ("real", "first", "second", "unnamed")]
    folder = ROWS / code_hash("mismatch", "calibration", "concealed", "magic_formula")
    folder.mkdir(parents=True, exist_ok=True)

    def one(name: str, make) -> dict[str, object]:
        file = folder / f"{name}.json"
        if not file.exists():
            warnings.simplefilter("ignore")
            said = json.dumps(seen(make))
            file.with_suffix(".part").write_text(said)
            file.with_suffix(".part").rename(file)
        return {"case": name, **json.loads(file.read_text())}

    made = plans((ROOT / settings["recordings"]).resolve(), *kinds)
    return Parallel(n_jobs=processes, batch_size=1)(delayed(one)(name, make) for name, make in made)


def table(found: pd.DataFrame) -> pd.DataFrame:
    """Count what is lost by source, and in all, with the upper end of a 95% interval."""
    asked = found[found["source"].notna()]
    out = []
    for source, of in [*asked.groupby("source"), ("all", asked)]:
        lost = int((~of["kept"].astype(bool)).sum())
        high = binomtest(lost, len(of)).proportion_ci(0.95, method="wilson").high
        by_chance = 1.0 - of["chance"].astype(float).mean()
        out.append(
            {
                "source": source,
                "cases": len(of),
                "lost": lost,
                "lost_with_mass": int((of["mass"].astype(float) > MASS).sum()),
                "share": round(lost / len(of), 4),
                "at_most": round(float(high), 4),
                "share_of_singles_at_random": round(float(by_chance), 3),
            }
        )
    return pd.DataFrame(out).assign(
        date=datetime.now(UTC).date().isoformat(), code=code_hash("mismatch", "magic_formula", "tir")
    )


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    found = pd.DataFrame(rows(asked.processes))
    said = table(found)
    print(said.to_string(index=False))
    lost = found[found["kept"].eq(False)]
    print(lost[["case", "truth"]].to_string(index=False) if len(lost) else "nothing is lost")
    if asked.write:
        said.to_csv(TABLE, index=False)
        print(f"written: {TABLE}")


if __name__ == "__main__":
    main()
