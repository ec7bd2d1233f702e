"""What check_recording finds, and where."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.recordings import check_recording, read_recording
from tire_pipeline.tir import read_tir

EXAMPLE = Path(__file__).parents[2] / "examples" / "tire.tir"


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


def in_turn(frame, one, other):
    """Five rows without one channel, five without the other, and so on."""
    first = frame.index % 10 < 5
    return frame.assign(**{one: frame[one].mask(first), other: frame[other].mask(~first)})


def every_other(frame, one, other):
    """Each second row without one channel, the rest without the other: two loggers' clocks."""
    odd = frame.index % 2 == 1
    return frame.assign(**{one: frame[one].mask(odd), other: frame[other].mask(~odd)})


def in_kn():
    """Load and force in kN, without a word about it."""
    return good().assign(normal_load=3.0, fy=lambda d: d["fy"] / 1000.0)


def in_two_signs():
    sign = np.where(np.arange(400) < 250, 1.0, -1.0)
    return good().assign(normal_load=lambda d: sign * d.normal_load)


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
        (good().assign(time=lambda d: 1000.0 * d.time), "long_time_steps", "warning", ()),
        (good().assign(time=lambda d: 46_000.0 + d.time / 86_400.0), "short_time_steps", "warning", ()),
        (cut(good(), fy=(slice(20, 49), np.nan)), "missing_block", "warning", ((20, 49),)),
        (good().assign(fx=np.nan), "empty_channel", "warning", ()),
        (in_turn(good(), "fy", "slip_angle"), "few_whole_rows", "error", ()),
        (every_other(good(), "fy", "normal_load"), "never_together", "error", ()),
        (good().assign(slip_angle=lambda d: d.slip_angle * 57.3), "angle_in_degrees", "warning", ()),
        (good().assign(slip_ratio=lambda d: d.slip_angle * 100.0), "slip_in_percent", "warning", ()),
        (good().assign(normal_load=-3000.0), "negative_load", "warning", ()),
        (in_two_signs(), "load_of_both_signs", "warning", ()),
        (good().assign(normal_load=0.0), "no_positive_load", "error", ()),
        (good().assign(pressure=12e3), "implausible_value", "warning", ()),
        (good().assign(pressure=2e6), "implausible_value", "warning", ()),
        (good().assign(speed=200.0), "implausible_value", "warning", ()),
        (good().assign(tread_temperature=300.0), "implausible_value", "warning", ()),
        (good().assign(normal_load=3e6), "implausible_value", "warning", ()),
        (good().assign(effective_radius=3755.0), "implausible_value", "warning", ()),
        (good().assign(loaded_radius=0.0), "implausible_value", "warning", ()),
        (good().assign(normal_load=3.0), "implausible_friction", "warning", ()),
        (in_kn().assign(pressure=83e3), "small_load", "warning", ()),
        (in_kn().assign(loaded_radius=0.3), "small_load", "warning", ()),
        (good().assign(fy=7.0), "constant_force", "error", ()),
        (good().assign(fx=7.0), "constant_force", "warning", ()),
    ],
)
def test_each_fault_is_found_where_it_is(frame, name, severity, rows):
    issues = check_recording(frame)
    assert [i.name for i in issues] == [name]
    assert issues[0].severity == severity
    assert issues[0].rows == rows
    assert issues[0].advice in str(issues[0])


@pytest.mark.parametrize(
    ("channel", "value", "file_unit", "units"),
    [
        ("pressure", 250.0, None, ["kPa"]),
        ("pressure", 2.3, "", ["bar"]),
        ("pressure", 75.0, None, ["kPa", "psi"]),
        ("pressure", 12e3, "kPa", ["bar", "psi"]),
        ("speed", 160.0, None, ["km/h", "mph"]),
        ("tread_temperature", 320.0, None, ["K", "degF"]),
        ("normal_load", 3.0, None, ["kN"]),
        ("normal_load", 450.0, "N", ["kgf", "lbf"]),
        ("pressure", 0.0, None, []),
        ("loaded_radius", 305.0, None, ["mm"]),
        ("effective_radius", 31.0, "", ["mm", "cm", "in"]),
        ("effective_radius", 3755e3, "m", []),
    ],
)
def test_what_no_tire_has_is_named_with_the_units_that_it_may_be_in(channel, value, file_unit, units):
    frame = good().assign(**{channel: value})
    frame.attrs = {"file_units": {channel: file_unit}, "channels": {channel: "their name"}}
    (issue,) = check_recording(frame)
    assert channel in issue.where
    assert (" or ".join(units) or "no unit that is known") in issue.advice
    assert not units or f"--unit 'their name={units[0]}'," in issue.advice


