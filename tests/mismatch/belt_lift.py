"""An effect from outside of the package, as a stranger would write it."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.mismatch.effects import Effect, Parameter


class BeltLift(Effect):
    """The belt takes some of the load away, with the square of the speed: made up, in a stranger's file."""

    name = "belt_lift"
    title = "a belt that lifts with speed"
    equation = "normal load *= 1 - lift (v / 20 m/s)^2"
    source = "made up for this test"
    channels = ("speed",)
    family = "speed"
    parameters = (Parameter("lift", "1", -0.5, 0.5, 0.01, prior=0.1),)
    order = 20

    def inputs(self, state, data, p):
        """Take some of the load away."""
        state.normal_load = state.normal_load * (1.0 - p["lift"] * (data.get("speed") / 20.0) ** 2)


def lifted_sweeps(tire, seed):
    """Sweeps of the slip angle at four loads and three speeds, of a belt that lifts."""
    t = np.arange(0.0, 180.0, 0.05)
    sweep = (t // 15.0).astype(int)
    slip_angle = 0.18 * np.sin(2.0 * np.pi * t / 7.5)
    load = np.array([3000.0, 5500.0, 1800.0, 4200.0])[sweep % 4]
    speed = np.array([8.0, 16.0, 28.0])[sweep // 4]
    lifted = load * (1.0 - 0.12 * (speed / 20.0) ** 2)
    fy = tire.forces(slip_angle=slip_angle, normal_load=lifted).fy
    noise = np.random.default_rng(seed).normal(0.0, 15.0, t.size)
    channels = {"time": t, "slip_angle": slip_angle, "normal_load": load, "speed": speed, "fy": fy + noise}
    return pd.DataFrame(channels)
