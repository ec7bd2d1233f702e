"""What a run that was killed leaves half done is taken back, and nothing of others."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

import pytest
from turns import left_by_a_dead_run, wait_for_turn

from tire_pipeline.files.atomic import check_before_replacing, replaced_file, replaced_folder
from tire_pipeline.runs import LostTicketError, turn


def _replace(page: Path, meanwhile) -> None:
    with replaced_file(page) as temporary:
        temporary.write_text("new")
        meanwhile()


def test_who_lost_the_folder_writes_nothing_more(draw, no_locks, tmp_path):
    first = draw("first", beat_seconds=1e9)  # stands still from here on
    wait_for_turn(first)
    stop = check_before_replacing(first.check)
    try:
        page = tmp_path / "page.html"
        with replaced_file(page) as temporary:
            temporary.write_text("old")
        # declared dead while it writes
        with pytest.raises(LostTicketError, match="taken this data folder over"):
            _replace(page, first.path.unlink)
        with pytest.raises(LostTicketError):
            _replace(page, lambda: None)
        with pytest.raises(LostTicketError):
            replaced_folder(tmp_path / "folder").__enter__()
    finally:
        stop()
    assert page.read_text() == "old"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["data", "page.html"]


def test_what_a_dead_run_ends_writing_later_is_taken_back_by_the_run_after(draw, runs):
    left_by_a_dead_run(runs)
    second = draw("second")
    wait_for_turn(second)
    second.end()
    (runs.parent / "table.csv/old").mkdir(parents=True)  # the sleeper woke in the middle of a write
    wait_for_turn(draw("third"))
    assert not (runs.parent / "table.csv").exists()


KILLED_WRITER = """
import os, sys
from pathlib import Path
from tire_pipeline.files.atomic import check_before_replacing, replaced_file, replaced_folder
from tire_pipeline.runs import Ticket

data = Path(sys.argv[1])
ticket = Ticket.draw(data / ".runs", run="old", alongside=True)
check_before_replacing(ticket.check, owner=ticket.note.name)
with replaced_file(data / "03_primary/a.csv") as file, replaced_folder(data / "07" / sys.argv[2]) as folder:
    file.write_text("half")
    (folder / "page.html").write_text("half")
    print("written", flush=True)
    sys.stdin.read()
    os._exit(0)
"""


def _writer(data: Path, name: str) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-c", KILLED_WRITER, str(data), name]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdout.readline() == b"written\n"
    return process


def _temporary(data: Path) -> list[str]:
    return sorted(path.parent.name for path in data.rglob("*.part"))


def test_what_a_killed_run_was_writing_is_removed_and_nothing_of_others(draw, runs):
    data = runs.parent
    killed, living = _writer(data, "killed"), _writer(data, "living")
    try:
        (data / "03_primary/.of the user.part").write_text("mine")
        with replaced_file(data / "03_primary/by a command.csv") as file:
            killed.kill()
            killed.wait()
            assert _temporary(data) == ["03_primary"] * 4 + ["07"] * 2  # this one, the user's, both runs'
            following = draw("next")
            wait_for_turn(following)
            following.end()
            assert file.exists()
        assert (data / "03_primary/.of the user.part").exists()
        assert _temporary(data) == ["03_primary"] * 2 + ["07"]
        assert living.poll() is None
    finally:
        for each in (killed, living):
            each.kill()
            each.communicate()
    wait_for_turn(draw("the one after"))
    assert _temporary(data) == ["03_primary"]


def test_the_data_folder_is_walked_once_for_a_dead_run_and_again_if_that_walk_is_killed(
    draw, runs, monkeypatch
):
    half = runs.parent / "03/.tire_pipeline-000001-abcdefgh.part"
    half.parent.mkdir(parents=True)
    half.touch()
    left_by_a_dead_run(runs)
    walked = []
    remove = turn.remove_temporary

    def killed_at_first(folder: Path, owners: set[str]) -> None:
        walked.append(owners)
        if len(walked) == 1:
            raise KeyboardInterrupt
        remove(folder, owners)

    monkeypatch.setattr(turn, "remove_temporary", killed_at_first)
    clearing = draw("killed while it clears")
    with pytest.raises(KeyboardInterrupt):
        wait_for_turn(clearing)
    clearing.end()
    assert half.exists()
    for name in ("second", "third", "fourth"):
        own = draw(name)
        wait_for_turn(own)
        own.end()
        assert not half.exists()
    assert walked[:2] == [{"000001"}, {"000001"}]
    assert not any(walked[2:])


def test_a_folder_that_a_killed_run_had_moved_aside_is_put_back(draw, runs):
    old = runs.parent / ".pages.tire_pipeline-000001-abcdefgh.old"
    left_by_a_dead_run(runs)
    for each in (old, old.with_suffix(".part")):
        each.mkdir()
        (each / "page.html").write_text(each.suffix)
    wait_for_turn(draw("next"))
    assert [path.name for path in runs.parent.iterdir() if path != runs] == ["pages"]
    assert (runs.parent / "pages/page.html").read_text() == ".old"


@pytest.mark.parametrize("what", [replaced_file, replaced_folder])
def test_who_lost_the_folder_and_what_it_was_writing_is_told_so(draw, no_locks, runs, what):
    first = draw("first", beat_seconds=1e9)
    stop = check_before_replacing(first.check, owner=first.note.name)

    def lose_it_while_writing():
        with what(runs.parent / "page"):
            first.path.rename(first.path.with_suffix(".taken"))
            wait_for_turn(draw("second"))

    try:
        with pytest.raises(LostTicketError):
            lose_it_while_writing()
    finally:
        stop()
    assert [path for path in runs.parent.iterdir() if path != runs] == []


def test_a_note_cannot_have_anything_deleted_but_versions_of_its_run(draw, runs):
    note = left_by_a_dead_run(runs)
    (runs.parent / "models").mkdir()
    bad = {**asdict(note), "places": ["", ".", "models", "../data", str(runs.parent / "models")]}
    (runs / "000001.json").write_text(json.dumps(bad))
    wait_for_turn(draw("next"))
    assert (runs.parent / "models").exists()
