"""Recordings of one tire joined: pieces stay apart, channels in common, what cannot be joined is refused."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings import join_recordings
from tire_pipeline.recordings.groups import by_folder, matching


def run(seconds: float = 20.0, rate: float = 50.0, *, sign: float = -1.0, begin: float = 3.0, **more):
    time = np.arange(0.0, seconds, 1.0 / rate)
    angle = 0.1 * np.sin(2.0 * np.pi * time / 5.0)
    columns = {
        "time": time + begin,
        "slip_angle": angle,
        "normal_load": np.full(time.size, 4000.0),
        "fy": sign * 40_000.0 * angle,
    }
    return pd.DataFrame({**columns, **more})


def test_each_follows_the_one_before_after_a_gap():
    a, b, c = run(), run(seconds=10.0), run(begin=-100.0)
    joined = join_recordings({"a": a, "b": b, "c": c})
    assert len(joined) == len(a) + len(b) + len(c)
    steps = np.diff(joined["time"])
    seams = [len(a) - 1, len(a) + len(b) - 1]
    assert np.flatnonzero(steps > 0.9).tolist() == seams
    assert np.delete(steps, seams) == pytest.approx(0.02)
    for part, place in zip((a, b, c), joined.attrs["joined"], strict=True):
        own = joined.iloc[place["first"] : place["last"] + 1]
        assert own["fy"].to_numpy() == pytest.approx(part["fy"].to_numpy())
        assert own["time"].to_numpy() - place["offset"] == pytest.approx(part["time"].to_numpy())


def test_the_engine_sees_each_as_a_piece_of_its_own():
    from tire_pipeline.magic_formula import TireModel
    from tire_pipeline.mismatch.recording.prepare import prepare

    coefficients = {"FNOMIN": 4000.0, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -15.0, "PKY2": 2.0}
    tire = TireModel.from_coefficients(coefficients)
    parts = {name: run() for name in "abc"}
    prepared = prepare(tire, join_recordings(parts))
    assert np.flatnonzero(prepared.data.start).tolist() == [0, 1000, 2000]


def test_a_channel_that_one_lacks_is_left_out_and_named():
    warm = run(tread_temperature=np.linspace(30.0, 80.0, 1000), pressure=2.2e5)
    joined = join_recordings({"a": warm, "b": run(pressure=2.2e5)})
    assert "tread_temperature" not in joined
    assert "pressure" in joined
    notes = " ".join(joined.attrs["notes"])
    assert "tread_temperature is left out: b has none" in notes
    assert "varies in a" in notes
    assert "pressure" not in notes


def test_a_camber_that_one_lacks_is_left_out_only_where_it_is_zero_anyway():
    joined = join_recordings({"a": run(camber=1e-4), "b": run()})
    assert "camber" not in joined
    with pytest.raises(RecordingError, match="camber is not zero in a, and missing from b"):
        join_recordings({"a": run(camber=0.05), "b": run()})


def test_rates_are_brought_to_the_slowest():
    fast = run(rate=200.0)
    joined = join_recordings({"slow": run(), "fast": fast})
    assert len(joined) == 2000
    own = joined.iloc[1000:]
    assert np.diff(own["time"]) == pytest.approx(0.02)
    assert own["fy"].to_numpy() == pytest.approx(fast["fy"].to_numpy().reshape(-1, 4).mean(axis=1))
    assert any("fast: 4 samples each averaged, 200 to 50 Hz" in note for note in joined.attrs["notes"])


def test_forces_are_not_averaged_over_a_slip_that_changes():
    """A run of 1 Hz made means over 7.8 deg of slip of the others: no tire has such a curve."""
    fast, slow = run(), run(seconds=40.0, rate=1.0)
    joined = join_recordings({"fast": fast, "slow": slow})
    own = joined.iloc[:20]
    assert own["fy"].tolist() == fast["fy"].iloc[::50].tolist()
    assert any(
        note.startswith("fast: one of 50 samples is used, 50 to 1 Hz") for note in joined.attrs["notes"]
    )


def test_nothing_is_averaged_over_a_gap_nor_from_fewer_samples():
    fast = run(rate=200.0).drop(index=range(402, 600))
    own = join_recordings({"slow": run(), "fast": fast}).iloc[1000:]
    assert len(own) == 400 // 4 + 3400 // 4
    assert own["time"].iloc[99] - own["time"].iloc[0] == pytest.approx(99 * 0.02)


def test_steady_points_are_joined_without_time():
    points = run(seconds=1.0).drop(columns="time")
    joined = join_recordings({"a": points, "b": points})
    assert "time" not in joined
    assert len(joined) == 100
    assert joined.attrs["steady_points"]


def test_the_notes_of_each_recording_are_kept():
    a, b = run(), run()
    b.attrs["notes"] = ["no unit given, SI assumed: fy (N)"]
    assert "b: no unit given, SI assumed: fy (N)" in join_recordings({"a": a, "b": b}).attrs["notes"]


@pytest.mark.parametrize(
    ("recordings", "message"),
    [
        ({}, "no recording to join"),
        ({"a": run(), "b": run().drop(columns="time")}, "b has no time"),
        ({"a": run(), "b": run(sign=1.0)}, "positive fy in b, a negative in a"),
        ({"a": run(), "b": run().drop(columns="normal_load")}, "normal_load is not in all of a, b"),
        ({"a": run(), "b": run().rename(columns={"fy": "fx"})}, "a force is not in all of a, b"),
        ({"a": run(), "b": run().drop(columns="normal_load")}, "a has normal_load, b has none"),
        ({"a": run(), "b": run()[::-1]}, "time does not rise"),
        ({"a": run(), "b": run()[:1]}, "b: it has fewer than two samples"),
        ({"a": run(), "b": run()[:0]}, "b: it has no samples"),
        (
            {"a": run(), "b": run().assign(time=run()["time"] * 1e3)},
            "b: there are 20 s from .*longer than all of a",
        ),
    ],
)
def test_what_cannot_be_joined_is_refused(recordings, message):
    with pytest.raises(RecordingError, match=message):
        join_recordings(recordings)


def test_a_fit_takes_each_force_from_the_recordings_that_have_it():
    cornering = run().assign(slip_ratio=0.0)
    braking = (
        run().rename(columns={"fy": "fx", "slip_angle": "slip_ratio"}).assign(slip_angle=0.0, speed=20.0)
    )
    joined = join_recordings({"a": cornering, "b": braking}, forces_of_any=True)
    half = len(cornering)
    assert joined["fy"].notna().tolist() == [True] * half + [False] * half
    assert joined["fx"].notna().tolist() == [False] * half + [True] * half
    assert "speed" not in joined
    assert not any("fy is left out" in note for note in joined.attrs["notes"])
    with pytest.raises(RecordingError, match="a force is not in all of a, b: a has fy, b has none"):
        join_recordings({"a": cornering, "b": braking.drop(columns="fx")}, forces_of_any=True)


def test_a_channel_without_a_number_counts_as_absent():
    joined = join_recordings({"a": run(pressure=2.2e5), "b": run(pressure=np.nan)})
    assert "pressure" not in joined
    assert joined.notna().all(axis=None)


def test_one_note_of_several_recordings_is_said_once():
    a, b = run(), run()
    a.attrs["notes"] = b.attrs["notes"] = ["no unit given"]
    assert "a, b: no unit given" in join_recordings({"a": a, "b": b}).attrs["notes"]


def test_recordings_of_one_folder_belong_together():
    groups = by_folder(["x/2.csv", "x/1.csv", "y/1.csv", "1.csv"])
    assert groups == {"1.csv": ["1.csv"], "x/together": ["x/1.csv", "x/2.csv"], "y/1.csv": ["y/1.csv"]}


def test_run_10_comes_after_run_2():
    """Heat, wear and drift go on from one to the next: by text, run 10 was taken for the second one."""
    names = ["x/run10.csv", "x/run2.csv", "x/run1.csv", "x/run01.csv", "x/check.csv"]
    (inside,) = by_folder(names).values()
    assert inside == ["x/check.csv", "x/run01.csv", "x/run1.csv", "x/run2.csv", "x/run10.csv"]


def test_one_recording_of_a_folder_is_held_out():
    names = ["x/1.csv", "x/1_check.csv"]
    assert matching(names, "*_check.csv") == "x/1_check.csv"
    assert matching(names, "x/1.csv") == "x/1.csv"
    assert matching(names, "2*") is None
    assert matching(names, "") is None
    with pytest.raises(RecordingError, match="only one can be held out"):
        matching(names, "*.csv")
