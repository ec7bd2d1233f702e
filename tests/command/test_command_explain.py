"""``tire explain``: what was found, on what it was tested, and what is written."""

from __future__ import annotations

import re

import pandas as pd
import pytest
from command_line import COEFFICIENTS, page, record, run, told

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.tir import read_tir, write_tir

pytestmark = pytest.mark.slow
FEW = [
    f"--without={name}"
    for name in sorted(set(catalogue()) - {"friction_scale", "stiffness_scale", "force_offset"})
]
"""Options by which a few effects are looked for, where it does not matter which ones."""


def test_explain_several_together_and_one_held_out(folder):
    for k, name in enumerate(("one.csv", "two.csv", "three.csv")):
        record(name, seed=k, friction=0.88)
    result = told(
        "explain", "a.tir", "one.csv", "two.csv", "three.csv", "--hold-out", "two.csv", "-o", "report.html",
        "--corrected", "corrected.tir", *FEW,
    )  # fmt: skip
    assert [effect["name"] for effect in result["effects"]] == ["friction_scale"]
    assert result["recordings"] == ["one.csv", "three.csv"]
    error = result["held_out"]["errors"]["fy"]
    assert error["rms_after"] < 0.5 * error["rms_before"]
    assert read_tir("corrected.tir").coefficients["LMUY"] == pytest.approx(0.88, abs=0.02)
    assert "Tested on a held-out recording" in page(folder / "report.html")
    assert result["written"] == ["corrected.tir", "report.html"]


def test_a_held_out_recording_need_not_be_among_the_explained(folder):
    record("one.csv", friction=0.88, seconds=45.0)
    record("two.csv", seed=1, friction=0.88, seconds=45.0)
    without = {name: value for name, value in COEFFICIENTS.items() if name != "UNLOADED_RADIUS"}
    write_tir(TireModel.from_coefficients(without), "b.tir")
    text = run("explain", "b.tir", "one.csv", "--hold-out", "two.csv", "--no-page", *FEW).stdout
    assert "On two.csv, which was held out" in text
    assert f"no UNLOADED_RADIUS, and {ASSUMED_RADIUS} m is taken for it" in " ".join(text.split())


def test_a_file_is_itself_however_its_path_is_written(folder):
    """Given by another path, the file to hold out was explained, too."""
    for seed, name in enumerate(("one.csv", "two.csv")):
        record(name, seed=seed, friction=0.88, seconds=45.0)
    (folder / "more").mkdir()
    record("more/two.csv", seed=7, friction=0.88, seconds=45.0)
    held_out = str(folder.resolve() / "two.csv")
    result = told("explain", "a.tir", "one.csv", "two.csv", "--hold-out", held_out, "--no-page", *FEW)
    assert result["recordings"] == ["one.csv"]
    assert result["held_out"]["recording"] == "two.csv"
    twice = run("explain", "a.tir", "one.csv", str(folder.resolve() / "one.csv"), "--no-page", code=2)
    assert "this file is given twice" in twice.stderr
    unclear = run(
        "explain", "a.tir", "one.csv", "./more/../more/two.csv", "more/two.csv", "--no-page", code=2
    )
    assert "this file is given twice" in unclear.stderr


def test_what_was_found_is_told_though_no_corrected_file_may_be_written(folder):
    record("run.csv", seconds=30.0)
    wrong = pd.read_csv("run.csv")
    wrong.assign(fy=-wrong["fy"]).to_csv("wrong.csv", index=False)
    result = run("explain", "a.tir", "wrong.csv", "--corrected", "corrected.tir", code=2)
    found = "the recording agrees with the model only in other axes"
    assert "a.tir and wrong.csv: explained, axes open" in result.stdout
    assert re.search(r"sign_convention of (fy|slip_angle)", result.stdout)
    assert found in " ".join(result.stdout.split())
    assert "corrected.tir: nothing corrected is written" in result.stderr
    assert found in page(folder / "a_explain.html")
    assert not (folder / "corrected.tir").exists()


def test_a_radius_that_no_wheel_has_is_said_beside_the_explanation(folder):
    """A loaded radius of 305 m went unsaid: millimetres that were read as metres."""
    record("run.csv")
    pd.read_csv("run.csv").assign(loaded_radius=305.0, Lampe=1.0).to_csv("mm.csv", index=False)
    call = ("explain", "a.tir", "mm.csv", "--no-page", *FEW)
    shown = run(*call).stdout
    assert "note: loaded_radius is 305 m, which no wheel has; the unit is likely mm" in shown
    assert "note: not used, because their names are not known: Lampe" in shown
    assert "which no wheel has" not in run(*call, "--unit", "loaded_radius=mm").stdout
