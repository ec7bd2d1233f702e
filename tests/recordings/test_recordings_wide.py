"""Recordings of very many columns: the work grows with the columns, not with their square."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tire_pipeline.command import check
from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.recordings import check_recording, read_recording

KNOWN = {"time": "0", "slip_angle": "0.1", "normal_load": "4000", "fy": "100"}


def _csv(path, names):
    header = [*KNOWN, *names]
    row = [*KNOWN.values(), *["1.5"] * len(names)]
    path.write_text(f"{','.join(header)}\n{','.join(row)}\n")
    return read_recording(path)


class Counted:
    """Stands for attrs of a thousand entries: counts how often it is copied."""

    copies = 0

    def __deepcopy__(self, memo):
        Counted.copies += 1
        return self


@pytest.mark.parametrize(
    "look",
    [
        check_recording,
        lambda frame: explain_mismatch(None, frame),
        lambda frame: check.outcome(Path("wide.csv"), frame, []),
    ],
)
def test_what_is_known_of_all_channels_is_not_copied_for_each(tmp_path, look):
    copies = []
    for count in (10, 100):
        frame = _csv(tmp_path / "wide.csv", [f"c{i}" for i in range(count)])
        frame.attrs["counted"] = Counted()
        Counted.copies = 0
        try:
            look(frame)
        except RecordingError as error:
            assert "only 1 samples" in str(error)  # noqa: PT017 - both outcomes are right
        copies.append(Counted.copies)
    assert copies[0] == copies[1]


def test_two_thousand_columns_of_one_name_are_told_apart(tmp_path):
    frame = _csv(tmp_path / "wide.csv", ["x"] * 2000)
    assert frame.shape == (1, 2004)
    assert list(frame.columns[-2:]) == ["x_1999", "x_2000"]


def test_a_header_longer_than_the_first_look_is_found(tmp_path):
    names = [f"Tyre Surface Temperature Sensor {i} of the left wheel" for i in range(2000)]
    assert _csv(tmp_path / "wide.csv", names).shape == (1, 2004)


def test_a_note_names_no_two_thousand_columns(tmp_path):
    for count, end in ((20, "c19"), (21, "c19 and 1 more"), (2000, "c19 and 1,980 more")):
        notes = _csv(tmp_path / "wide.csv", [f"c{i}" for i in range(count)]).attrs["notes"]
        (note,) = [
            note for note in notes if note.startswith("not used, because their names are not known: c0")
        ]
        assert note.endswith(f", {end}")


def _read_and_checked(path):
    return check_recording(read_recording(path))


def _calls(work, *arguments) -> int:
    """How many functions are called, those that are written in C, too."""
    calls = 0

    def count(_, event, __):
        nonlocal calls
        calls += event in ("call", "c_call")

    sys.setprofile(count)
    try:
        work(*arguments)
    finally:
        sys.setprofile(None)
    return calls


def test_the_work_grows_with_the_columns(tmp_path):
    """Twice the further columns, twice the calls: what is left over is less than one call a column."""
    paths = [tmp_path / f"{count}.csv" for count in (50, 100, 200)]
    for count, path in zip((50, 100, 200), paths, strict=True):
        _csv(path, [f"c{i}" for i in range(count)])
    _read_and_checked(paths[-1])  # what is imported or found once counts for none
    few, more, many = (_calls(_read_and_checked, path) for path in paths)
    assert few < more < many
    assert abs((many - more) - 2 * (more - few)) < 200
