"""Whether the file is of the tire that was recorded: what its state does is no other tire's."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.mismatch.recording.identity import figures
from tire_pipeline.mismatch.recording.prepare import prepare

DRAWS = range(2)


def warming_sweeps(tire, seed, per_degree, softer=0.0):
    """Two loads, a sweep each, in which the tread warms with the work done and loses grip, and stiffness."""
    rng = np.random.default_rng(seed)
    t = np.arange(0.0, 26.0, 0.02)
    slip = 0.17 * np.sin(2.0 * np.pi * t / 13.0)
    load = np.where(t < 13.0, 2750.0, 1100.0) + 40.0 * np.sin(t)
    past = np.maximum(np.abs(slip) - 0.02, 0.0)
    warmth = np.array([np.sum(past[: k + 1] * np.exp(-(t[k] - t[: k + 1]) / 2.0)) for k in range(t.size)])
    heat = warmth / warmth.max() * np.where(t < 13.0, 20.0, 10.0)
    grip, stiff = np.exp(-per_degree * (heat - 8.0)), np.exp(-softer * (heat - 8.0))
    force = grip * tire.forces(slip_angle=slip * stiff / grip, normal_load=load).fy
    return pd.DataFrame(
        {
            "time": t,
            "slip_angle": slip,
            "normal_load": load,
            "tread_temperature": 53.0 + heat + 0.2 * rng.standard_normal(t.size),
            "fy": force + 15.0 * rng.standard_normal(t.size),
        }
    )


@pytest.mark.parametrize(("per_degree", "softer"), [(0.008, 0.0), (0.01, -0.01), (-0.01, 0.0), (0.02, 0.0)])
def test_a_tread_that_warms_in_each_sweep_is_no_other_tire(tire, per_degree, softer):
    """Grip that goes while a sweep lasts bends the curve, and a sweep at each load heats it differently."""
    for seed in DRAWS:
        recording = warming_sweeps(tire, seed, per_degree, softer)
        found = figures(tire, {name: recording[name].to_numpy() for name in recording}, "fy")
        assert not found.off.any()
        assert prepare(tire, recording).question is None


def test_another_tire_whose_tread_warms_still_asks_for_the_file(tire):
    other = tire.replace(PDY1=0.8, PDY2=-0.3, PKY1=35.0, PKY2=1.2)
    stopped = [prepare(other, warming_sweeps(tire, seed, 0.006)).stopped for seed in DRAWS]
    assert stopped == ["another tire"] * len(DRAWS)
