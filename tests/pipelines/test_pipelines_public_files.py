"""Every kind of statement that ``translate`` makes on files of unknown suppliers and on the fleet's."""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
import zlib
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from conftest_kedro import ROOT, kedro_here

from tire_pipeline.translation.judge.effects import KEY_PARTS

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("error::pandas.errors.PerformanceWarning")]
PUBLIC = sorted((ROOT.parent / "shared" / "tir").glob("*.tir"))
KNOWN = ("A", "B", "C", "D", "E", "F")
VERDICTS = {"translated", "already unbiased", "left alone", "refused", "unknown supplier"}
BAND = ", ".join(rf"{part} [+-]\d+\.\d% to [+-]\d+\.\d%" for part in KEY_PARTS)

FILES = (
    "BrianN92/BrianN92__Pacejka-tire-model__example.tir",
    "OpenTire/OpenTire__Sandbox__MagicFormula52_Parameters.tir",
    "TUMFTM/TUMFTM__Open-Car-Dynamics__example_road_tire.tir",
    "TUMFTM/TUMFTM__sim_vehicle_dynamics__pa_sim_tireparameters.tir",
    "ZipsRacingElectric/ZipsRacingElectric__Vehicle-Dynamics__MF_TDummy.tir",
    "aunyks/aunyks__tread__audi-temp.tir",
    "matheusft/matheusft__MFeval_julia__MagicFormula61_Parameters.tir",
    "matheusft/matheusft__MFeval_julia__MagicFormula62_Parameters.tir",
    "modelica-3rdparty/modelica-3rdparty__ExternData__sample.tir",
    "projectchrono/projectchrono__chrono__335_65R22_5_G275MSA_60psi.tir",
    "projectchrono/projectchrono__chrono__335_65R22_5_G275MSA_70psi.tir",
    "projectchrono/projectchrono__chrono__CityBus_Pac02Tire.tir",
    "projectchrono/projectchrono__chrono__Generic_Pac02Tire.tir",
    "projectchrono/projectchrono__chrono__Polaris_Pac02Tire.tir",
    "projectchrono/projectchrono__chrono__mf_185_80R14.tir",
    "projectchrono/projectchrono__chrono__suv_Pac02Tire.tir",
)
SAID = re.compile(
    r"D measures (\d+\.\d)% (more|less) (cornering stiffness|lateral grip|slip stiffness|longitudinal grip)"
)
KEY_WORDS = tuple(enumerate(("cornering stiffness", "lateral grip", "slip stiffness", "longitudinal grip")))
"""Places of ``KEY_PARTS`` and what the sentences call them."""
NO_NUMBERS = ("source_probability", "distance", "expected_rms_ratio", "harm_probability")
NO_WORDS = ("bias_band", "changes")
WITHOUT_FIT = ("choose_files", "translate_each", "join_translated", "draw_translated_files")
"""Nodes of ``translate`` that a stored translator suffices for."""


def _parts(index: Path) -> pd.DataFrame:
    return pd.concat(map(pd.read_parquet, sorted(index.parent.glob("part-*.parquet"))))


class Outputs:
    """What one run has written."""

    def __init__(self, folder: Path) -> None:
        self.data = folder / "data"
        self.report = self._table("translation_report.json", _parts).set_index("file").replace("", np.nan)
        self.bands = self._table("translation_bands.json", _parts)
        self.coefficients = self._table("translation_coefficients.json", _parts)
        self.page = _Page((self.data / "08_reporting" / "translated_files.html").read_text("utf-8"))
        translated = self.data / "07_model_output" / "translated"
        self.files = {str(p.relative_to(translated)): p for p in translated.rglob("*.tir")}

    def _table(self, name: str, read: Callable[[Path], pd.DataFrame]) -> pd.DataFrame:
        return read(sorted((self.data / "07_model_output" / name).glob(f"*/{name}"))[-1])

    def header(self, file: str) -> dict[str, str]:
        """Comments at the top of a translated file, by what stands before the colon."""
        text = self.files[file].read_text(encoding="latin-1")
        lines = [line[2:] for line in text.splitlines() if line.startswith("! ")]
        said: dict[str, str] = {}
        for name, text in re.findall(r"^([^:\n]+): (.+)$", "\n".join(lines), flags=re.M):
            said[name] = f"{said[name]}, {text}" if name in said else text
        return said


