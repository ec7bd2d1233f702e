"""Forces against tables computed by other people's software.

196 points of four tires lie beside this file. The whole tables, 11 tires, are in shared/reference_forces.
"""

import json
import os
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.magic_formula import TireModel

SHIPPED = Path(__file__).with_name("reference_points")
WHOLE = Path(__file__).resolve().parents[2].parent / "shared" / "reference_forces"
TABLES = {path.stem: path.with_suffix("") for path in sorted(WHOLE.glob("*.json"))}
TABLES.update({f"{path.stem}, shipped": path.with_suffix("") for path in sorted(SHIPPED.glob("*.json"))})

OF_52 = [name for name in TABLES if not name.startswith(("mfeval_MagicFormula61", "mfeval_MagicFormula62"))]
OF_6 = [name for name in TABLES if name not in OF_52]
WITH_ROLLING_RESISTANCE = [name for name in TABLES if "335" not in name]
WITH_OVERTURNING_OF_52 = [name for name in TABLES if name == "mfeval_MagicFormula52"]
needs_the_whole = pytest.mark.skipif(
    not WHOLE.is_dir() and not os.environ.get("CI"), reason=f"the whole reference tables are not at {WHOLE}"
)


def version_of(parameters: dict) -> str:
    return {6: "5.2", 61: "6.1", 62: "6.2"}[int(parameters["FITTYP"])]


@cache
def load(name: str):
    parameters = json.loads(TABLES[name].with_suffix(".json").read_text())
    table = pd.read_csv(TABLES[name].with_suffix(".csv"))
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


def test_four_tires_are_shipped():
    shipped = [name for name in TABLES if name.endswith("shipped")]
    assert len(shipped) == 4
    assert sum(len(load(name)[1]) for name in shipped) == 196


@needs_the_whole
def test_the_whole_tables_hold_eleven_tires():
    assert len(list(WHOLE.glob("*.json"))) == 11


@needs_the_whole
@pytest.mark.parametrize("name", [path.stem for path in sorted(SHIPPED.glob("*.json"))])
def test_shipped_points_are_rows_of_the_whole_tables(name):
    rows = (WHOLE / f"{name}.csv").read_text().splitlines()
    assert set((SHIPPED / f"{name}.csv").read_text().splitlines()) <= set(rows)
    assert (SHIPPED / f"{name}.json").read_text() == (WHOLE / f"{name}.json").read_text()


@pytest.mark.parametrize("name", TABLES)
def test_forces_agree_with_the_tables(name):
    _, table, forces = load(name)
    assert relative_error(forces.fx, table["Fx_N"]) < 1e-9
    assert relative_error(forces.fy, table["Fy_N"]) < 1e-9


@pytest.mark.parametrize("name", OF_52)
def test_52_agrees_with_a_second_authors_code(name):
    model, table, forces = load(name)
    assert model.family == 5
    assert relative_error(forces.fx, table["Fx52lit_N"]) < 1e-9
    assert relative_error(forces.fy, table["Fy52lit_N"]) < 1e-9
    assert relative_error(forces.mz, table["Mz52lit_Nm"]) < 1e-9


@pytest.mark.parametrize("name", OF_6)
def test_moments_of_6_agree_with_the_tables(name):
    model, table, forces = load(name)
    assert model.family == 6
    assert relative_error(forces.mz, table["Mz_Nm"]) < 5e-7
    assert relative_error(forces.mx, table["Mx_Nm"]) < 1e-9


@pytest.mark.parametrize("name", TABLES)
def test_what_else_the_tables_hold_agrees(name):
    _, table, forces = load(name)
    assert relative_error(forces.friction_x, table["mux"]) < 1e-9
    assert relative_error(forces.friction_y, table["muy"]) < 1e-9
    assert relative_error(forces.cornering_stiffness, table["Kya_N_per_rad"]) < 1e-9
    assert relative_error(forces.slip_stiffness, table["Kxk_N"]) < 1e-9
    # MFeval adds 1e-6 to denominators in t: the tolerance of Mz of 6.x
    assert relative_error(forces.trail, table["t_m"]) < 5e-7


@pytest.mark.parametrize("name", WITH_ROLLING_RESISTANCE)
def test_rolling_resistance_agrees_where_the_file_gives_it(name):
    model, table, forces = load(name)
    assert model.value("QSY1") != 0
    assert relative_error(forces.my, table["My_Nm"]) < 1e-9


@pytest.mark.parametrize("name", WITH_OVERTURNING_OF_52)
def test_overturning_of_52_agrees_where_lambda_mx_is_one(name):
    # the software behind the tables applies LMX to QSX1 as well; (A.70) does not
    _, table, forces = load(name)
    assert relative_error(forces.mx, table["Mx52lit_Nm"]) < 1e-9
