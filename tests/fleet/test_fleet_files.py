"""The files: read back, distinct, silent about the truth, the same for the same seed."""

import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.fleet import FEATURES, FleetSettings, make_fleet, read_truth_tables, write_fleet
from tire_pipeline.fleet.settings import FOUR_TIRE_CATEGORIES, MANUFACTURERS, file_counts
from tire_pipeline.fleet.tire_population import COMPOUNDS
from tire_pipeline.tir import read_tir

pytestmark = pytest.mark.slow

METADATA = ("UNLOADED_RADIUS", "DIMENSION.WIDTH", "DIMENSION.RIM_RADIUS", "INERTIA.MASS")


@pytest.fixture(scope="module")
def written(small_fleet, tmp_path_factory):
    folder = tmp_path_factory.mktemp("raw")
    return write_fleet(small_fleet, folder)


@pytest.fixture(scope="module")
def models(written):
    folder = written["tir"]
    return {str(p.relative_to(folder)): read_tir(p) for p in sorted(folder.rglob("*.tir"))}


def _values(model, names) -> tuple:
    everything = {**model.coefficients, **model.metadata}
    return tuple(everything.get(name) for name in names)


def test_every_file_reads_back(models, small_fleet) -> None:
    assert set(models) == set(small_fleet.files)
    roles = small_fleet.truth.files.set_index("file")["file_role"]
    for path, model in models.items():
        assert model.version == "5.2", path
        lacking = [name for name in FEATURES if name not in model.coefficients]
        assert len(lacking) == (roles[path] == "missing"), (path, lacking)
        if roles[path] != "missing":
            assert not model.defaulted, (path, dict(model.defaulted))


def test_units_are_converted_to_the_same_metadata_for_all(models, small_fleet) -> None:
    origin = small_fleet.truth.files.set_index("file")
    tires = small_fleet.truth.tires
    columns = ["UNLOADED_RADIUS", "WIDTH", "RIM_RADIUS", "MASS"]
    for path, model in models.items():
        expected = tires.loc[origin.loc[path, "tire"], columns].to_numpy(dtype=float)
        np.testing.assert_allclose(
            np.array(_values(model, METADATA), dtype=float), expected, rtol=1e-9, err_msg=path
        )


def test_metadata_names_one_tire(models, small_fleet) -> None:
    tire = small_fleet.truth.files.set_index("file")["tire"]
    keys = {path: tuple(round(v, 6) for v in _values(m, METADATA)) for path, m in models.items()}
    table = pd.DataFrame({"key": keys, "tire": tire})
    assert (table.groupby("tire")["key"].nunique() == 1).all()
    assert (table.groupby("key")["tire"].nunique() == 1).all()


def test_copies_and_only_copies_have_equal_coefficients(models, small_fleet) -> None:
    origin = small_fleet.truth.files.set_index("file")
    good = origin[origin["file_role"].isin(["kept", "copy"])]
    values = pd.Series({path: _values(models[path], FEATURES) for path in good.index})
    groups = values.groupby(values).groups
    assert len(groups) == (good["file_role"] == "kept").sum()
    for files in groups.values():
        assert (good.loc[list(files), "file_role"] == "kept").sum() == 1
        assert good.loc[list(files), "measurement"].nunique() == 1


def test_paired_tires_are_measured_by_all(small_fleet, small_settings) -> None:
    truth = small_fleet.truth
    paired = truth.tires.index[truth.tires["role"] == "paired"]
    assert len(paired) == small_settings.paired_tires
    kept = truth.files[(truth.files["file_role"] == "kept") & truth.files["tire"].isin(paired)]
    assert (kept.groupby("tire")["category"].agg(set) == set(MANUFACTURERS)).all()
    others = truth.files[~truth.files["tire"].isin(paired)]
    assert (others.groupby("tire")["category"].nunique() == 1).all()


def test_evaluation_tires_and_the_seal(small_fleet, small_settings) -> None:
    truth, target = small_fleet.truth, small_settings.target
    sizes = {"four": 4, "tuning": small_settings.tuning_tires, "hidden": small_settings.hidden_tires}
    for name, count in sizes.items():
        categories = FOUR_TIRE_CATEGORIES if name == "four" else MANUFACTURERS
        tires = truth.tires.index[truth.tires["role"] == name]
        assert len(tires) == count
        expected = {f"{name}/{c}/{t}.tir" for c in categories for t in tires}
        assert {p for p in truth.first if p.startswith(name)} == expected
        assert {p for p in truth.second if p.startswith(name)} == expected
        inputs = {p for p in small_fleet.evaluation if p.startswith(name)}
        assert inputs == {p for p in expected if p.split("/")[1] != target}
        assert not set(tires) & set(truth.files["tire"])
    assert all(small_fleet.evaluation[p] == truth.first[p] for p in small_fleet.evaluation)
    assert all(truth.first[p] != truth.second[p] for p in truth.first)


