"""What goes in: shapes, ranges, sides, axes, nonsense."""

import copy
import pickle
import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from magic_formula_tires import tire_52, tire_61

from tire_pipeline.errors import TirError, TirShapeError, TirValueError, TirVersionError
from tire_pipeline.magic_formula import (
    DegreesWarning,
    OperatingPoints,
    TireModel,
    TireRangeWarning,
    forces_batch,
    pack,
)
from tire_pipeline.magic_formula.equations.numpy_form import OUTPUTS
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS, PointFields

TIRES = {"5.2": tire_52(), "6.1": tire_61()}
anything = st.floats(allow_nan=False, allow_infinity=False)
each_tire = pytest.mark.parametrize("tire", TIRES.values(), ids=TIRES.keys())


@each_tire
def test_scalars_give_scalars_and_arrays_broadcast(tire):
    one = tire.forces(slip_angle=0.05, normal_load=3000.0)
    assert np.ndim(one.fy) == 0
    grid = tire.forces(slip_angle=np.array([0.0, 0.05])[:, None], normal_load=[1000.0, 2000.0, 3000.0])
    assert grid.fy.shape == (2, 3)
    assert grid.fy[1, 2] == pytest.approx(one.fy, rel=1e-12)
    from_lists = tire.forces(slip_angle=[0.05], normal_load=3000)
    assert from_lists.fy.shape == (1,)
    assert tire.forces(slip_angle=np.empty(0), normal_load=3000.0).fy.shape == (0,)
    strided = np.arange(40.0).reshape(4, 10).T * 1e-3
    np.testing.assert_allclose(
        tire.forces(slip_angle=strided, normal_load=3000.0).fy,
        tire.forces(slip_angle=strided.copy(order="C"), normal_load=3000.0).fy,
        rtol=1e-12,
    )


def test_shapes_that_do_not_fit_are_named():
    with pytest.raises(TirShapeError, match=r"slip_angle \(3,\).*normal_load \(2,\)"):
        TIRES["5.2"].forces(slip_angle=np.zeros(3), normal_load=np.ones(2))


@each_tire
@pytest.mark.parametrize("load", [0.0, -0.0, -3000.0])
def test_no_load_no_force(tire, load):
    forces = tire.forces(slip_angle=[0.05], slip_ratio=0.1, camber=0.02, normal_load=load)
    single = tire.forces(slip_angle=0.05, slip_ratio=0.1, camber=0.02, normal_load=load)
    for name in OUTPUTS:
        assert getattr(forces, name)[0] == 0
        assert getattr(single, name) == 0


@each_tire
@settings(max_examples=300, deadline=None)
@given(alpha=anything, kappa=anything, camber=anything, load=anything, speed=anything, pressure=anything)
def test_finite_in_is_finite_out(tire, alpha, kappa, camber, load, speed, pressure):
    point = {"slip_angle": alpha, "slip_ratio": kappa, "camber": camber}
    point.update(normal_load=load, speed=speed, pressure=pressure)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for forces in (tire.forces(**point), tire.forces(**{k: [v] for k, v in point.items()})):
            for name in OUTPUTS:
                assert not np.isnan(getattr(forces, name)).any(), name


@each_tire
@settings(max_examples=100, deadline=None)
@given(
    alpha=st.floats(-1.5, 1.5),
    kappa=st.floats(-1, 5),
    camber=st.floats(-1, 1),
    load=st.floats(-100, 1e6),
    turn=st.floats(-1, 1),
)
def test_turn_slip_gives_numbers(tire, alpha, kappa, camber, load, turn):
    forces = tire.forces(
        slip_angle=alpha, slip_ratio=kappa, camber=camber, normal_load=load, turn_slip=turn, limits="ignore"
    )
    assert np.isfinite([forces.fx, forces.fy, forces.mx, forces.my, forces.mz]).all()


def test_turn_slip_turns_the_tire_towards_the_turn_as_camber_does():
    tire = TIRES["6.1"]
    straight = tire.forces(normal_load=4000.0)
    left = tire.forces(normal_load=4000.0, turn_slip=0.02)
    leaning_left = tire.forces(normal_load=4000.0, camber=-0.02)
    assert np.sign(left.fy - straight.fy) == np.sign(leaning_left.fy - straight.fy) == 1
    tiny = tire.forces(normal_load=4000.0, turn_slip=1e-9)
    assert tiny.fy == pytest.approx(straight.fy, abs=1e-2)


def test_not_a_number_stays_visible():
    forces = TIRES["5.2"].forces(slip_angle=[0.1, np.nan], normal_load=3000.0)
    assert np.isfinite(forces.fy[0])
    assert np.isnan(forces.fy[1])