def test_a_small_load_is_a_model_cars_unless_something_says_otherwise():
    assert check_recording(in_kn().assign(loaded_radius=0.023)) == []
    stated = in_kn()
    stated.attrs = {"file_units": {"normal_load": "N"}, "channels": {"normal_load": "FZ"}}
    assert check_recording(stated) == []
    stated.attrs["file_units"]["normal_load"] = None
    (issue,) = check_recording(stated)
    assert "no unit of the load is stated" in issue.where
    assert "the unit is likely" not in issue.advice
    assert "both are in N, which is to be stated then: --unit FZ=N" in issue.advice
    assert "or both are in kN: --unit FZ=kN --unit fy=kN" in issue.advice
    (issue,) = check_recording(stated.assign(pressure=2e5))
    assert "as it was read: both are in kN" in issue.advice
    assert check_recording(stated.assign(turn_slip=1.0)) == []


def test_a_file_of_kilonewtons_without_units_is_asked_about(tmp_path):
    table = in_kn().drop(columns="time").set_axis(["SA [deg]", "FZ", "FY"], axis=1)
    table["SA [deg]"] = np.degrees(table["SA [deg]"])
    table.to_csv(tmp_path / "kn.csv", index=False)
    assert "small_load" in [issue.name for issue in check_recording(read_recording(tmp_path / "kn.csv"))]
    named = read_recording(tmp_path / "kn.csv", units={"FZ": "kN", "FY": "kN"})
    assert "small_load" not in [issue.name for issue in check_recording(named)]


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


DAMAGED = {
    "as it was": lambda d: d,
    "steady points": lambda d: d.drop(columns="time"),
    "too few steady points": lambda d: d.drop(columns="time").head(11),
    "too few samples": lambda d: d.head(29),
    "no force": lambda d: d.drop(columns="fy"),
    "a moment alone": lambda d: d.rename(columns={"fy": "mz"}),
    "no load": lambda d: d.drop(columns="normal_load"),
    "no slip": lambda d: d.drop(columns=["slip_angle"]),
    "a load of nothing but NaN": lambda d: d.assign(normal_load=np.nan),
    "degrees": lambda d: d.assign(slip_angle=np.degrees(d["slip_angle"])),
    "camber in degrees": lambda d: d.assign(camber=3.0),
    "slip in percent": lambda d: d.assign(slip_ratio=100.0 * d["slip_angle"]),
    "one odd angle": lambda d: d.assign(slip_angle=d["slip_angle"].mask(d.index == 200, 2.0)),
    "a load below zero": lambda d: d.assign(normal_load=-d["normal_load"]),
    "a load of zero": lambda d: d.assign(normal_load=0.0),
    "the other sign": lambda d: d.assign(fy=-d["fy"]),
    "a force that stands": lambda d: d.assign(fy=7.0),
    "another force that stands": lambda d: d.assign(fx=7.0),
    "time from its end": lambda d: d.assign(time=d["time"].to_numpy()[::-1]),
    "time back across a hole": lambda d: d.assign(
        time=d["time"].mask(d.index == 200).mask(d.index == 201, 1.0)
    ),
    "time twice": lambda d: d.assign(time=d["time"].round(1)),
    "a few holes": lambda d: d.assign(fy=d["fy"].mask(d.index % 7 == 0)),
    "holes in every other row": lambda d: d.assign(fy=d["fy"].mask(d.index % 2 == 1)),
    "holes in every other steady point": lambda d: d.assign(fy=d["fy"].mask(d.index % 2 == 1)).drop(
        columns="time"
    ),
    "mostly holes": lambda d: d.assign(fy=d["fy"].where(d.index % 20 == 0)),
    "an empty channel": lambda d: d.assign(camber=np.nan),
    "a column twice": lambda d: pd.concat([d, d["fy"]], axis=1),
}


@pytest.mark.parametrize("damage", DAMAGED.values(), ids=DAMAGED)
def test_an_error_is_what_no_explanation_accepts(damage):
    tire = read_tir(EXAMPLE)
    frame = good()
    frame["fy"] = tire.forces(slip_angle=frame["slip_angle"], normal_load=frame["normal_load"]).fy
    frame = damage(frame)
    errors = [i for i in check_recording(frame) if i.severity == "error"]
    if errors:
        with pytest.raises(RecordingError):
            prepare(tire, frame)
    else:
        prepare(tire, frame)


def test_a_steady_angle_in_degrees_is_converted_once():
    tire = read_tir(EXAMPLE)
    frame = good().assign(camber=3.0)
    moved = tire.forces(**{n: frame[n] for n in ("slip_angle", "normal_load")}, camber=np.radians(3.0))
    prepared = prepare(tire, frame.assign(fy=moved.fy))
    assert [(f.name, f.channel) for f in prepared.findings] == [("unit_error", "camber")]
    assert prepared.data.get("camber") == pytest.approx(np.radians(3.0))


