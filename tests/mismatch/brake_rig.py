"""Brake ramps at some slip angles, against a file that has no combined slip."""

from __future__ import annotations

import numpy as np
import pandas as pd


def weighted(file, rbx2=9.0):
    """The tire as it is: the file's, with the weighting of combined slip."""
    return file.replace(RBX1=12.0, RBX2=rbx2, RCX1=1.0, RBY1=13.0, RBY2=9.0, RCY1=1.0)


def brake_sweeps(true, degrees, seed=0):
    """Brake ramps at some slip angles, four loads each; the tread warms while it brakes."""
    rng = np.random.default_rng(seed)
    t = np.arange(0.0, 96.0, 0.05)
    steps = (t // 12.0).astype(int)
    inputs = {
        "slip_angle": np.radians(np.array(degrees)[steps % len(degrees)]) + rng.normal(0.0, 2e-4, t.size),
        "slip_ratio": -0.06 * (1.0 - np.cos(2.0 * np.pi * t / 4.0)),
        "normal_load": np.array([2000.0, 4000.0, 6000.0, 3000.0])[steps // 2] + rng.normal(0.0, 8.0, t.size),
    }
    forces = true.forces(**inputs)
    return pd.DataFrame(
        {
            "time": t,
            **inputs,
            "speed": 16.7 + rng.normal(0.0, 0.02, t.size),
            "tread_temperature": 50.0 + 8.0 * np.sin(t / 30.0) + rng.normal(0.0, 0.2, t.size),
            "fx": forces.fx + rng.normal(0.0, 20.0, t.size),
            "fy": forces.fy + rng.normal(0.0, 20.0, t.size),
        }
    )
