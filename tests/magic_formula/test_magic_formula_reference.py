"""Forces against tables computed by other people's software (shared/reference_forces)."""

import json
import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.magic_formula import TireModel

FOLDER = Path(__file__).resolve().parents[2].parent / "shared" / "reference_forces"
NAMES = sorted(path.stem for path in FOLDER.glob("*.json"))

if not NAMES and not os.environ.get("CI"):
    pytest.skip(f"no reference forces in {FOLDER}", allow_module_level=True)


def version_of(parameters: dict) -> str:
    return {6: "5.2", 61: "6.1", 62: "6.2"}[int(parameters["FITTYP"])]


def load(name: str):
    parameters = json.loads((FOLDER / f"{name}.json").read_text())
    table = pd.read_csv(FOLDER / f"{name}.csv")
    model = TireModel.from_coefficients(parameters, version=version_of(parameters))
    forces = model.forces(
        slip_angle=table["alpha_rad"],
        slip_ratio=table["kappa"],
        camber=table["gamma_rad"],
        normal_load=table["Fz_N"],
        speed=table["Vx_mps"],
        pressure=table["p_Pa"],
    )
    return model, table, forces


def relative_error(ours, reference) -> float:
    reference = reference.to_numpy()
    return float(np.abs(ours - reference).max() / np.abs(reference).max())


def test_there_are_eleven_tires():
    assert len(NAMES) == 11


@pytest.mark.parametrize("name", NAMES)
def test_forces_agree_with_the_tables(name):
    model, table, forces = load(name)
    is_52 = model.family == 5
    assert relative_error(forces.fx, table["Fx_N"]) < 1e-9
    assert relative_error(forces.fy, table["Fy_N"]) < 1e-9
    if is_52:
        assert relative_error(forces.fx, table["Fx52lit_N"]) < 1e-9
        assert relative_error(forces.fy, table["Fy52lit_N"]) < 1e-9
        assert relative_error(forces.mz, table["Mz52lit_Nm"]) < 1e-9
    else:
        assert relative_error(forces.mz, table["Mz_Nm"]) < 5e-7
        assert relative_error(forces.mx, table["Mx_Nm"]) < 1e-9


@pytest.mark.parametrize("name", NAMES)
def test_what_else_the_tables_hold_agrees(name):
    _, table, forces = load(name)
    assert relative_error(forces.friction_x, table["mux"]) < 1e-9
    assert relative_error(forces.friction_y, table["muy"]) < 1e-9
    assert relative_error(forces.cornering_stiffness, table["Kya_N_per_rad"]) < 1e-9
    assert relative_error(forces.slip_stiffness, table["Kxk_N"]) < 1e-9
    # MFeval adds 1e-6 to denominators in t: the tolerance of Mz of 6.x
    assert relative_error(forces.trail, table["t_m"]) < 5e-7


@pytest.mark.parametrize("name", [n for n in NAMES if "335" not in n])
def test_rolling_resistance_agrees_where_the_file_gives_it(name):
    model, table, forces = load(name)
    assert model.value("QSY1") != 0
    assert relative_error(forces.my, table["My_Nm"]) < 1e-9


@pytest.mark.parametrize("name", [n for n in NAMES if "52" in n and "scaled" not in n])
def test_overturning_of_52_agrees_where_lambda_mx_is_one(name):
    # the software behind the tables applies LMX to QSX1 as well; (A.70) does not
    _, table, forces = load(name)
    assert relative_error(forces.mx, table["Mx52lit_Nm"]) < 1e-9