class _Page(HTMLParser):
    """The page's text, and the rows of the files inside."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.text, self._data, self._inside = "", "", ""
        self.feed(text)
        data = json.loads(self._data)
        rows = json.loads(zlib.decompress(base64.b64decode(data["rows"])))
        self.rows = {row[0]: dict(zip(data["columns"], row, strict=True)) for row in rows}

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._inside = "data" if dict(attrs).get("id") == "data" else tag

    def handle_data(self, data: str) -> None:
        if self._inside == "data":
            self._data += data
        elif self._inside not in ("script", "style"):
            self.text += data


def _put_public(folder: Path) -> None:
    for path in PUBLIC:
        place = folder / path.name.split("__")[0]
        place.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, place)


def _need_public() -> None:
    if not PUBLIC and "CI" not in os.environ:
        pytest.skip("../shared is not here")
    assert len(PUBLIC) == len(FILES)


@pytest.fixture(scope="module")
def together(tmp_path_factory, small_fleet) -> Outputs:
    """The public files among the fleet's, from reading to translation."""
    _need_public()
    folder = tmp_path_factory.mktemp("public")
    raw = folder / "data" / "01_raw" / "tir"
    shutil.copytree(small_fleet / "data" / "01_raw" / "tir", raw)
    _put_public(raw)
    done = kedro_here(folder, "--pipelines", "ingest_tir,dedupe_filter,normalize,translate")
    assert done.returncode == 0, done.stdout + done.stderr
    return Outputs(folder)


@pytest.fixture(scope="module")
def asked(tmp_path_factory, together, small_fleet) -> Outputs:
    """The same with classification asked for, and files of a known supplier in a folder of no category."""
    folder = tmp_path_factory.mktemp("asked")
    shutil.copytree(together.data, folder / "data")
    source = folder / "data" / "incoming"
    _put_public(source)
    shutil.copytree(small_fleet / "data" / "01_raw" / "evaluation" / "hidden" / "B", source / "new")
    wanted = f"tir_folder={source},translate.classify=true,translate.farthest=3"
    nodes = ",".join(f"translation.{name}" for name in WITHOUT_FIT)
    done = kedro_here(folder, "--pipeline", "translate", "--nodes", nodes, "--params", wanted)
    assert done.returncode == 0, done.stdout + done.stderr
    return Outputs(folder)


def says_nothing_of(found: Outputs, file: str) -> None:
    """Supplier, verdict, error, distance and band of a file of an unknown supplier, in all places."""
    row = found.report.loc[file]
    assert (row["source"], row["supplier_known"], row["verdict"]) == (
        "unknown",
        "unknown",
        "unknown supplier",
    )
    assert row[list(NO_NUMBERS)].isna().all()
    assert row[list(NO_WORDS)].isna().all()
    assert file not in set(found.bands["file"])
    assert file not in set(found.coefficients["file"])
    assert file not in found.files
    cells = found.page.rows[file]
    folder = file.split("/")[0]
    assert (cells["supplier"], cells["known"], cells["verdict"]) == (folder, "unknown", "unknown supplier")
    assert cells["distance"] is cells["ratio"] is None
    assert (cells["reason"], cells["changes"], cells["bias"]) == (row["reason"], "", "")
    assert not re.search(r"error|%|bias\b|unbiased", row["reason"])


@pytest.mark.parametrize("file", FILES)
def test_a_public_file_is_of_an_unknown_supplier_and_nothing_else_is_said(together, file):
    says_nothing_of(together, file)
    assert together.report.loc[file, "reason"] == (
        f"its folder '{file.split('/')[0]}' is no known category ({', '.join(KNOWN)}): train again with "
        "enough files of this supplier in a folder of its own (filter_report.csv says which were not used, "
        "and why), or ask for classification by --params translate.classify=true"
    )


@pytest.mark.parametrize("file", FILES)
def test_a_public_file_is_given_to_no_category_when_asked(asked, file):
    says_nothing_of(asked, file)
    assert re.fullmatch(
        r"given to no category: if its supplier were one of the known ones, it would be [A-F] \(calibrated "
        r"probability (above 0\.99|0\.\d\d), 0\.95 is needed\), and its typicality among [A-F]'s files is "
        r"0\.0\d \(0\.1 is needed\); put training files of this supplier into a folder of its own and train "
        r"again",
        asked.report.loc[file, "reason"],
    )


def test_files_of_a_known_supplier_are_given_to_it_when_asked(asked):
    own = asked.report[asked.report.index.str.startswith("new/")]
    given = own[own["supplier_known"] != "unknown"]
    assert len(given) >= 0.8 * len(own)
    assert set(given["source"]) == {"B"}
    assert (
        given["supplier_known"]
        .str.fullmatch(r"classified \(probability (above 0\.99|0\.9\d), typicality [01]\.\d\d\)")
        .all()
    )
    for file, row in given[given["verdict"] == "translated"].iterrows():
        assert asked.header(file)["source category"] == f"B ({row['supplier_known']})"
    assert "A laboratory that copies" in asked.page.text


