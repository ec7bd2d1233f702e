"""``make install`` says how far it is, installs what pip installs, and fails as pip does."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

FILE = Path(__file__).resolve().parents[2] / "tools" / "install.py"
SPEC = importlib.util.spec_from_file_location("install", FILE)
TOOL = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(TOOL)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("Collecting numpy<3,>=2 (from tire-pipeline==0.2.0)", "choosing versions, numpy"),
        (
            "  Downloading torch-2.13.0-cp311-cp311-linux_x86_64.whl (190.4 MB)",
            "downloading torch 2.13.0 (190.4 MB)",
        ),
        ("Downloading https://pypi.org/a/kedro-1.7.0.tar.gz (3 kB)", "downloading kedro 1.7.0 (3 kB)"),
        (
            "  Downloading zict-3.0.0-py2.py3-none-any.whl.metadata (899 bytes)",
            "choosing versions, zict 3.0.0",
        ),
        ("Requirement already satisfied: numpy", "looking at what is there"),
        ("  Installing build dependencies: started", "building packages"),
        ("Looking in indexes: https://pypi.org/simple", "starting pip"),
    ],
)
def test_what_pip_does_is_said(tmp_path, line, said):
    progress = TOOL.Progress(tmp_path)
    progress.hear(line)
    assert progress.say() == said


def test_packages_unpacked_since_the_begin_are_counted(tmp_path):
    def unpack(name: str) -> Path:
        folder = tmp_path / f"{name}-1.dist-info"
        folder.mkdir()
        (folder / "INSTALLER").write_text("pip\n")
        return folder

    os.utime(unpack("earlier"), (0, 0))
    progress = TOOL.Progress(tmp_path)
    progress.hear("Installing collected packages: a, b, c")
    assert progress.say() == "unpacking 3 packages, 0 done"
    unpack("a")
    (tmp_path / "b-1.dist-info").mkdir()  # under way: pip writes INSTALLER last
    assert progress.say() == "unpacking 3 packages, 1 done"


def wheel(folder: Path) -> Path:
    """A package of one module."""
    path = folder / "quiet_thing-1-py3-none-any.whl"
    info = "quiet_thing-1.dist-info"
    with zipfile.ZipFile(path, "w") as files:
        files.writestr("quiet_thing.py", "VALUE = 7\n")
        files.writestr(f"{info}/METADATA", "Metadata-Version: 2.1\nName: quiet-thing\nVersion: 1\n")
        files.writestr(f"{info}/WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
        files.writestr(f"{info}/RECORD", "")
    return path


def test_pip_installs(tmp_path):
    place = tmp_path / "place"
    command = [sys.executable, FILE, "--no-index", "--no-deps", "--target", place, wheel(tmp_path)]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (place / "quiet_thing.py").read_text() == "VALUE = 7\n"


def test_it_speaks_while_pip_is_silent(monkeypatch, capsys):
    silent = "import time; print('Collecting torch', flush=True); time.sleep(1.5)"
    monkeypatch.setattr(TOOL, "PIP", (sys.executable, "-c", silent))
    assert TOOL.install([], seconds=0.2) == 0
    assert "  choosing versions, torch (" in capsys.readouterr().out


def test_an_error_of_pip_is_printed_and_ends_it(tmp_path):
    command = [sys.executable, FILE, "--no-index", "--target", tmp_path, "no-such-package-at-all"]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    assert done.returncode != 0
    assert "no-such-package-at-all" in done.stderr