def test_dates_are_checked_in_seconds():
    n = 60
    moments = pd.Timestamp("2026-03-01 12:00") + pd.to_timedelta(np.arange(n) * 0.1, unit="s")
    table = pd.DataFrame({"slip_angle": 0.1 * np.sin(np.arange(n)), "normal_load": 4000.0})
    table["fy"] = -20000.0 * table["slip_angle"]
    by_date, by_number = table.assign(time=moments), table.assign(time=np.arange(n) * 0.1)
    assert [str(i) for i in check_recording(by_date)] == [str(i) for i in check_recording(by_number)]


def sparse(**every: int) -> pd.DataFrame:
    """A run in which some channels hold a number in each so-many-th row only."""
    frame = good().assign(mz=1.0, speed=10.0, camber=0.0)
    for channel, step in every.items():
        frame.loc[np.arange(len(frame)) % step != 0, channel] = np.nan
    return frame


@pytest.mark.parametrize("channel", ["normal_load", "slip_angle", "fy"])
def test_a_needed_column_that_is_mostly_empty_is_not_to_be_dropped(channel):
    issue = check_recording(sparse(**{channel: 20}))[0]
    assert issue.name == "few_whole_rows"
    assert f"{channel} is the emptiest column (20 numbers) and cannot be left out" in issue.advice
    assert "look at how it was read" in issue.advice
    assert "drop" not in issue.advice


def test_a_column_that_can_be_left_out_is_named():
    issue = check_recording(sparse(camber=20))[0]
    assert issue.advice == "drop camber, the emptiest column that can be left out (20 numbers)"


def with_moment(trail, seed=3):
    """Sweeps of slip angle at three loads, with an aligning moment of some trail, m."""
    rng = np.random.default_rng(seed)
    slip = 0.15 * np.sin(np.linspace(0.0, 12.0 * np.pi, 600))
    load = np.repeat([2000.0, 3500.0, 5000.0], 200)
    fy = -load * np.tanh(12.0 * slip)
    mz = -trail * fy * np.exp(-np.abs(slip) / 0.06)
    noise = rng.standard_normal((2, slip.size))
    return pd.DataFrame(
        {"slip_angle": slip, "normal_load": load, "fy": fy + 20.0 * noise[0], "mz": mz + noise[1]}
    )


def test_a_moment_that_turns_the_wheel_out_of_its_run_is_reported():
    names = {issue.name for issue in check_recording(with_moment(-0.03))}
    assert names == {"moment_of_other_sign"}


@pytest.mark.parametrize("trail", [0.03, 0.0])
def test_a_moment_with_a_trail_or_of_noise_is_not(trail):
    assert check_recording(with_moment(trail)) == []


def test_the_sign_of_a_moment_is_not_judged_by_brake_sweeps():
    frame = with_moment(-0.03).assign(slip_ratio=-0.1)
    assert check_recording(frame) == []


def leaning(sign=1.0, lean=lambda slip: np.repeat([0.0, 0.03], slip.size // 2), seed=4):
    """Sweeps of slip angle at two cambers in ISO W; with the sign -1 the camber is mirrored."""
    rng = np.random.default_rng(seed)
    slip = 0.15 * np.sin(np.linspace(0.0, 16.0 * np.pi, 800))
    camber, load = lean(slip), np.tile([3000.0, 4500.0], 400)
    fy = -load * (np.tanh(12.0 * slip) + camber) + 40.0 * rng.standard_normal(slip.size)
    return pd.DataFrame({"slip_angle": slip, "camber": sign * camber, "normal_load": load, "fy": fy})


def test_a_side_force_away_from_the_lean_is_reported():
    assert [issue.name for issue in check_recording(leaning(-1.0))] == ["camber_of_other_sign"]
    assert check_recording(leaning()) == []


def test_a_camber_that_goes_with_the_slip_angle_says_nothing():
    assert check_recording(leaning(-1.0, lean=lambda slip: 0.2 * slip)) == []


@pytest.mark.parametrize(("unit", "found"), [(1.0, set()), (np.pi / 180.0, {"implausible_stiffness"})])
def test_a_force_that_rises_faster_than_any_tires_is_reported(unit, found):
    """Radians in a column of degrees: nothing was said of a tire that slides at 0.2 deg."""
    frame = with_moment(0.03)
    frame["slip_angle"] *= unit
    assert {issue.name for issue in check_recording(frame)} == found


def test_a_noise_about_no_slip_is_no_stiffness():
    frame = with_moment(0.03)
    frame["slip_angle"] = np.random.default_rng(1).normal(0.0, 1e-4, len(frame))
    assert "implausible_stiffness" not in {issue.name for issue in check_recording(frame)}
