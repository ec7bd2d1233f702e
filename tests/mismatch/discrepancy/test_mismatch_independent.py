"""How many samples count: those of a run are alike, those of a test plan were measured by themselves."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.mismatch.discrepancy.independent import measured_apart
from tire_pipeline.mismatch.recording.prepare import prepare


def apart(tire, recording):
    return measured_apart(prepare(tire, recording).data)


def plan(tire):
    """Steady points: nine slip angles at three loads."""
    slip, load = (x.ravel() for x in np.meshgrid(np.radians(np.arange(-12.0, 13.0, 3.0)), [2e3, 4e3, 6e3]))
    force = tire.forces(slip_angle=slip, normal_load=load).fy
    noise = 30.0 * np.random.default_rng(0).standard_normal(slip.size)
    return pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": force + noise})


@pytest.mark.parametrize("sorted_by", [None, "slip_angle", "fy"])
def test_a_run_without_time_is_no_test_plan_in_whatever_order_its_rows_come(tire, record, sorted_by):
    """Rows in another order counted sixteen times as much, and gave a wrong cause with 1.0."""
    run = record().drop(columns=["time", "pressure"])
    mixed = run.sample(frac=1.0, random_state=1) if sorted_by is None else run.sort_values(sorted_by)
    assert apart(tire, run) < 0.05
    assert apart(tire, mixed.reset_index(drop=True)) == apart(tire, run)


@pytest.mark.parametrize("seed", range(3))
def test_points_of_a_test_plan_are_apart_in_whatever_order(tire, seed):
    assert apart(tire, plan(tire).sample(frac=1.0, random_state=seed).reset_index(drop=True)) == 1.0


def test_points_that_were_measured_twice_are_not(tire):
    once = plan(tire)
    assert apart(tire, pd.concat([once, once.iloc[:9]], ignore_index=True)) == pytest.approx(18 / 36)


def test_a_recording_with_time_has_no_points(tire, record):
    assert apart(tire, record()) == 0.0
