"""What a fit reports has the right sign, names the right channel, and the ranges that the version knows."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.magic_formula import PoorFitWarning, TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.magic_formula.fitting.report.statistics import residual_table
from tire_pipeline.magic_formula.fitting.report.valid_ranges import with_measured_ranges
from tire_pipeline.magic_formula.fitting.setup.lone_points import without_lone_points

TIRE = TireModel.from_coefficients(
    {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2, "UNLOADED_RADIUS": 0.3}
    | {"PCX1": 1.6, "PDX1": 1.1, "PKX1": 25.0}
)


def points() -> pd.DataFrame:
    slip, load = np.tile(np.linspace(-0.2, 0.2, 25), 3), np.repeat([2000.0, 4000.0, 6000.0], 25)
    table = pd.DataFrame({"slip_angle": slip, "slip_ratio": 0.0, "camber": 0.0, "normal_load": load})
    return table.assign(
        speed=16.7, pressure=220e3, fy=TIRE.forces(slip_angle=slip, normal_load=load, limits="ignore").fy
    )


def test_a_bias_is_the_model_minus_the_measurement():
    table = points()
    at = {name: table[name].to_numpy() for name in table.columns.drop("fy")}
    found = residual_table(TIRE, at, {"fy": table["fy"].to_numpy() - 100.0})
    assert found["bias"].to_numpy() == pytest.approx(100.0)
    assert found["count"].tolist() == [25, 25, 25]
    assert found["normal_load"].tolist() == [2000.0, 4000.0, 6000.0]


@pytest.mark.parametrize(("version", "stated"), [("5.2", False), ("PAC2002", False), ("6.1", True)])
def test_a_range_of_pressures_is_stated_where_the_version_depends_on_the_pressure(version, stated):
    tire = TireModel.from_coefficients({**TIRE.coefficients, "NOMPRES": 220e3}, version)
    table = points().assign(pressure=np.linspace(200e3, 240e3, 75))
    ranged = with_measured_ranges(tire, table)
    assert ("PRESMIN" in ranged.coefficients) == stated
    assert ranged.ranges["normal_load"][2:] == (2000.0, 6000.0)


def test_a_lone_point_is_named_and_left_out_by_its_own_row_where_others_are_missing():
    table = points()
    force = table["fy"].to_numpy() + 5.0 * np.random.default_rng(0).standard_normal(75)
    force[:20] = np.nan
    row = 30
    force[row] = -force[row]
    at = {name: table[name].to_numpy() for name in table.columns.drop("fy")}
    left, remarks = without_lone_points(at, {"fy": force})
    assert np.flatnonzero(np.isnan(left["fy"])).tolist() == [*range(20), row]
    assert len(remarks) == 1
    assert f"row {row}," in remarks[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"camber": np.tile([-2.0, 0.0, 2.0], 25)}, "camber looks like degrees"),
        ({"slip_ratio": np.tile([-3.0, 0.0, 0.0], 25)}, "slip_ratio looks like percent"),
    ],
)
def test_the_channel_in_another_unit_is_named(change, said):
    """Three percent of slip are no -3, at which a wheel turned backwards."""
    with pytest.warns(PoorFitWarning, match=said):
        fit = fit_magic_formula(points().assign(**change), starts=1)
    assert f"fy: POOR FIT, not to be used: {fit.poor['fy']}" in fit.summary()


@pytest.mark.slow
def test_a_moment_with_an_arm_longer_than_a_wheel_is_of_another_unit():
    """Forces in kN labelled N: the fit of Fy was as good as ever, and Mz "something that is not steady"."""
    table = points()
    table = table.assign(fy=1e-3 * table["fy"], normal_load=1e-3 * table["normal_load"]).drop(
        columns="pressure"
    )
    mz = -0.03 * 1e3 * table["fy"] * np.exp(-np.abs(table["slip_angle"]) / 0.06)
    with pytest.warns(PoorFitWarning, match="arm of .* m over the forces, longer than any wheel's radius"):
        fit_magic_formula(table.assign(mz=mz), starts=1)


@pytest.mark.slow
@pytest.mark.parametrize("sign", [-1.0, 0.0, 1.0])
def test_slip_angles_of_one_sign_leave_the_asymmetry_open(sign):
    table = points()
    fit = fit_magic_formula(table[table["slip_angle"] * sign >= 0.0], starts=1)
    told = [text for text in fit.undetermined if text.startswith("slip angles of one sign only: ")]
    assert len(told) == (0 if sign == 0.0 else 1)
    assert "POOR FIT" not in fit.summary()
