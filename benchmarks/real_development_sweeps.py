"""Write the list of real sweeps that thresholds may be set with: benchmarks/real_development_sweeps.py > FILE

FILE is src/tire_pipeline/concealed/real/development.csv. The rule was fixed before any case was made:

- calspan: the sweeps at about 2.2 and 0.5 kN, and the second ones at 2.7 kN (zero camber). Left for sealed
  cases: the first ones at 2.7 kN (all of them at 2 deg), at 1.6 and at 1.1 kN.
- dart: the ramps at a steering of 0.25 and -0.25, 0.15 and -0.15; the free drive and the second session,
  which the issues and tests speak of. Left: 0.2 and -0.2, 0.3 and -0.3.
- tydex: two of five points.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

from tire_pipeline.concealed.real.sources import SOURCES, Sweep, sweeps

RECORDINGS = Path(__file__).resolve().parents[2] / "shared" / "recordings"


def chosen(source: str) -> list[Sweep]:
    """Sweeps of one source that are for development."""
    found = sweeps(RECORDINGS, source)
    if source == "tydex":
        return [s for number, s in enumerate(found) if number % 5 in (0, 2)]
    if source == "dart":
        return [s for s in found if "rubber" not in s.name or "025" in s.name or "015" in s.name]
    out = []
    for number, s in enumerate(found):
        level = [o for o in found[:number] if (o.camber, o.pressure) == (s.camber, s.pressure)]
        again = any(abs(o.load / s.load - 1.0) < 0.05 for o in level)
        if again or min(abs(s.load / load - 1.0) for load in (525.0, 2190.0)) < 0.05:
            out.append(s)
    return out


def main() -> None:
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["source", "sweep", "sha256"])
    for source in SOURCES:
        writer.writerows([source, s.name, s.sha256] for s in chosen(source))


if __name__ == "__main__":
    main()
