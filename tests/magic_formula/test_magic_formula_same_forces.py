"""Changes to a model that must not change its forces: nominal load, version, packing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from magic_formula_tires import tire_52, tire_61

from tire_pipeline.errors import TirShapeError, TirValueError, TirVersionError
from tire_pipeline.magic_formula import TireModel, forces_batch, model_of, pack, pack_matrix
from tire_pipeline.magic_formula.changes.convert import conversion_notes, to_version
from tire_pipeline.magic_formula.equations.numpy_form import OUTPUTS

TIRES = {"5.2": tire_52(), "6.1": tire_61()}
RNG = np.random.default_rng(0)
COUNT = 400
POINTS = {
    "slip_angle": RNG.uniform(-0.4, 0.4, COUNT),
    "slip_ratio": RNG.uniform(-0.8, 0.8, COUNT),
    "camber": RNG.uniform(-0.15, 0.15, COUNT),
    "speed": RNG.uniform(1, 50, COUNT),
}
each_tire = pytest.mark.parametrize("tire", TIRES.values(), ids=TIRES.keys())


def largest_change(one: TireModel, other: TireModel, load, names=OUTPUTS, **more) -> dict[str, float]:
    points = {**POINTS, "normal_load": load, "limits": "ignore", **more}
    before, after = one.forces(**points), other.forces(**points)
    return {
        name: float(np.abs(getattr(before, name) - getattr(after, name)).max())
        / max(float(np.abs(getattr(before, name)).max()), 1e-9)
        for name in names
    }


@each_tire
@settings(max_examples=60, deadline=None)
@given(ratio=st.floats(0.1, 10.0), seed=st.integers(0, 10_000), scale=st.floats(0.5, 2.0))
def test_another_nominal_load_changes_nothing(tire, ratio, seed, scale):
    rng = np.random.default_rng(seed)
    shaken = tire.replace(
        **{
            name: value * rng.uniform(0.7, 1.3)
            for name, value in tire.coefficients.items()
            if name[0] in "PQRS" and name not in ("PCX1", "PCY1", "PRESMIN")
        },
        LFZO=scale,
    )
    new = shaken.nominal_load_changed(ratio * shaken.value("FNOMIN"))
    assert new.value("FNOMIN") == pytest.approx(ratio * shaken.value("FNOMIN"))
    load = rng.uniform(0.05, 2.5, COUNT) * shaken.value("FNOMIN")
    assert max(largest_change(shaken, new, load).values()) < 1e-9


def test_another_nominal_load_changes_nothing_under_turn_slip():
    tire = TIRES["6.1"]
    changed = largest_change(tire, tire.nominal_load_changed(9000.0), 3500.0, turn_slip=0.03)
    assert max(changed.values()) < 1e-9


def test_only_coefficients_that_must_change_appear():
    tire = TireModel.from_coefficients({"FNOMIN": 4000.0, "PCY1": 1.3, "PDY1": 1.0}, "5.2")
    assert set(tire.nominal_load_changed(5000.0).coefficients) == set(tire.coefficients)
    with pytest.raises(TirValueError, match="positive"):
        tire.nominal_load_changed(0.0)


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_a_52_model_written_as_61_has_the_same_forces(seed):
    rng = np.random.default_rng(seed)
    tire = TIRES["5.2"]
    shaken = tire.replace(
        **{
            name: value * rng.uniform(0.6, 1.4)
            for name, value in tire.coefficients.items()
            if name != "LONGVL"
        }
    )
    load = rng.uniform(0.05, 2.5, COUNT) * shaken.value("FNOMIN")
    converted = to_version(shaken, "6.1")
    assert converted.version == "6.1"
    assert max(largest_change(shaken, converted, load).values()) < 1e-9


def test_without_extensions_only_mz_at_camber_differs():
    tire = TIRES["5.2"].replace(PHY3=0.0)
    plain = to_version(tire, "6.1").replace(QYZ1=0.0)
    changed = largest_change(tire, plain, 4000.0)
    assert changed.pop("mz") > 1e-3
    assert max(changed.values()) < 1e-9
    assert largest_change(tire, plain, 4000.0, camber=0.0)["mz"] < 1e-9
    assert [note.split()[0] for note in conversion_notes(tire, "6.1")] == ["QYZ1"]
    assert [note.split()[0] for note in conversion_notes(TIRES["5.2"], "6.1")] == ["PHY3", "QYZ1"]


def test_versions_of_one_family_only_change_their_name():
    assert to_version(TIRES["5.2"], "PAC2002").coefficients == TIRES["5.2"].coefficients
    assert to_version(TIRES["6.1"], "6.2").version == "6.2"
    assert conversion_notes(TIRES["6.1"], "6.2") == []
    with pytest.raises(TirVersionError, match=r"6\.1 model cannot be written as 5\.2"):
        to_version(TIRES["6.1"], "5.2")


@each_tire
def test_batch_is_the_models_one_by_one(tire):
    others = [tire, tire.replace(PDY1=0.8), tire.replace(PKY1=-15.0, QSY1=0.02)]
    matrix = np.stack([pack(each) for each in others])
    points = {**POINTS, "normal_load": 3500.0}
    found = forces_batch(matrix, **points, version=tire.version, outputs=OUTPUTS)
    for row, each in enumerate(others):
        single = each.forces(**points, limits="ignore")
        for name in OUTPUTS:
            np.testing.assert_allclose(found[name][row], getattr(single, name), rtol=1e-12, atol=1e-12)
    own = np.linspace(2000, 5000, 3)[:, None] * np.ones(COUNT)
    by_tire = forces_batch(matrix, **POINTS, normal_load=own, version=tire.version)
    single = others[2].forces(**POINTS, normal_load=own[2], limits="ignore")
    np.testing.assert_allclose(by_tire["fy"][2], single.fy, rtol=1e-12)


@each_tire
def test_packing_and_unpacking_is_the_same_tire(tire):
    again = model_of(pack(tire), tire.version)
    assert max(largest_change(tire, again, 4000.0).values()) == 0
    names = list(tire.coefficients)
    matrix = pack_matrix([[tire.coefficients[n] for n in names]], names, tire.version)
    np.testing.assert_array_equal(matrix[0], pack(tire))


def test_packing_names_what_is_wrong():
    with pytest.raises(TirShapeError, match="2 names"):
        pack_matrix(np.ones((3, 3)), ["FNOMIN", "PDY1"])
    with pytest.raises(TirValueError, match="FNOMIN"):
        pack_matrix(np.array([[np.nan, 1.0]]), ["FNOMIN", "PDY1"])
    with pytest.raises(TirShapeError, match="tires"):
        forces_batch(np.ones((3, 3)), normal_load=1.0)
    matrix = np.stack([pack(TIRES["5.2"])] * 3)
    with pytest.raises(TirShapeError, match="points"):
        forces_batch(matrix, normal_load=np.ones((2, 5)))