def test_degrees_draw_a_warning():
    with pytest.warns(DegreesWarning, match="1 of 2 values are beyond 1.6 rad: this looks like degrees"):
        TIRES["5.2"].forces(slip_angle=[0.1, 5.0], normal_load=3000.0)


def test_ranges_warn_once_with_the_count_and_never_clip():
    tire = TIRES["5.2"].replace(ALPMIN=-0.2, ALPMAX=0.2, FZMIN=500.0, FZMAX=5000.0)
    points = {"slip_angle": [0.1, 0.3, -0.4], "normal_load": [3000.0, 3000.0, 6000.0]}
    with pytest.warns(TireRangeWarning) as caught:
        forces = tire.forces(**points)
    assert len(caught) == 1
    assert "slip_angle: 2 of 3 outside" in str(caught[0].message)
    assert "normal_load: 1 of 3" in str(caught[0].message)
    np.testing.assert_array_equal(forces.fy, TIRES["5.2"].forces(**points, limits="ignore").fy)


@pytest.mark.parametrize(
    ("point", "said"),
    [
        ({"slip_angle": 0.3, "normal_load": 3000.0}, "slip_angle: 1 of 1 outside"),
        ({"slip_angle": -0.3, "normal_load": 3000.0}, "slip_angle: 1 of 1 outside"),
        ({"slip_angle": 0.1, "normal_load": 6000.0}, "normal_load: 1 of 1 outside"),
        ({"slip_angle": 0.1, "normal_load": 3000.0}, None),
    ],
)
def test_a_single_point_outside_of_the_ranges_is_told_as_an_array_is(point, said):
    tire = TIRES["5.2"].replace(ALPMIN=-0.2, ALPMAX=0.2, FZMIN=500.0, FZMAX=5000.0)
    for each in (point, {name: [value] for name, value in point.items()}):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            tire.forces(**each)
        assert [said in str(one.message) for one in told] == ([True] if said else [])


def test_limits_clip_or_raise_on_request():
    tire = TIRES["5.2"].replace(ALPMIN=-0.2, ALPMAX=0.1)
    clipped = tire.forces(slip_angle=[0.3, -0.4], normal_load=3000.0, limits="clip")
    at_limit = tire.forces(slip_angle=[0.1, -0.2], normal_load=3000.0)
    np.testing.assert_array_equal(clipped.fy, at_limit.fy)
    mirrored = tire.forces(slip_angle=[-0.3], normal_load=3000.0, limits="clip", side="right")
    assert mirrored.fy[0] == -at_limit.fy[0]
    with pytest.raises(TirValueError, match="slip_angle: 1 of 1 outside"):
        tire.forces(slip_angle=0.3, normal_load=3000.0, limits="raise")
    with pytest.raises(TirValueError, match="limits"):
        tire.forces(slip_angle=0.3, normal_load=3000.0, limits="maybe")
    assert tire.forces(normal_load=-1.0, limits="clip").fy == 0


@each_tire
def test_the_right_side_is_the_mirror_image(tire):
    point = {"slip_ratio": 0.05, "normal_load": 3000.0}
    left = tire.forces(slip_angle=0.05, camber=0.03, **point)
    right = tire.forces(slip_angle=-0.05, camber=-0.03, side="right", **point)
    for name, sign in {"fx": 1, "fy": -1, "mx": -1, "my": 1, "mz": -1, "trail": 1}.items():
        assert getattr(right, name) == pytest.approx(sign * getattr(left, name), rel=1e-12)
    same = tire.forces(slip_angle=0.05, camber=0.03, side="left", **point)
    assert same.fy == pytest.approx(left.fy, rel=1e-12)
    measured_right = TireModel(
        version=tire.version, coefficients=tire.coefficients, metadata={"MODEL.TYRESIDE": "'RIGHT'"}
    )
    kept = measured_right.forces(slip_angle=0.05, camber=0.03, side="right", **point)
    assert kept.fy == pytest.approx(left.fy, rel=1e-12)


