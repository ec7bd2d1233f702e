"""The script beside the example recording makes what the project ships."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

from tire_pipeline.tir import read_tir
from tire_pipeline.tir.format.values import COMPUTED_DIGITS

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SHARE = 0.002
"""Of the largest force: another processor's last digits may end the fit a step elsewhere."""


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("example")
    runpy.run_path(str(EXAMPLES / "make_rig_recording.py"))["main"](folder)
    return folder


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rig_run.csv", "rig_check.csv"])
def test_the_recordings_are_made_to_the_byte(made, name):
    assert (made / name).read_bytes() == (EXAMPLES / name).read_bytes()


@pytest.mark.slow
def test_the_tire_file_is_made_anew_with_the_same_forces(made):
    slip, load = (each.ravel() for each in np.meshgrid(np.linspace(-0.2, 0.2, 41), (2000.0, 4000.0, 6000.0)))
    inputs = {"slip_angle": slip, "normal_load": load, "camber": 0.02}
    shipped, again = (read_tir(folder / "tire.tir").forces(**inputs) for folder in (EXAMPLES, made))
    for name in ("fx", "fy", "mz"):
        expected = getattr(shipped, name)
        assert np.abs(getattr(again, name) - expected).max() <= SHARE * np.abs(expected).max(), name
    pure = {"slip_ratio": np.linspace(-0.2, 0.2, 41), "normal_load": 4000.0}
    before, after = (read_tir(folder / "tire.tir").forces(**pure).fx for folder in (EXAMPLES, made))
    assert np.abs(after - before).max() <= SHARE * np.abs(before).max()


@pytest.mark.slow
def test_comments_of_the_tire_file_are_those_that_are_written_today(made):
    def words(folder):
        text = (folder / "tire.tir").read_text(encoding="ascii")
        return [line.partition("$")[2] for line in text.splitlines()]

    assert words(made) == words(EXAMPLES)


def test_the_tire_file_has_the_digits_that_matter():
    text = (EXAMPLES / "tire.tir").read_text(encoding="ascii")
    numbers = re.findall(r"(?m)^\w+ += (-?\d\S*)", text)
    assert len(numbers) > 100
    assert [each for each in numbers if float(f"{float(each):.{COMPUTED_DIGITS}g}") != float(each)] == []