def test_the_users_own_files_come_first_on_the_page(together):
    own = [file for file, row in together.page.rows.items() if row["own"]]
    assert set(own) == set(FILES)
    assert list(together.page.rows)[: len(own)] == own
    assert set(together.page.rows) == set(together.report.index)


def test_what_is_said_of_the_fleets_files(together):
    report = together.report.drop(index=list(FILES))
    assert set(report["verdict"]) <= VERDICTS
    known = report["source"].isin(KNOWN)
    assert (report.loc[known, "supplier_known"] == "by its folder").all()
    assert (report.loc[~known, ["supplier_known", "verdict"]] == ["unknown", "unknown supplier"]).all(
        axis=None
    )
    assert set(report.index[~known].str[0]) == {"G", "H", "I", "J", "K"}
    assert (report.loc[report["source"] == "D", "reason"] == "it is the target's own").all()
    unbiased = (report["verdict"] == "already unbiased") & (report["source"] != "D")
    assert report.loc[unbiased, "reason"].str.contains("contains zero").all()
    judged = report[report["distance"].notna()]
    far = judged["distance"] > 1.0
    assert judged.loc[~far, "bias_band"].str.fullmatch(BAND).all()
    assert judged.loc[far, "bias_band"].isna().all()
    assert (judged.loc[far, "verdict"] == "refused").all()
    assert judged.loc[far, "reason"].str.contains("outside of what D has measured").all()
    no_figure = report["verdict"].isin(["refused", "unknown supplier"])
    assert report.loc[no_figure, ["expected_rms_ratio", "harm_probability"]].isna().all(axis=None)
    assert {together.page.rows[file]["ratio"] for file in report.index[no_figure]} == {None}


def test_what_is_said_of_a_translated_file_agrees_everywhere(together):
    translated = together.report[together.report["verdict"] == "translated"]
    assert len(translated) > 100
    assert set(together.files) == set(translated.index)
    assert set(together.bands["file"]) == set(translated.index)
    assert (together.bands["low"] < together.bands["high"]).any()
    assert np.isfinite(together.bands[["low", "middle", "high"]]).all(axis=None)
    for file, row in translated.iterrows():
        ratio = row["expected_rms_ratio"]
        assert 0.0 < ratio < 1.0
        assert row["reason"] == f"expected RMS error {ratio:.0%} of the unchanged file's"
        header = together.header(file)
        assert header["verdict"] == f"translated: {row['reason']}"
        assert header["source category"] == f"{row['source']} (by its folder)"
        assert header["distance to the training data"] == f"{row['distance']:.2f} (1 is its edge)"
        assert header[f"bias of {row['source']} against D (90% band)"] == row["bias_band"]
        cells = together.page.rows[file]
        assert (cells["supplier"], cells["known"]) == (row["source"], "by its folder")
        assert cells["verdict"] == "translated"
        assert cells["distance"] == pytest.approx(row["distance"], rel=0.005)
        assert cells["ratio"] == pytest.approx(ratio, rel=0.005)
        assert (cells["reason"], cells["changes"]) == (row["reason"], row["changes"])
        assert cells["bias"] == row["bias_band"]


def test_what_a_translation_takes_off_lies_within_the_band_of_the_bias(together):
    checked = 0
    for _, row in together.report[together.report["verdict"] == "translated"].iterrows():
        bands = row["bias_band"].split(", ")
        ends = {part: [float(n) for n in re.findall(r"([+-]\d+\.\d)%", bands[k])] for k, part in KEY_WORDS}
        for size, way, part in SAID.findall(row["changes"]):
            low, high = ends[part]
            change = float(size) / 100.0 * (1 if way == "more" else -1)
            assert low <= 100.0 * (1.0 / (1.0 + change) - 1.0) <= high, row["changes"]
            checked += 1
    assert checked > 400


def test_the_page_says_which_error_and_how_far_files_are_written(together, asked):
    for page in (together.page.text, asked.page.text):
        assert "Errors are RMS of side and longitudinal force" in page
        assert not re.search(r"squared|expected ratio", page)
    assert "none beyond distance 1, the edge of the training data" in together.page.text
    assert "none beyond distance 3, as asked for" in asked.page.text
