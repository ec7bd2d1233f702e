"""Values that stand out from their neighbours: spikes and dropouts of a channel, and what is none."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.recordings import check_recording
from tire_pipeline.recordings.spikes import LONGEST_SPIKE, said_of_spikes, spikes, without_spikes

TIME = np.arange(0.0, 60.0, 0.02)


def sweep(noise=20.0, seed=0):
    force = 4000.0 * np.tanh(2.0 * np.sin(0.5 * TIME))
    return force + noise * np.random.default_rng(seed).standard_normal(TIME.size)


@pytest.mark.parametrize("size", [-2e4, 5e3, 1e6])
@pytest.mark.parametrize("length", range(1, LONGEST_SPIKE + 1))
@pytest.mark.parametrize("row", [3, 700, 1571, TIME.size - 6])
def test_a_spike_is_found_and_nothing_else(size, length, row):
    x = sweep()
    x[row : row + length] += size
    assert np.flatnonzero(spikes(x)).tolist() == list(range(row, row + length))


@pytest.mark.parametrize("name", ["", "slip_angle"])
@pytest.mark.parametrize("share", [0.01, 0.05])
def test_a_line_that_drops_out_to_one_value_is_found_in_a_fast_sweep(share, name):
    """20 samples a second of a slip that sweeps 10 deg in 3 s: a zero is hardly farther off than it moves."""
    rng = np.random.default_rng(1)
    slip = np.radians(10.0) * np.sin(0.5 * np.arange(0.0, 60.0, 0.05)) + 1e-4 * rng.standard_normal(1200)
    lost = (rng.random(slip.size) < share) & (np.abs(slip) > np.radians(4.0))
    assert np.array_equal(spikes(np.where(lost, 0.0, slip), name), lost)


@pytest.mark.parametrize("row", [0, TIME.size - 1])
def test_the_first_and_the_last_sample_have_neighbours_on_one_side(row):
    x = sweep()
    x[row] = 1e5
    assert np.flatnonzero(spikes(x)).tolist() == [row]


@pytest.mark.parametrize("length", [2, 10, 400])
def test_a_dropout_of_any_length_counts_once(length):
    """A line that drops out gives one value until it comes back."""
    x = sweep()
    x[700 : 700 + length] = -12_000.0
    assert np.flatnonzero(spikes(x)).tolist() == list(range(700, 700 + length))


@pytest.mark.parametrize(
    "x",
    [
        pytest.param(sweep(0.0), id="without noise"),
        pytest.param(sweep(300.0), id="much noise"),
        pytest.param(np.round(sweep(), -2), id="coarse steps"),
        pytest.param(np.clip(sweep(), -2500.0, 2500.0), id="clipped"),
        pytest.param(np.where((TIME > 20.0) & (TIME < 40.0), sweep()[1000], sweep()), id="stuck"),
        pytest.param(np.repeat(np.random.default_rng(1).choice([0.0, 4e3], 60), 50), id="steps of an input"),
        pytest.param(2.2e5 + 690.0 * (np.random.default_rng(2).random(3000) > 0.999), id="last digit"),
        pytest.param(np.random.default_rng(3).standard_t(5.0, 3000), id="long tails"),
        pytest.param(np.tile(np.radians(np.arange(-12.0, 13.0)), 5), id="a test plan"),
        pytest.param(np.full(100, 4e3), id="constant"),
        pytest.param(np.array([1.0, 2.0, 1e6]), id="three values"),
        pytest.param(np.full(100, np.nan), id="no number"),
    ],
)
def test_what_a_channel_does_by_itself_is_no_spike(x):
    assert not spikes(x).any()


@pytest.mark.parametrize("angles", [(4.0,), (-4.0, -2.0, 2.0, 4.0), (3.0, 3.0, 3.0, 3.0, -3.0)])
def test_set_points_beside_sweeps_are_no_spikes(angles):
    """A part of each held angle, joined to sweeps without the ramps between: 38% of a file was left out."""
    steps = np.radians(np.r_[0.0:12.0:0.08, 12.0:-12.0:-0.08, -12.0:0.01:0.08])
    held = [part for angle in angles for part in (np.zeros(5), np.full(400, np.radians(angle)))]
    assert not spikes(np.concatenate([np.tile(steps, 3), *held]), "slip_angle").any()


def test_a_spike_of_what_a_rig_sets_is_still_found():
    slip = np.radians(10.0) * np.sin(0.5 * TIME)
    slip[[300, 1500, 1501]] = 0.9, -1.2, -1.2
    assert np.flatnonzero(spikes(slip, "slip_angle")).tolist() == [300, 1500, 1501]


def test_missing_values_stay_missing_and_hide_no_spike():
    x = sweep()
    x[690:700], x[705] = np.nan, 1e5
    assert np.flatnonzero(spikes(x)).tolist() == [705]


def test_a_table_is_left_as_it_is_and_says_what_was_left_out():
    table = pd.DataFrame({"time": TIME, "fy": sweep(), "camber": 0.0})
    assert without_spikes(table, ("fy", "camber", "fx"))[0] is table
    table.loc[[40, 800], "fy"] = 9e4, -3e5
    before = table.copy()
    without, remarks = without_spikes(table, ("fy", "camber", "fx"))
    pd.testing.assert_frame_equal(table, before)
    assert np.flatnonzero(without["fy"].isna()).tolist() == [40, 800]
    assert remarks == [
        "fy: 2 values from row 40 on stand out from their neighbours, up to -300,000 (left out)"
    ]


def test_one_spike_is_said_with_its_value_and_row():
    x = np.arange(5.0)
    assert said_of_spikes("fy", x, x == 3.0) == "fy: 3 in row 3 stands out from its neighbours"


def test_the_check_of_a_recording_names_them():
    table = pd.DataFrame({"time": TIME, "slip_angle": 0.1 * np.sin(0.5 * TIME), "fy": sweep()})
    table["normal_load"] = 4000.0 + 10.0 * np.random.default_rng(1).standard_normal(TIME.size)
    table.loc[1200, "normal_load"] = -3e4
    (found,) = [issue for issue in check_recording(table) if issue.name == "spikes"]
    assert (found.severity, found.rows) == ("warning", ((1200, 1200),))
    assert "normal_load: -30,000 in row 1200" in found.where