@each_tire
def test_axis_systems_say_the_same_in_their_own_signs(tire):
    point = {"slip_ratio": 0.05, "normal_load": 3000.0, "camber": 0.03}
    iso = tire.forces(slip_angle=0.05, **point)
    sae = tire.forces(slip_angle=-0.05, axes="SAE", **point)
    adapted = tire.forces(slip_angle=0.05, axes="adapted SAE", **point)
    for other in (sae, adapted):
        assert other.fx == pytest.approx(iso.fx, rel=1e-12)
        for name in ("fy", "my", "mz"):
            assert getattr(other, name) == pytest.approx(-getattr(iso, name), rel=1e-12)
        assert other.mx == pytest.approx(iso.mx, rel=1e-12)
        assert other.trail == pytest.approx(iso.trail, rel=1e-12)
    # the slope of Fy over the slip angle: negative in ISO and SAE, positive in adapted SAE
    assert iso.cornering_stiffness == sae.cornering_stiffness == -adapted.cornering_stiffness < 0
    with pytest.raises(TirValueError, match="axis system"):
        tire.forces(normal_load=3000.0, axes="DIN")


@pytest.mark.parametrize(
    ("key", "value"),
    [("FNOMIN", 0.0), ("FNOMIN", -1.0), ("PCY1", 0.0), ("PCX1", 0.0), ("PDY1", np.nan), ("PDY1", "x")],
)
def test_impossible_coefficients_are_named(key, value):
    with pytest.raises(TirValueError, match=key) as caught:
        TireModel.from_coefficients({**TIRES["5.2"].coefficients, key: value}, "5.2")
    assert caught.value.key == key
    assert isinstance(caught.value, TirError)


def test_missing_nominal_load_and_unknown_names_are_errors():
    with pytest.raises(TirValueError, match="FNOMIN"):
        TireModel.from_coefficients({"PCY1": 1.3}, "5.2")
    with pytest.raises(TirVersionError, match="7"):
        TireModel.from_coefficients({"FNOMIN": 1.0}, "7.0")
    with pytest.raises(TirValueError, match="outputs"):
        TIRES["5.2"].forces(normal_load=1.0, outputs=["fz"])
    with pytest.raises(TirValueError, match="camber is not numeric"):
        TIRES["5.2"].forces(normal_load=1.0, camber="much")


def test_what_is_missing_is_listed_with_what_stands_in():
    tire = TireModel.from_coefficients(
        {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}, "6.1"
    )
    assert tire.defaulted["PKY4"] == 2
    assert tire.defaulted["LMUY"] == 1
    assert tire.defaulted["PDX1"] == 0
    assert "PCY1" not in tire.defaulted
    assert "PHY3" not in tire.defaulted
    assert "LMUY" not in tire.replace(LMUY=0.9).defaulted


def test_a_model_survives_copying_and_pickling():
    tire = TIRES["6.1"]
    assert copy.deepcopy(tire).coefficients == tire.coefficients
    again = pickle.loads(pickle.dumps(tire))
    assert again.version == tire.version
    assert again.coefficients == tire.coefficients
    assert again.defaulted == tire.defaulted


def test_only_the_outputs_asked_for_are_there():
    forces = TIRES["5.2"].forces(slip_angle=[0.1], normal_load=3000.0, outputs=("fy",))
    assert forces.fy is not None
    assert forces.mz is None


def test_points_are_one_value_or_keywords_and_nothing_between():
    tire = tire_52()
    points = OperatingPoints(normal_load=3000.0, slip_angle=[0.02, 0.05], camber=0.03)
    keywords = {"normal_load": 3000.0, "slip_angle": [0.02, 0.05], "camber": 0.03}
    assert (tire.forces(points).fy == tire.forces(**keywords).fy).all()
    names = ["PKY1", "PDY1"]
    assert (tire.jacobian(names, points)["fy"] == tire.jacobian(names, **keywords)["fy"]).all()
    matrix = pack(tire)[None, :]
    assert (forces_batch(matrix, points)["fy"] == forces_batch(matrix, **keywords)["fy"]).all()
    with pytest.raises(TirValueError, match="slip_angle"):
        tire.forces(points, slip_angle=0.1)
    with pytest.raises(TypeError, match="normal_load"):
        tire.forces(slip_angle=0.1)
    with pytest.raises(TypeError, match="slipangle"):
        tire.forces(slipangle=0.1, normal_load=3000.0)


def test_fields_of_points_are_the_channels_and_turn_slip():
    assert {*POINT_CHANNELS, "turn_slip"} == set(OperatingPoints._fields) == set(PointFields.__annotations__)


def test_turn_slip_is_refused_where_it_is_not_known():
    tire = tire_61()
    for ask in (
        lambda: tire.jacobian(["PKY1"], normal_load=3000.0, turn_slip=0.01),
        lambda: forces_batch(pack(tire)[None, :], normal_load=3000.0, turn_slip=0.01, version="6.1"),
    ):
        with pytest.raises(TirValueError, match="turn slip"):
            ask()
