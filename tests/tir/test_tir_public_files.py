"""Whole files, those that ship and the 16 public ones: read, evaluated, written back to the byte."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from tir_samples import PUBLIC, SHARED, WHOLE_FILES, need_shared

from tire_pipeline.tir import parse_tir, read_tir, write_tir

pytestmark = pytest.mark.filterwarnings("ignore::tire_pipeline.magic_formula.TireRangeWarning")

VERSIONS = {
    "PAC2002": "PAC2002",
    "MF5.0/5.1 (MF_05)": "5.0",
    "MF5.2": "5.2",
    "MF6.1": "6.1",
    "MF6.2": "6.2",
}
REFERENCES = {
    "projectchrono__chrono__CityBus_Pac02Tire.tir": "chrono_CityBus_Pac02Tire",
    "projectchrono__chrono__Polaris_Pac02Tire.tir": "chrono_Polaris_Pac02Tire",
    "projectchrono__chrono__mf_185_80R14.tir": "chrono_mf_185_80R14",
    "projectchrono__chrono__suv_Pac02Tire.tir": "chrono_suv_Pac02Tire",
    "OpenTire__Sandbox__MagicFormula52_Parameters.tir": "mfeval_MagicFormula52",
    "matheusft__MFeval_julia__MagicFormula61_Parameters.tir": "mfeval_MagicFormula61",
    "matheusft__MFeval_julia__MagicFormula62_Parameters.tir": "mfeval_MagicFormula62",
}
# The reference opened these on purpose, so that no limit acts.
OPENED = {"ALPMIN", "ALPMAX", "CAMMIN", "CAMMAX", "KPUMIN", "KPUMAX", "FZMIN", "FZMAX", "PRESMIN", "PRESMAX"}


def test_there_are_16():
    need_shared()
    assert len(PUBLIC) == 16


def test_versions_are_those_of_the_provenance():
    need_shared()
    with open(SHARED / "tir" / "PROVENANCE.csv", newline="") as stream:
        wanted = {row["file"]: VERSIONS[row["version"]] for row in csv.DictReader(stream)}
    assert {path.name: read_tir(path).version for path in PUBLIC} == wanted


@pytest.mark.parametrize("path", WHOLE_FILES, ids=lambda p: p.name)
def test_forces_are_sensible(path: Path):
    tire = read_tir(path, unloaded_radius=0.3)  # one file states none
    load = tire.coefficients["FNOMIN"]
    slip = np.linspace(-0.25, 0.25, 101)
    lateral = tire.forces(normal_load=load, slip_angle=slip)
    longitudinal = tire.forces(normal_load=load, slip_ratio=slip)
    for each in (lateral, longitudinal):
        for name in ("fx", "fy", "mx", "my", "mz"):
            assert np.isfinite(getattr(each, name)).all()
    assert 0.4 < np.abs(lateral.fy).max() / load < 2.5
    assert 0.4 < np.abs(longitudinal.fx).max() / load < 2.5
    # A positive slip angle pulls to negative Fy, driving slip to positive Fx, in ISO W axes.
    assert lateral.fy[-1] < 0 < lateral.fy[0]
    assert longitudinal.fx[0] < 0 < longitudinal.fx[-1]


@pytest.mark.parametrize("path", WHOLE_FILES, ids=lambda p: p.name)
def test_written_back_to_the_byte(path: Path, tmp_path: Path):
    target = write_tir(read_tir(path), tmp_path / path.name)
    assert target.read_bytes() == path.read_bytes()


@pytest.mark.parametrize("path", WHOLE_FILES, ids=lambda p: p.name)
def test_one_changed_value_changes_one_line(path: Path, tmp_path: Path):
    tire = read_tir(path)
    target = write_tir(tire.replace(PDY1=0.987654321), tmp_path / path.name)
    before, after = path.read_bytes().split(b"\n"), target.read_bytes().split(b"\n")
    different = [(old, new) for old, new in zip(before, after, strict=True) if old != new]
    assert len(different) == 1
    assert b"0.987654321" in different[0][1]
    assert read_tir(target).coefficients == {**tire.coefficients, "PDY1": 0.987654321}


@pytest.mark.parametrize(("file", "reference"), REFERENCES.items())
def test_values_are_those_of_another_reader(file: str, reference: str):
    need_shared()
    tire = read_tir(SHARED / "tir" / file)
    wanted = json.loads((SHARED / "reference_forces" / f"{reference}.json").read_text())
    compared = {key for key in tire.coefficients if key in wanted} - OPENED
    if "NOMPRES" in tire.coefficients and tire.version == "PAC2002":
        compared -= {"NOMPRES", "INFLPRES"}  # it read IP and IP_NOM as keys it does not know
    assert len(compared) > 90
    assert {k: tire.coefficients[k] for k in compared} == {k: wanted[k] for k in compared}


def test_what_the_files_lack_is_listed():
    need_shared()
    tires = {path.name: read_tir(path) for path in PUBLIC}
    brian = tires["BrianN92__Pacejka-tire-model__example.tir"]
    assert "UNLOADED_RADIUS" in brian.defaulted  # its [DIMENSION] is empty
    assert "UNLOADED_RADIUS" not in brian.coefficients
    assert "there is no UNLOADED_RADIUS" in " ".join(brian.metadata["warnings"])
    audi = tires["aunyks__tread__audi-temp.tir"]
    assert {"RBX1", "QSX1", "QSY1"} <= set(audi.defaulted)
    assert "TEMPERATURE_COEFFICIENTS.TX1" in audi.metadata
    for tire in tires.values():
        assert not set(tire.defaulted) & set(tire.coefficients)


def test_contradictions_are_reported():
    need_shared()
    warnings = {path.name: " / ".join(read_tir(path).metadata["warnings"]) for path in PUBLIC}
    both_labels = warnings["projectchrono__chrono__335_65R22_5_G275MSA_60psi.tir"]
    assert "FITTYP says 5.0, which contradicts PAC2002" in both_labels
    assert "[DEFLECTION_LOAD_CURVE] occurs twice (lines 90 and 261)" in both_labels
    later_keys = warnings["TUMFTM__Open-Car-Dynamics__example_road_tire.tir"]
    assert "read as 5.2, but the file has keys that only 6.2 has" in later_keys
    assert warnings["projectchrono__chrono__suv_Pac02Tire.tir"] == ""


def test_nominal_load_and_pressure_outside_of_their_sections():
    need_shared()
    tire = read_tir(SHARED / "tir" / "TUMFTM__Open-Car-Dynamics__example_road_tire.tir")
    assert tire.coefficients["FNOMIN"] == 2500.0  # in [WHEEL]
    assert tire.coefficients["NOMPRES"] == 210000.0  # NORMPRES in [WHEEL]
    assert "MFSIMPLE.PACLONG_FZNOM" in tire.metadata


def test_tables_and_comments():
    need_shared()
    file = parse_tir(SHARED / "tir" / "projectchrono__chrono__335_65R22_5_G275MSA_60psi.tir")
    tables = {table.line: table for table in file.tables}
    names = [table.section for table in file.tables]
    assert names == ["SHAPE", "DEFLECTION_LOAD_CURVE", "BOTTOMING_CURVE", "DEFLECTION_LOAD_CURVE"]
    last = tables[max(tables)]
    assert last.header.split() == ["pen", "fz"]
    assert file.rows(last)[1] == (0.032998745, 17963.35219)
    assert len(file.rows(file.tables[1])) == 21
    dummy = parse_tir(SHARED / "tir" / "ZipsRacingElectric__Vehicle-Dynamics__MF_TDummy.tir")
    assert (11, "'Tire\tMF52 205/60R15 91V, 2.2bar") in dummy.comments
    assert dummy.line_ending == "\n"
    assert file.line_ending == "\r\n"
