"""How long imports take in a fresh Python: seconds of processor time, the least of several."""

from __future__ import annotations

import argparse
import subprocess
import sys

FOLDERS = ("magic_formula", "tir", "recordings", "mismatch", "translation", "command.cli")
GOAL = 0.7


def seconds(folder: str) -> float:
    """Processor time of importing one folder, the start of Python left out."""
    code = (
        "import time\nstart = time.process_time()\n"
        f"import tire_pipeline.{folder}\nprint(time.process_time() - start)"
    )
    return float(
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=5)
    times = parser.parse_args().times
    for folder in FOLDERS:
        least = min(seconds(folder) for _ in range(times + 1))
        print(
            f"import tire_pipeline.{folder}: {least:.2f} s{'' if least < GOAL else f', more than {GOAL} s'}"
        )


if __name__ == "__main__":
    main()
