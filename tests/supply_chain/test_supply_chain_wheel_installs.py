"""The built wheel works where nothing else is installed, outside of the repository."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
SLIP_ANGLE, LOAD = -0.05, 4000.0
ALONE = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
"""Without a path to the sources, which would be taken instead of the wheel."""


def _said(folder: Path, *command: str | Path) -> str:
    return subprocess.run(command, cwd=folder, env=ALONE, capture_output=True, text=True, check=True).stdout


@pytest.mark.long
def test_the_wheel_installs_and_works_in_an_empty_environment(tmp_path):
    source, wheels = tmp_path / "source", tmp_path / "wheels"
    shutil.copytree(
        REPOSITORY / "src", source / "src", ignore=shutil.ignore_patterns("*.egg-info", "__pycache__")
    )
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(REPOSITORY / name, source / name)
    pip = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(wheels)]
    subprocess.run([*pip, str(source)], check=True)
    (wheel,) = wheels.glob("*.whl")
    venv.create(tmp_path / "empty", with_pip=True)
    python = tmp_path / "empty" / "bin" / "python"
    lock = str(REPOSITORY / "requirements.lock")
    subprocess.run([python, "-m", "pip", "install", "--quiet", str(wheel), "-c", lock], check=True, env=ALONE)
    file, recording = REPOSITORY / "examples" / "tire.tir", REPOSITORY / "examples" / "rig_run.csv"
    code = (
        "import json; from tire_pipeline.tir import read_tir; "
        f"tire = read_tir({str(file)!r}); "
        f"print(json.dumps(float(tire.forces(slip_angle={SLIP_ANGLE}, normal_load={LOAD}).fy)))"
    )
    there, here = (_said(tmp_path, each, "-c", code) for each in (python, sys.executable))
    assert json.loads(there) == pytest.approx(json.loads(here), rel=1e-12)
    tire = python.with_name("tire")
    assert "explain" in _said(tmp_path, tire, "--help")
    assert json.loads(_said(tmp_path, tire, "show", file, "--json"))["version"] == "5.2"
    report = json.loads(_said(tmp_path, tire, "explain", file, recording, "--axes", "ISO", "--json"))
    assert report["verdict"] == "explained"
    assert [effect["name"] for effect in report["effects"]] == ["inflation_pressure"]
