"""Seconds to import each public package and to print the command line's help, each in a fresh process.

Processor time, as other programs may run meanwhile. The first run of each, which may compile, is not counted;
the least and the median of the others are given, and that of ``import numpy, pandas, numba``, which no change
of ours makes faster. Bytecode is kept even where ``PYTHONDONTWRITEBYTECODE`` is set.

Run: python benchmarks/bench_imports.py [--rounds 7]
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
from statistics import median

STATEMENTS = {
    "numpy, pandas, numba": ["-c", "import numpy, pandas, numba"],
    "tire_pipeline.magic_formula": ["-c", "import tire_pipeline.magic_formula"],
    "tire_pipeline.tir": ["-c", "import tire_pipeline.tir"],
    "tire_pipeline.recordings": ["-c", "import tire_pipeline.recordings"],
    "tire_pipeline.mismatch": ["-c", "import tire_pipeline.mismatch"],
    "tire_pipeline.translation": ["-c", "import tire_pipeline.translation"],
    "explain_mismatch": ["-c", "from tire_pipeline.mismatch import explain_mismatch"],
    "tire --help": ["-m", "tire_pipeline.command", "--help"],
    "tire explain --help": ["-m", "tire_pipeline.command", "explain", "--help"],
}

KEEPS_BYTECODE = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


def seconds(arguments: list[str]) -> float:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL, env=KEEPS_BYTECODE)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=7)
    rounds = parser.parse_args().rounds
    print(f"{'':<30}{'least':>8}{'median':>8}   (s of the processor, whole process; Python alone: 0.02)")
    for name, arguments in STATEMENTS.items():
        seconds(arguments)
        times = [seconds(arguments) for _ in range(rounds)]
        print(f"{name:<30}{min(times):>8.2f}{median(times):>8.2f}")


if __name__ == "__main__":
    main()
