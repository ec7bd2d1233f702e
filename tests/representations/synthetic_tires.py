"""A small synthetic tire table: plausible lateral coefficients, category shifts, no fleet needed."""

from __future__ import annotations

import numpy as np
import pandas as pd

CENTRES = {
    "PCY1": 1.35, "PDY1": 1.02, "PDY2": -0.16, "PEY1": -0.6, "PEY2": -0.15, "PEY3": 0.05,
    "PKY1": -21.0, "PKY2": 2.1, "PHY1": 0.002, "PHY2": 0.001, "PVY1": 0.02, "PVY2": -0.01,
    "PDY3": -1.2, "PEY4": -4.0, "PKY3": 0.4, "PHY3": 0.03, "PVY3": -0.3, "PVY4": -0.2,
}  # fmt: skip
SPREADS = {
    "PCY1": 0.06, "PDY1": 0.05, "PDY2": 0.03, "PEY1": 0.35, "PEY2": 0.08, "PEY3": 0.03,
    "PKY1": 3.0, "PKY2": 0.25, "PHY1": 0.001, "PHY2": 0.0008, "PVY1": 0.015, "PVY2": 0.01,
    "PDY3": 0.3, "PEY4": 1.0, "PKY3": 0.1, "PHY3": 0.01, "PVY3": 0.1, "PVY4": 0.1,
}  # fmt: skip


def synthetic_table(n: int = 300, categories: str = "ABC", seed: int = 0) -> pd.DataFrame:
    rng = np.random.default_rng(seed)
    label = rng.integers(0, len(categories), n)
    shift = np.random.default_rng(99).normal(size=(len(categories), len(CENTRES)))
    table = {}
    for index, name in enumerate(CENTRES):
        noise = rng.normal(size=n) * 0.6
        table[name] = CENTRES[name] + SPREADS[name] * (shift[label, index] + noise)
    frame = pd.DataFrame(table)
    frame["PEY1"] = frame["PEY1"].clip(upper=0.5)
    frame.insert(0, "file", [f"{i}.tir" for i in range(n)])
    frame.insert(1, "category", np.array(list(categories))[label])
    frame["FNOMIN"] = 6000.0
    frame["tire_id"] = [f"t{i // 3}" for i in range(n)]
    return frame
