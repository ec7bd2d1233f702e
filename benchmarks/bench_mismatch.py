"""Time and memory of `explain_mismatch` for 10,000, 100,000 and 1,000,000 samples (50 Hz).

Run: python benchmarks/bench_mismatch.py [samples ...]
"""

from __future__ import annotations

import resource
import sys
import time

import numpy as np
import pandas as pd

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch import explain_mismatch

COEFFICIENTS = {
    "FNOMIN": 4000.0,
    "UNLOADED_RADIUS": 0.32,
    "LONGVL": 16.7,
    "PCY1": 1.35,
    "PDY1": 1.02,
    "PDY2": -0.1,
    "PEY1": -1.2,
    "PKY1": 22.0,
    "PKY2": 2.1,
}


def recording(tire: TireModel, n: int) -> pd.DataFrame:
    """Sweeps at four loads and three pressures; friction falls with pressure."""
    rng = np.random.default_rng(0)
    t = np.arange(n) / 50.0
    alpha = 0.16 * np.sin(2.0 * np.pi * t / 7.0)
    load = np.array([3000.0, 5500.0, 1800.0, 4200.0])[(t // 14.0).astype(int) % 4]
    pressure = np.array([2.2e5, 2.2e5, 1.8e5, 2.6e5])[(t // 56.0).astype(int) % 4]
    m = 1.0 - 0.3 * (pressure / 2.2e5 - 1.0)
    fy = tire.forces(slip_angle=alpha / m, normal_load=load).fy * m
    return pd.DataFrame(
        {
            "time": t,
            "slip_angle": alpha + 1e-4 * rng.standard_normal(n),
            "normal_load": load + 8.0 * rng.standard_normal(n),
            "speed": 16.7 + 0.02 * rng.standard_normal(n),
            "pressure": pressure + 300.0 * rng.standard_normal(n),
            "fy": fy + 25.0 * rng.standard_normal(n),
        }
    )


def main() -> None:
    tire = TireModel.from_coefficients(COEFFICIENTS, version="5.2")
    explain_mismatch(tire, recording(tire, 3000))
    for n in [int(a) for a in sys.argv[1:]] or [10_000, 100_000, 1_000_000]:
        data = recording(tire, n)
        start, cpu = time.perf_counter(), time.process_time()
        report = explain_mismatch(tire, data)
        wall, cpu = time.perf_counter() - start, time.process_time() - cpu
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
        names = [e.name for e in report.effects]
        print(f"{n:>9,} samples: {wall:6.1f} s wall, {cpu:6.1f} s CPU, peak {memory:.2f} GiB, {names}")


if __name__ == "__main__":
    main()
