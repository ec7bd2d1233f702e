"""Combined slip that the file lacks: named where brake sweeps tell it, with its like where they don't."""

import numpy as np
import pandas as pd
import pytest
from weighed import named_sets

from tire_pipeline.mismatch import explain_mismatch

FORCES = ["fx", "fy"]


@pytest.fixture(scope="module")
def file(tire):
    """A file that has no weighting."""
    return tire.replace(PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, PKX3=0.2)


def weighted(file, rbx2=9.0):
    return file.replace(RBX1=12.0, RBX2=rbx2, RCX1=1.0, RBY1=13.0, RBY2=9.0, RCY1=1.0)


def errors(report, file, recording):
    """RMS error of each force before and after, N."""
    inputs = recording.drop(columns=FORCES)
    plain = file.forces(**{n: inputs[n].to_numpy() for n in ("slip_angle", "slip_ratio", "normal_load")})
    after = report.corrected.predict(inputs)
    return {o: (rms(recording[o] - getattr(plain, o)), rms(recording[o] - after[o])) for o in after}


def rms(x):
    return float(np.sqrt(np.mean(np.square(x))))


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


@pytest.mark.slow
@pytest.mark.parametrize("angles", [(0.0, 4.0), pytest.param((-3.0, 5.0), marks=pytest.mark.long)])
def test_at_two_slip_angles_combined_slip_is_named_and_other_angles_come_out_better(file, angles):
    report = explain_mismatch(file, brake_sweeps(weighted(file), angles))
    assert [names for names, _ in report.sets] == [("combined_slip",)]
    for before, after in errors(report, file, brake_sweeps(weighted(file), (2.0, 6.0), seed=7)).values():
        assert after < 0.5 * before


@pytest.mark.slow
@pytest.mark.parametrize(
    "missing",
    [[], pytest.param(["tread_temperature"], marks=pytest.mark.long), ["fx"], ["fy"]],
    ids=str,
)
def test_at_one_slip_angle_every_set_holds_combined_slip(file, missing):
    """It was not looked for where the slip angle stands still: a gain and crosstalk were named."""
    (names,) = named_sets(file, brake_sweeps(weighted(file), (4.0,)).drop(columns=missing))
    assert "combined_slip" in names


@pytest.mark.slow
def test_a_weighting_that_is_a_gain_at_one_slip_angle_is_named_with_the_gain(file):
    """Its share of Fx hardly changes with slip ratio here, which 0.5% of the evidence must not decide."""
    recording = brake_sweeps(weighted(file, rbx2=0.8), (4.0,)).drop(columns="fy")
    (names,) = named_sets(file, recording)
    assert {"combined_slip", "force_gain"} <= names
