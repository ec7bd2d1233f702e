"""What check_recording finds, and where."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.recordings import check_recording


def good(count=400):
    t = np.arange(count) * 0.01
    return pd.DataFrame(
        {
            "time": t,
            "slip_angle": 0.1 * np.sin(t),
            "normal_load": 3000.0,
            "fy": -2000 * np.sin(t),
        }
    )


def test_nothing_wrong():
    assert check_recording(good()) == []


def cut(frame, **columns):
    for name, (rows, value) in columns.items():
        frame.loc[rows, name] = value
    return frame


@pytest.mark.parametrize(
    ("frame", "name", "severity", "rows"),
    [
        (good().drop(columns="fy"), "no_force_channel", "error", ()),
        (good().drop(columns="normal_load"), "no_normal_load", "error", ()),
        (good().drop(columns="slip_angle"), "no_slip_channel", "error", ()),
        (good(29), "few_samples", "error", ()),
        (good(11).drop(columns="time"), "few_samples", "error", ()),
        (cut(good(), time=(200, 1.985)), "time_runs_backwards", "error", ((200, 200),)),
        (cut(good(), time=(7, np.nan)), "time_not_finite", "warning", ((7, 7),)),
        (cut(good(), time=(7, 0.06)), "repeated_time_stamps", "error", ((7, 7),)),
        (good().drop(index=range(100, 150)), "gaps_in_time", "warning", ((100, 100),)),
        (cut(good(), fy=(slice(20, 49), np.nan)), "missing_block", "warning", ((20, 49),)),
        (good().assign(fx=np.nan), "empty_channel", "warning", ()),
        (good().assign(slip_angle=lambda d: d.slip_angle * 57.3), "angle_in_degrees", "error", ()),
        (good().assign(normal_load=-3000.0), "no_positive_load", "error", ()),
    ],
)
def test_each_fault_is_found_where_it_is(frame, name, severity, rows):
    issues = check_recording(frame)
    assert [i.name for i in issues] == [name]
    assert issues[0].severity == severity
    assert issues[0].rows == rows
    assert issues[0].advice in str(issues[0])


@pytest.mark.parametrize("channel", ["time", "normal_load", "fy"])
def test_two_columns_of_one_channel_are_named(channel):
    frame = good()
    issues = check_recording(pd.concat([frame, frame[channel]], axis=1))
    assert [(i.name, i.severity, i.where) for i in issues] == [("repeated_channel", "error", channel)]


def test_two_columns_of_a_name_that_is_no_channel_do_no_harm():
    frame = good().assign(remark=1.0)
    assert check_recording(pd.concat([frame, frame["remark"]], axis=1)) == []


def test_steady_points_may_be_few():
    assert check_recording(good(12).drop(columns="time")) == []


@pytest.mark.parametrize("channel", ["normal_load", "slip_angle", "fy"])
def test_a_channel_without_a_number_is_missing(channel):
    issues = check_recording(good().assign(**{channel: np.nan}))
    assert [i.severity for i in issues] == ["error", "warning"]
    assert issues[0].name.startswith("no_")


def test_errors_come_first():
    frame = good().drop(columns="normal_load").drop(index=range(100, 150))
    assert [i.severity for i in check_recording(frame)] == ["error", "warning"]


def test_a_few_missing_values_are_no_issue():
    assert check_recording(cut(good(), fy=([5, 9, 30], np.nan))) == []
