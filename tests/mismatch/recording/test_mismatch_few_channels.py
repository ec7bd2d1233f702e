"""Channels beyond slip, load and a force may be missing: the report says what was not looked for."""

import itertools

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared
from weighed import all_but

from tire_pipeline.concealed import make_case
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.base import Effect
from tire_pipeline.mismatch.recording.given import usable_numbers
from tire_pipeline.mismatch.report.contents import VERDICTS
from tire_pipeline.recordings import DART_CAR, axle_recording, read_dart, read_recording

KNOWN = (
    "time",
    "slip_angle",
    "slip_ratio",
    "camber",
    "normal_load",
    "speed",
    "pressure",
    "tread_temperature",
    "turn_slip",
    "fx",
    "fy",
)


def simulated():
    case, _ = make_case(410006, "single")
    return case.tire, case.recording.iloc[:1000]


def calspan():
    whole = read_recording(shared("recordings/calspan") / "cornering_part.mat", axes="SAE")
    part = whole[(whole["pressure"] > 75e3) & (whole["camber"].abs() < 0.01)].iloc[::5]
    return _fitted(part), part.iloc[:600]


def tydex():
    points = read_recording(shared("recordings/tydex") / "DT_195_65R15_demo.tdx")
    return _fitted(points), points


def dart():
    (file,) = (shared("recordings/dart") / "free_driving").glob("*.csv")
    drive = axle_recording(read_dart(file), DART_CAR)
    return _fitted(drive), drive.iloc[::5]


def _fitted(recording):
    """The fit, with relaxation lengths as many files state them."""
    channels = [c for c in ("slip_angle", "camber", "normal_load", "fy") if c in recording]
    return fit_magic_formula(recording[channels]).model.replace(PTY1=1.5, PTY2=2.0)


SOURCES = {f.__name__: f for f in (simulated, calspan, tydex, dart)}


def enough(columns):
    """Whether there is a slip, the load and a force that this slip drives."""
    return "normal_load" in columns and any(
        {slip, force} <= columns for slip, force in (("slip_angle", "fy"), ("slip_ratio", "fx"))
    )


def check(tire, recording, dropped):
    rest = recording.drop(columns=list(dropped))
    report = explain_mismatch(tire, rest)
    assert report.verdict in VERDICTS
    assert set(report.fit) >= {"fx", "fy"} & set(rest.columns) - dead(rest)
    rows = {c["name"]: c for c in report.candidates}
    said = " ".join(report.notes)
    for effect in catalogue().values():
        lost = {*effect.channels, *effect.used, *(["time"] if effect.needs_time else [])} & set(dropped)
        if lost and type(effect).detect is Effect.detect:
            assert rows[effect.name]["gain"] is None, (effect.name, dropped)
            assert effect.title in said, (effect.name, dropped)
            assert any(n in rows[effect.name]["why"] for n in lost), (effect.name, dropped)
    predicted = report.corrected.predict(rest.drop(columns=[c for c in ("fx", "fy") if c in rest]))
    assert set(predicted) >= {"fx", "fy"} & set(rest.columns) - dead(rest)


def dead(recording):
    return {n for n in ("fx", "fy") if n in recording and np.ptp(recording[n]) == 0.0}


def subsets(recording, sizes):
    present = [c for c in KNOWN if c in recording]
    for size in sizes:
        for dropped in itertools.combinations(present, size):
            if enough(set(present) - set(dropped)):
                yield dropped


def test_a_relaxation_of_the_file_is_left_out_without_speed_and_that_is_said(tire, record):
    """It ended in a `KeyError: 'speed'`."""
    relaxed = tire.replace(PTY1=2.0, PTY2=2.0)
    recording = record(1)[["time", "slip_angle", "normal_load", "fy"]]
    report = explain_mismatch(relaxed, recording)
    assert any("relaxation" in n for n in report.notes)
    (row,) = [c for c in report.candidates if c["name"] == "relaxation_length"]
    assert "speed" in row["why"]
    assert np.isfinite(report.corrected.predict(recording.drop(columns="fy"))["fy"]).all()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("source", "most"),
    [
        ("tydex", 1),
        pytest.param("tydex", 2, marks=pytest.mark.ci),
        ("dart", 1),
        pytest.param("calspan", 1, marks=pytest.mark.long),
        pytest.param("dart", 2, marks=pytest.mark.long),
        pytest.param("simulated", 1, marks=pytest.mark.long),
    ],
)
def test_every_channel_and_every_pair_may_be_missing(source, most):
    """Pairs of the rig's and calspan's eight channels and more take minutes: they are in ``long``."""
    tire, recording = SOURCES[source]()
    for dropped in subsets(recording, range(most + 1)):
        check(tire, recording, dropped)


@pytest.mark.long
@pytest.mark.parametrize("source", SOURCES)
def test_all_channels_that_are_not_needed_may_be_missing(source):
    tire, recording = SOURCES[source]()
    for dropped in subsets(recording, range(2, len(KNOWN))):
        check(tire, recording, dropped)


@pytest.mark.parametrize("channel", ["camber", "pressure", "time"])
def test_a_column_without_any_number_is_a_channel_that_was_not_recorded(tire, record, channel):
    recording = record(3, friction=1.2)
    told = "no number in the column"
    few = all_but("friction_scale", "stiffness_scale")
    empty, without = (
        explain_mismatch(tire, given, without=few)
        for given in (recording.assign(**{channel: np.nan}), recording.drop(columns=channel, errors="ignore"))
    )
    assert empty.fit["fy"].rms_before == without.fit["fy"].rms_before
    assert empty.sets == without.sets
    predicted = empty.corrected.predict(recording.assign(**{channel: np.nan}))
    np.testing.assert_array_equal(predicted["fy"], without.corrected.predict(recording)["fy"])
    assert told in " ".join(usable_numbers(recording.assign(**{channel: np.nan})).attrs["notes"])


def test_brake_sweeps_at_one_slip_angle_are_explained(tire):
    """The misfit's grid had no side of a slip angle that does not vary."""
    rng, n = np.random.default_rng(3), 240
    time = np.arange(3 * n) / 20.0
    channels = pd.DataFrame(
        {
            "time": time,
            "slip_angle": np.radians(4.0) + rng.normal(0.0, 4e-4, time.size),
            "slip_ratio": -0.2
            * np.abs(np.sin(np.pi * time / 6.0))
            * np.where((time // 6.0) % 2.0, -1.0, 1.0),
            "normal_load": np.repeat([2000.0, 4000.0, 5600.0], n),
            "speed": 16.7,
        }
    )
    forces = tire.forces(**{name: channels[name] for name in channels if name != "time"})
    recording = channels.assign(
        fx=forces.fx + rng.normal(0.0, 60.0, time.size), fy=forces.fy + rng.normal(0.0, 60.0, time.size)
    )
    report = explain_mismatch(tire, recording, without=all_but("friction_scale", "stiffness_scale"))
    assert report.verdict == "agrees"
