"""Recordings at three cambers that are read in other axes than they were recorded in."""

from __future__ import annotations

import numpy as np
import pandas as pd

TURNED = (
    ("slip_angle", "fy"),
    ("fy",),
    ("camber",),
    ("slip_angle",),
    ("camber", "fy"),
    ("slip_angle", "camber"),
)
"""Channels that have the other sign."""


def leaning(tire):
    """A model with camber thrust and ply steer."""
    return tire.replace(PVY3=0.35, PHY1=0.004, PVY4=-0.1)


def cambered(tire, seed):
    """What this model records at three cambers."""
    rng = np.random.default_rng(seed)
    t = np.arange(0.0, 90.0, 0.02)
    slip = 0.15 * np.sin(2.0 * np.pi * t / 7.5)
    camber = np.radians([0.0, 3.0, -2.0])[(t // 30.0).astype(int)]
    load = np.array([2500.0, 5000.0])[(t // 15.0).astype(int) % 2]
    fy = leaning(tire).forces(slip_angle=slip, camber=camber, normal_load=load).fy
    frame = pd.DataFrame({"time": t, "slip_angle": slip, "camber": camber, "normal_load": load})
    return frame.assign(fy=fy + 20.0 * rng.standard_normal(t.size))


def misread(recording, turned, gain):
    """The recording in other axes, and with a force of another size."""
    wrong = recording.assign(fy=gain * recording["fy"])
    return wrong.assign(**{n: -wrong[n] for n in turned})
