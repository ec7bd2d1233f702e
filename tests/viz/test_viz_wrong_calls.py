"""Wrong calls of ``make viz`` and ``make viz-page`` end in one line: what is wrong, and what to do."""

from __future__ import annotations

import socket
import sys

import pytest
from viz_browser import ROOT

from tire_pipeline.lineage import one_page, serve

pytestmark = pytest.mark.slow


def refused(module, monkeypatch, capsys, *arguments: str) -> str:
    """What one of the modules prints before it ends with code 1."""
    monkeypatch.setattr(sys, "argv", [module.__name__, *arguments])
    with pytest.raises(SystemExit) as ended:
        module.main()
    assert ended.value.code == 1
    printed = capsys.readouterr()
    assert printed.out == ""
    (line,) = printed.err.splitlines()
    return line


def test_a_misspelt_environment(monkeypatch, capsys):
    """It was a traceback of 60 lines."""
    line = refused(serve, monkeypatch, capsys, "--env", "smal", "--project", str(ROOT), "--port", "0")
    assert line.startswith("error: --env: there is no environment 'smal' -> did you mean 'small'?")


def test_no_project(monkeypatch, capsys, tmp_path):
    line = refused(serve, monkeypatch, capsys, "--project", str(tmp_path), "--port", "0")
    assert line.endswith("-> run it in the project's folder")


def test_a_port_that_is_in_use_or_none(monkeypatch, capsys):
    """The address was printed first, as if something answered there."""
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        line = refused(serve, monkeypatch, capsys, "--port", str(other.getsockname()[1]))
    assert "the port cannot be used (Address already in use) -> end what uses it, or choose another" in line
    assert "there is no such port" in refused(serve, monkeypatch, capsys, "--port", "99999")


def test_no_build(monkeypatch, capsys, tmp_path):
    line = refused(one_page, monkeypatch, capsys, str(tmp_path), str(tmp_path / "lineage.html"))
    assert line.endswith("there is no kedro-viz build here -> run `kedro viz build` first")