def test_texts_do_not_tell_the_truth(small_fleet) -> None:
    truth = small_fleet.truth
    words = re.compile("|".join([*COMPOUNDS, r"\bT\d{4}\b", "compound", "paired", "hidden"]), re.I)
    for path, text in {**small_fleet.files, **small_fleet.evaluation}.items():
        assert not words.search(text), path
    sealed = set(truth.first.values()) | set(truth.second.values())
    target = {t for p, t in truth.first.items() if p.split("/")[1] == "D"} | set(truth.second.values())
    assert not target & set(small_fleet.evaluation.values())
    assert not sealed & set(small_fleet.files.values())


def test_compound_is_written_only_when_asked(small_settings) -> None:
    told = make_fleet(
        replace(small_settings, files=330, hidden_tires=1, tuning_tires=1, compound_in_metadata=True)
    )
    origin = told.truth.files.set_index("file")
    compound = told.truth.tires["compound"]
    for path, text in told.files.items():
        found = re.search(r"compound_class\s*=\s*'([a-z-]+)'", text, re.I)
        assert found, path
        assert found.group(1) == compound[origin.loc[path, "tire"]]


def test_same_seed_same_bytes_whatever_the_threads(small_fleet, small_settings) -> None:
    again = make_fleet(replace(small_settings, threads=1))
    assert again.files == small_fleet.files
    assert again.evaluation == small_fleet.evaluation
    assert again.truth.second == small_fleet.truth.second


def test_another_seed_is_another_fleet(small_fleet, small_settings) -> None:
    other = make_fleet(replace(small_settings, seed=8, files=330, hidden_tires=1, tuning_tires=1))
    assert not set(other.files.values()) & set(small_fleet.files.values())


def test_writing_never_touches_the_users_files(small_fleet, tmp_path) -> None:
    mine = tmp_path / "tir" / "mine" / "a.tir"
    mine.parent.mkdir(parents=True)
    mine.write_text("mine")
    with pytest.raises(DomainError, match="already holds files"):
        write_fleet(small_fleet, tmp_path)
    assert mine.read_text() == "mine"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["tir"]


def test_full_disk_leaves_nothing_behind(small_fleet, tmp_path, monkeypatch) -> None:
    from pathlib import Path

    count = 0
    real = Path.write_bytes

    def full(self: Path, data: bytes) -> int:
        nonlocal count
        count += 1
        if count > 100:
            raise OSError(28, "No space left on device")
        return real(self, data)

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(DomainError, match="No space left"):
        write_fleet(small_fleet, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_truth_tables_come_back(written, small_fleet) -> None:
    tires, files = read_truth_tables(written["truth"])
    pd.testing.assert_frame_equal(tires, small_fleet.truth.tires, check_dtype=False)
    pd.testing.assert_frame_equal(files, small_fleet.truth.files, check_dtype=False)
    curves = np.load(written["truth"] / "curves_hidden.npz")
    assert curves["fy"].shape == (4, 3, 100)


def _through_the_filter(models: dict, small_features=FEATURES):
    from tire_pipeline.tire_table import dedupe_and_filter, from_models

    table = from_models((path, path.split("/")[0], model) for path, model in models.items())
    return table, dedupe_and_filter(table, features=list(small_features))


def test_filter_leaves_the_kept_files(models, small_fleet) -> None:
    table, (remaining, _) = _through_the_filter(models)
    origin = small_fleet.truth.files.set_index("file")
    assert remaining["category"].value_counts().to_dict() == file_counts(400).kept
    tire = origin.loc[table["file"], "tire"].to_numpy()
    pairs = pd.DataFrame({"tire": tire, "tire_id": table["tire_id"].to_numpy()})
    assert (pairs.groupby("tire")["tire_id"].nunique() == 1).all()
    assert (pairs.groupby("tire_id")["tire"].nunique() == 1).all()


@pytest.mark.long
def test_full_fleet_leaves_2061_files(tmp_path) -> None:
    fleet = make_fleet(FleetSettings(hidden_tires=1, tuning_tires=1))
    folder = write_fleet(fleet, tmp_path)["tir"]
    models = {str(p.relative_to(folder)): read_tir(p) for p in sorted(folder.rglob("*.tir"))}
    assert len(models) == 3648
    remaining = _through_the_filter(models)[1][0]
    assert len(remaining) == 2061
    assert remaining["category"].value_counts().to_dict() == file_counts(3648).kept
