"""The built wheel works where nothing else is installed, outside of the repository."""

from __future__ import annotations

import json
import subprocess
import sys
import venv
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
SLIP_ANGLE, LOAD = -0.05, 4000.0


def _said(folder: Path, *command: str | Path) -> str:
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout


@pytest.mark.long
def test_the_wheel_installs_and_works_in_an_empty_environment(tmp_path):
    wheels = tmp_path / "wheels"
    pip = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(wheels)]
    subprocess.run([*pip, str(REPOSITORY)], check=True)
    (wheel,) = wheels.glob("*.whl")
    venv.create(tmp_path / "empty", with_pip=True)
    python = tmp_path / "empty" / "bin" / "python"
    lock = str(REPOSITORY / "requirements.lock")
    subprocess.run([python, "-m", "pip", "install", "--quiet", str(wheel), "-c", lock], check=True)
    code = (
        "import json; from tire_pipeline.tir import read_tir; "
        f"tire = read_tir({str(REPOSITORY / 'examples' / 'tire.tir')!r}); "
        f"print(json.dumps(float(tire.forces(slip_angle={SLIP_ANGLE}, normal_load={LOAD}).fy)))"
    )
    there, here = (_said(tmp_path, each, "-c", code) for each in (python, sys.executable))
    assert json.loads(there) == pytest.approx(json.loads(here), rel=1e-12)
    assert "explain" in _said(tmp_path, python.with_name("tire"), "--help")
