"""``tire translate`` with a translator stored as the pipelines store it."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from command_line import run

from tire_pipeline.files.state_files import pack_state
from tire_pipeline.fleet import FleetSettings, make_fleet
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.tir import read_tir, write_tir
from tire_pipeline.tire_table import dedupe_and_filter, from_models, normalize_table
from tire_pipeline.translation import make_translator

sys.path.insert(0, str(Path(__file__).parents[1] / "viz"))

from viz_browser import browser, needs_browser, read_page

pytestmark = pytest.mark.slow
NEWEST = "2026-03-01T10.00.00.000Z"


@pytest.fixture(scope="module")
def fleet():
    return make_fleet(FleetSettings(seed=77, files=450, tuning_tires=1, hidden_tires=2))


@pytest.fixture(scope="module")
def translator(fleet):
    files = fleet.files.items()
    models = ((path, path.split("/")[-2], read_tir(text.encode("latin-1"))) for path, text in files)
    table = dedupe_and_filter(normalize_table(from_models(models), 6000.0), features=LATERAL_WITHOUT_CAMBER)[
        0
    ].reset_index(drop=True)
    return make_translator("mixed_model", pairs=False).fit(table, target="D", seed=0)


@pytest.fixture
def folder(tmp_path, monkeypatch, fleet, translator):
    """A folder with one of the evaluation tires and a versioned translator."""
    monkeypatch.chdir(tmp_path)
    text = next(t for p, t in fleet.evaluation.items() if p.startswith("hidden/A/"))
    (tmp_path / "A").mkdir()
    (tmp_path / "A" / "tire.tir").write_bytes(text.encode("latin-1"))
    state = pack_state({**translator.to_state(), "nominal_load": 6000.0})
    for version, content in (("2026-01-01T10.00.00.000Z", b"old"), (NEWEST, state)):
        place = tmp_path / "06_models" / "translator.npz" / version / "translator.npz"
        place.parent.mkdir(parents=True)
        place.write_bytes(content)
    return tmp_path


def test_a_file_is_translated_as_the_translator_itself_does(folder, translator):
    said = json.loads(run("translate", "A/tire.tir", "--model", "06_models/translator.npz", "--json").stdout)
    assert said["source"] == "A"
    assert said["target"] == "D"
    assert NEWEST in said["model"]
    model = read_tir("A/tire.tir")
    table = normalize_table(from_models([("tire.tir", "A", model)]), 6000.0)
    result = translator.translation(table)
    assert said["verdict"] == result.report["verdict"].iloc[0] == "translated"
    back = normalize_table(result.table, model.value("FNOMIN")).iloc[0]
    new = read_tir("tire_as_D.tir")
    for name in ("PDY1", "PKY1", "PKY2"):
        assert new.coefficients[name] == float(f"{back[name]:.9g}")  # the digits of a file
    assert new.coefficients["FNOMIN"] == model.coefficients["FNOMIN"]
    assert "source category: A" in Path("tire_as_D.tir").read_text(encoding="latin-1")
    page = Path("tire_translate.html").read_text()
    assert "90% probability" in page
    printed = run("translate", "A/tire.tir", "--model", "06_models/translator.npz", "--overwrite").stdout
    changes = [line for line in printed.splitlines() if line.startswith("D measures")]
    assert changes == [f"{change}." for change in said["changes"].split("; ")]  # a line each
    assert "Coefficients that moved" in page


def test_a_tire_beyond_the_training_data_is_written_only_if_asked_for(folder):
    tire = read_tir("A/tire.tir")
    write_tir(tire.replace(PKY1=1.3 * tire.coefficients["PKY1"]), "A/stiff.tir")
    asked = ("translate", "A/stiff.tir", "--model", "06_models/translator.npz")
    text = run(*asked).stdout
    assert "Shaded" not in Path("stiff_translate.html").read_text()  # a refused file has no band
    assert ": refused." in text
    assert "outside of what d has measured: distance" in text.lower()
    assert "Bias of" not in text
    assert not Path("stiff_as_D.tir").exists()
    assert ": translated." in run(*asked, "--farthest", "3").stdout
    assert "beyond its edge, 1; written because asked for" in Path("stiff_as_D.tir").read_text("latin-1")


def test_a_tire_of_other_loads_than_those_compared_is_refused_unless_asked_for(folder):
    """A bus tire of 35 kN was judged at 2 to 8 kN: at its own load its aligning torque rose to 2.6 times."""
    tire = read_tir("A/tire.tir")
    write_tir(tire.nominal_load_changed(20000.0), "A/bus.tir")
    asked = ("translate", "A/bus.tir", "--model", "06_models/translator.npz", "--no-page", "--json")
    refused = json.loads(run(*asked).stdout)
    assert refused["verdict"] == "refused"
    why, advice = refused["reason"].split(". ")  # the advice comes last
    assert why.endswith("are judged at 2 to 8 kN, its nominal load is 20 kN)")
    assert "--farthest 3" in advice
    assert not Path("bus_as_D.tir").exists()
    reason = json.loads(run(*asked, "--farthest", "3").stdout)["reason"]
    assert "at 2 to 8 kN, its nominal load is 20 kN" in reason
    comments = " ".join(Path("bus_as_D.tir").read_text("latin-1").replace("\n! ", " ").split())
    assert "its nominal load is 20 kN: compare its curves there" in comments
    own = ("translate", "A/tire.tir", "--model", "06_models/translator.npz", "--no-page", "--json")
    assert "nominal load" not in json.loads(run(*own).stdout)["reason"]


def test_who_measured_it_is_told_by_the_option_or_the_folder(folder):
    Path("elsewhere.tir").write_bytes(Path("A/tire.tir").read_bytes())
    stored = ("--model", "06_models/translator.npz", "--no-page")
    assert "add --from with one of A, B, C" in run("translate", "elsewhere.tir", *stored, code=2).stderr
    Path("A/mine").mkdir()
    Path("A/mine/tire.tir").write_bytes(Path("A/tire.tir").read_bytes())
    above = run("translate", "A/mine/tire.tir", *stored, code=2)  # a disk or a user may be called A
    assert "who measured this tire is not known" in above.stderr
    assert "measured by B" in run("translate", "elsewhere.tir", *stored, "--from", "B").stdout
    wrong = run("translate", "elsewhere.tir", *stored, "--overwrite", "--from", "X", code=2)
    assert "no files of 'X'" in wrong.stderr


def test_a_target_file_of_the_target_is_left_alone(folder):
    text = run("translate", "A/tire.tir", "--model", "06_models/translator.npz", "--from", "D").stdout
    assert "already unbiased" in text
    assert not Path("tire_as_D.tir").exists()


def test_nothing_beyond_the_edge_of_the_training_data_is_written(folder):
    call = ("translate", "A/tire.tir", "--model", "06_models/translator.npz", "--farthest", "0.01", "--json")
    said = json.loads(run(*call).stdout)
    assert said["verdict"] == "refused"
    assert 0.01 < said["distance"] < 1.0
    assert "outside of what D has measured" not in said["reason"]
    distance = f"distance {said['distance']:.3g}, 0.01 is allowed, the edge is 1"
    assert said["reason"] == f"this tire is farther from what D has measured than was asked for: {distance}"
    assert said["written"] == ["tire_translate.html"]
    assert not Path("tire_as_D.tir").exists()


def test_other_places_of_a_model(folder, translator):
    state = {"translator": translator.to_state(), "nominal_load": np.float64(6000.0)}
    released = folder / "released"
    (released / "models").mkdir(parents=True)
    (released / "models" / "m2.npz").write_bytes(pack_state(state))
    (released / "record.json").write_text(json.dumps({"models": ["m1", "m2"]}))
    for place in ("released", "released/models/m2.npz", "released/models", "06_models"):
        call = ("translate", "A/tire.tir", "--model", place, "--overwrite", "--no-page", "--json")
        said = json.loads(run(*call).stdout)
        assert said["verdict"] == "translated"
    (folder / "06_models" / "agent.npz").write_bytes(b"another model")
    run("translate", "A/tire.tir", "--model", "06_models", "--overwrite", "--no-page")
    damaged = released / "models" / "m2.npz"
    damaged.write_bytes(damaged.read_bytes()[:-200])
    assert "damaged" in run("translate", "A/tire.tir", "--model", "released", code=2).stderr
    (folder / "other.npz").write_bytes(pack_state({"classifier": "random_forest"}))
    assert "not a translator" in run("translate", "A/tire.tir", "--model", "other.npz", code=2).stderr


def test_the_nominal_load_that_a_translator_does_not_state_is_assumed_and_said(folder, translator):
    (folder / "old.npz").write_bytes(pack_state(translator.to_state()))
    call = ("translate", "A/tire.tir", "--model", "old.npz", "--overwrite", "--no-page")
    said = "the translator does not say at which nominal load it has learned: 6000 N"
    assert said in " ".join(run(*call).stdout.split())
    assert said not in " ".join(run(*call, "--nominal-load", "6000").stdout.split())


def test_the_model_beside_a_misspelt_name_is_named(folder):
    said = run("translate", "A/tire.tir", "--model", "06_models/translator.joblib", code=2).stderr
    assert "did you mean 06_models/translator.npz?" in " ".join(said.split())


def test_a_file_that_is_no_model_is_told_as_such(folder):
    """A recording was called a damaged model, which was to be trained again."""
    Path("run.csv").write_text("SA,FZ,FY\n0,4000,0\n")
    Path("empty.npz").touch()
    np.savez("arrays.npz", a=np.zeros(3))
    for other in ("run.csv", "empty.npz", "arrays.npz", "A/tire.tir"):
        error = run("translate", "A/tire.tir", "--model", other, code=2).stderr
        assert f"{other}: this is no fitted model -> give one, such as data/06_models/translator.npz" in error


def test_its_page_is_read_in_a_browser(folder):
    needs_browser()
    run("translate", "A/tire.tir", "--model", "06_models/translator.npz")
    with browser(folder) as driver:
        text = read_page(driver, folder / "tire_translate.html")
        assert [word for word in ("translated", "PDY1", "90%") if word not in text] == []
        assert driver.find_elements("css selector", "figure svg, figure img")


@pytest.mark.parametrize("level", ["PDY1", "PKX1"])
def test_a_level_that_the_file_lacks_is_named(folder, level):
    """The change of load gave it a share of its slope, and the tire was "outside of what D has measured"."""
    lines = Path("A/tire.tir").read_text("latin-1").splitlines(keepends=True)
    Path("A/lacks.tir").write_text("".join(x for x in lines if not x.startswith(level)), "latin-1")
    call = ("translate", "A/lacks.tir", "--model", "06_models/translator.npz", "--no-page", "--json")
    assert json.loads(run(*call).stdout)["reason"] == f"it does not state {level}: add what is missing"


def test_what_is_unusual_in_the_file_is_said(folder):
    """A second stiffness put a tire outside of the training data, and only the distance was told."""
    text = Path("A/tire.tir").read_text("latin-1")
    line = next(x for x in text.splitlines() if x.startswith("PKY1"))
    Path("A/twice.tir").write_text(text.replace(line, f"{line}\nPKY1 = -60"), "latin-1")
    call = ("translate", "A/twice.tir", "--model", "06_models/translator.npz", "--no-page")
    assert "PKY1 has two values" in " ".join(run(*call).stdout.split())


def test_a_side_force_of_the_other_sign_is_the_reason_for_a_refusal(folder):
    """The tire was outside of what D has measured, at a distance of 182, without a reason."""
    tire = read_tir("A/tire.tir")
    write_tir(tire.replace(PKY1=-tire.coefficients["PKY1"]), "A/turned.tir")
    call = ("translate", "A/turned.tir", "--model", "06_models/translator.npz", "--no-page", "--json")
    said = json.loads(run(*call).stdout)
    assert said["verdict"] == "refused"
    assert said["reason"].startswith(
        "Fy has the other sign than in ISO W, the axes of .tir files: a positive"
    )
    assert "export the file in ISO W" in said["reason"]
    assert said["distance"] is None


def test_an_aligning_moment_of_the_other_sign_is_one_too(folder):
    tire = read_tir("A/tire.tir")
    write_tir(tire.replace(QDZ1=-abs(tire.coefficients["QDZ1"])), "A/mirrored.tir")
    call = ("translate", "A/mirrored.tir", "--model", "06_models/translator.npz", "--no-page", "--json")
    said = json.loads(run(*call).stdout)
    assert said["verdict"] == "refused"
    assert said["reason"].startswith("Mz has the other sign than in ISO W")
    assert "Mz has the other sign" in run("show", "A/mirrored.tir", "--no-page").stdout


def test_without_a_translator_the_error_says_where_one_is_or_which_command_makes_one(folder):
    said = " ".join(run("translate", "A/tire.tir", code=2).stderr.split())
    assert "no translator is given -> make one from the files of several suppliers by `kedro run" in said
    assert "kedro run --pipeline translate" in said
    Path("data").mkdir()
    Path("06_models").rename("data/06_models")
    said = " ".join(run("translate", "A/tire.tir", code=2).stderr.split())
    assert said == "error: no translator is given -> add --model data/06_models/translator.npz"
    run("translate", "A/tire.tir", "--model", said.rpartition(" ")[2], "--no-page")
    assert Path("tire_as_D.tir").exists()
