"""Seconds of the first Jacobian and fit after an installation, with the derivatives' code there or not.

The code of the derivatives is written when it is first asked for, and numba compiles it then. Each round
starts two processes with an empty cache of numba: one has to write the code, the other finds it there. The
ratio of their processor times is what writing costs; it may be at most 1.1.

Run: python benchmarks/bench_first_use.py [--rounds 3]
"""

from __future__ import annotations

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

VERSIONS = ("5.2", "6.1")
GOAL = 1.1

FIRST_USE = """
import numpy as np, pandas as pd
from tire_pipeline.magic_formula import TireModel, fit_magic_formula
known = {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}
tire = TireModel.from_coefficients(known, version)
angle, load = (each.ravel() for each in np.meshgrid(np.linspace(-0.2, 0.2, 41), [2000.0, 4000.0, 6000.0]))
points = pd.DataFrame({"slip_angle": angle, "normal_load": load})
points["fy"] = tire.forces(slip_angle=angle, normal_load=load, outputs=["fy"]).fy
tire.jacobian(["PDY1", "PKY1"], slip_angle=np.resize(angle, 10_000), normal_load=3000.0)
fit_magic_formula(points, version, starts=1)
"""


def seconds(version: str, cache: Path) -> float:
    """Processor time of a fresh process that uses the derivatives for the first time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    code = f"version = {version!r}\n{FIRST_USE}"
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(cache)}
    subprocess.run([sys.executable, "-c", code], check=True, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def written_and_found(version: str) -> tuple[float, float]:
    """Seconds without the code of the derivatives, and with it."""
    with tempfile.TemporaryDirectory() as empty, tempfile.TemporaryDirectory() as with_code:
        without = seconds(version, Path(empty))
        written = list(Path(empty).rglob("gradients_*.py"))
        assert written, "no code was written: the first process did not use the derivatives"
        for path in written:
            place = Path(with_code) / path.relative_to(empty)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, place)
        return without, seconds(version, Path(with_code))


def least(version: str, rounds: int) -> tuple[float, float]:
    """Least seconds of some rounds, without the code and with it."""
    times = [written_and_found(version) for _ in range(rounds)]
    without, found = (min(each) for each in zip(*times, strict=True))
    return without, found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    rounds = parser.parse_args().rounds
    print("version   code written   code there   ratio   (s of the processor, the least)")
    for version in VERSIONS:
        without, found = least(version, rounds)
        ratio = without / found
        more = "" if ratio <= GOAL else f"   more than {GOAL}"
        print(f"{version:<10}{without:>12.2f}{found:>13.2f}{ratio:>8.3f}{more}", flush=True)


if __name__ == "__main__":
    main()
