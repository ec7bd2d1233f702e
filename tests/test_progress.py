"""Progress: one bar at a time on a terminal, and lines in a log."""

from __future__ import annotations

import io
import itertools
import re
from types import SimpleNamespace

import pytest

from tire_pipeline import progress


class Terminal(io.StringIO):
    """Keeps what is written to it."""

    def isatty(self) -> bool:
        return True

    def shown(self) -> str:
        """Give what was written since the last call, without the codes that move the cursor."""
        text = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", self.getvalue())
        self.seek(0)
        self.truncate()
        return text


@pytest.fixture
def slow(monkeypatch):
    """Let a minute pass between one look at the clock and the next."""
    minutes = itertools.count(0.0, 60.0)
    monkeypatch.setattr(progress, "time", SimpleNamespace(monotonic=lambda: next(minutes)))


def terminal_instead_of_a_log(monkeypatch) -> Terminal:
    """Called in the test itself: pytest puts its own stream in place of another's when a test begins."""
    for name, value in {"TERM": "xterm", "COLUMNS": "120"}.items():
        monkeypatch.setenv(name, value)
    for name in ("FORCE_COLOR", "NO_COLOR", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
        monkeypatch.delenv(name, raising=False)
    made = Terminal()
    monkeypatch.setattr("sys.stderr", made)
    return made


def test_a_bar_says_what_is_done_and_how_far_it_is(monkeypatch, slow):
    terminal = terminal_instead_of_a_log(monkeypatch)
    assert list(progress.track([1, 2, 3], "files")) == [1, 2, 3]
    shown = terminal.shown()
    assert "files" in shown
    assert "3/3" in shown


def test_a_quick_loop_shows_nothing(monkeypatch):
    terminal = terminal_instead_of_a_log(monkeypatch)
    monkeypatch.setattr(progress, "time", SimpleNamespace(monotonic=lambda: 0.0))
    assert list(progress.track([1, 2, 3], "files")) == [1, 2, 3]
    assert terminal.shown() == ""


def test_a_bar_within_another_is_not_drawn_over_it(monkeypatch, slow):
    terminal = terminal_instead_of_a_log(monkeypatch)
    seen, shown = [], []
    for number in progress.track([1, 2], "files"):
        terminal.shown()
        seen += [(number, each) for each in progress.track("ab", "forces")]
        shown.append(terminal.shown())
    assert seen == [(number, each) for number in (1, 2) for each in "ab"]
    assert "forces" in shown[0]  # nothing else was shown yet
    assert "forces" not in shown[1]


def test_a_loop_that_is_left_makes_room_for_the_next_bar(monkeypatch, slow):
    terminal = terminal_instead_of_a_log(monkeypatch)
    left = progress.track([1, 2, 3], "files")
    next(left), next(left)
    assert "files" in terminal.shown()
    left.close()
    terminal.shown()
    list(progress.track([1, 2], "forces"))
    assert "forces" in terminal.shown()


def test_a_log_has_lines(slow, capsys):
    assert list(progress.track("ab", "letters")) == ["a", "b"]
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(" (")[0] for line in lines] == ["letters: 1/2", "letters: 2/2"]
