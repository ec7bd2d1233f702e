"""Progress: what stands in a log, and one bar at a time on a terminal."""

from __future__ import annotations

import io

from rich.console import Console

from tire_pipeline import progress


def terminal() -> Console:
    return Console(file=io.StringIO(), force_terminal=True, width=120)


def test_a_bar_within_another_is_not_drawn_over_it(monkeypatch):
    monkeypatch.setattr(progress, "_SHOW_AFTER_SECONDS", -1.0)
    outside, inside = terminal(), terminal()
    seen = []
    for number in progress._bar([1, 2], "files", 2, outside):
        seen += [(number, each) for each in progress._bar("ab", "forces", 2, inside)]
        if number == 1:
            first = inside.file.getvalue()
            inside.file.truncate(0)
    assert seen == [(1, "a"), (1, "b"), (2, "a"), (2, "b")]
    assert "forces" in first  # nothing else was shown yet
    assert "files" in outside.file.getvalue()
    assert inside.file.getvalue() == ""
    assert not progress._TERMINAL.locked()


def test_a_loop_that_is_left_gives_the_terminal_back(monkeypatch):
    monkeypatch.setattr(progress, "_SHOW_AFTER_SECONDS", -1.0)
    items = progress._bar([1, 2, 3], "files", 3, terminal())
    next(items), next(items)
    assert progress._TERMINAL.locked()
    items.close()
    assert not progress._TERMINAL.locked()


def test_a_log_has_a_line_for_each_stretch_of_time(monkeypatch, capsys):
    monkeypatch.setattr(progress, "_LINE_EVERY_SECONDS", -1.0)
    assert list(progress.track("ab", "letters")) == ["a", "b"]
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(" (")[0] for line in lines] == ["letters: 1/2", "letters: 2/2"]
