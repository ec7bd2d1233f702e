"""A wrong point of a table: a turned sign, a zero or a digit too many turns no fit."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.magic_formula import TireModel, fit_magic_formula
from tire_pipeline.recordings import read_recording

pytestmark = pytest.mark.slow

TYDEX = Path(__file__).resolve().parents[2].parent / "shared" / "recordings" / "tydex"
WRONG = {"turned sign": lambda f: -f, "zero": lambda f: 0.0, "a digit too many": lambda f: 10.0 * f}
TIRE = TireModel.from_coefficients(
    {"FNOMIN": 4000.0, "PCY1": 1.4, "PDY1": 1.0, "PDY2": -0.1, "PEY1": -0.5, "PKY1": -18.0, "PKY2": 1.8}
    | {"PCX1": 1.6, "PDX1": 1.1, "PEX1": 0.1, "PKX1": 22.0, "PKX3": 0.2},
    version="5.2",
)


def points(slip="slip_angle", force="fy"):
    """25 slips at three loads, with the noise of a rig."""
    slips = np.radians(np.arange(-12.0, 13.0)) if slip == "slip_angle" else np.linspace(-0.12, 0.12, 25)
    s, load = (x.ravel() for x in np.meshgrid(slips, [2e3, 4e3, 6e3]))
    true = getattr(TIRE.forces(**{slip: s}, normal_load=load), force)
    noise = 30.0 * np.random.default_rng(0).standard_normal(s.size)
    return pd.DataFrame({slip: s, "normal_load": load, force: true + noise})


def left(model, table, force):
    inputs = {n: table[n] for n in ("slip_angle", "slip_ratio", "camber", "normal_load") if n in table}
    found = getattr(model.forces(**inputs, limits="ignore"), force)
    return float(np.sqrt(np.mean((found - table[force]) ** 2)))


@pytest.mark.parametrize("wrong", WRONG)
@pytest.mark.parametrize(("slip", "force"), [("slip_angle", "fy"), ("slip_ratio", "fx")])
def test_one_wrong_point_of_a_table_is_left_out_and_named(wrong, slip, force):
    table = points(slip, force)
    row = int(table[force].idxmax())
    bad = table.copy()
    bad.loc[row, force] = WRONG[wrong](table.loc[row, force])
    before = bad.copy()
    fit = fit_magic_formula(bad, starts=4)
    assert left(fit.model, table, force) < 1.05 * left(fit_magic_formula(table, starts=4).model, table, force)
    (said,) = [note for note in fit.notes if "unlike the points around it" in note]
    assert f"row {row}," in said
    assert not fit.poor
    pd.testing.assert_frame_equal(bad, before)


@pytest.mark.skipif(not TYDEX.exists(), reason="needs the shared recordings")
@pytest.mark.parametrize("wrong", WRONG)
@pytest.mark.parametrize("row", [57, 52, 92, 90])
def test_one_wrong_point_of_a_real_tire_turns_no_fit(wrong, row):
    """The largest, two large and a small one of 111: up to 5,826 N were left, and 63 N without it."""
    table = read_recording(TYDEX / "DT_195_65R15_demo.tdx")
    table = table[["slip_angle", "camber", "normal_load", "fy"]]
    bad = table.copy()
    bad.loc[row, "fy"] = WRONG[wrong](table.loc[row, "fy"])
    assert left(fit_magic_formula(bad, starts=4).model, table, "fy") < 70.0


@pytest.mark.parametrize("change", [{}, {"PVY1": 0.05}, {"PDY2": -0.3}, {"PEY1": -4.0}, {"PHY1": 0.01}])
@pytest.mark.parametrize("loads", [[4e3], [1e3, 2e3, 4e3, 8e3]])
@pytest.mark.parametrize("most", [3.0, 12.0, 30.0])
def test_nothing_is_left_out_of_what_a_tire_does(change, loads, most):
    slip, load = (x.ravel() for x in np.meshgrid(np.radians(np.linspace(-most, most, 25)), loads))
    force = TIRE.replace(**change).forces(slip_angle=slip, normal_load=load, limits="ignore").fy
    table = pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": force})
    fit = fit_magic_formula(table, starts=1)
    assert not [note for note in fit.notes if "unlike" in note]
