import subprocess
import sys

import numpy as np
import pytest
from synthetic_tires import synthetic_table

from tire_pipeline.errors import DomainError
from tire_pipeline.representations import (
    CURVE_LOADS,
    CURVE_SLIP_ANGLES,
    make_representation,
    representation_from_state,
)
from tire_pipeline.representations.coefficients import (
    ALIGNING,
    DATASETS,
    LATERAL,
    LATERAL_WITHOUT_CAMBER,
    LONGITUDINAL,
)
from tire_pipeline.representations.curve_fit import fit_lateral
from tire_pipeline.representations.key_attributes import shape_and_stiffness_factor
from tire_pipeline.representations.lateral_curve import lateral_factors, lateral_force

ALL = [
    ("coefficients", {}),
    ("key_attributes", {}),
    ("power_series", {}),
    ("power_series", {"form": "published"}),
    ("latent", {"epochs": 5}),
]


@pytest.fixture(scope="module")
def table():
    return synthetic_table(120)


def curves_of(table):
    return lateral_force(lateral_factors(table, CURVE_LOADS), CURVE_SLIP_ANGLES)


def test_datasets_have_the_sizes_of_table_4_1():
    sizes = {name: len(names) for name, names in DATASETS.items()}
    assert sizes == {
        "full": 58,
        "longitudinal": 15,
        "lateral": 18,
        "lateral_without_camber": 11,
        "aligning": 25,
    }
    assert len({*LONGITUDINAL, *LATERAL, *ALIGNING}) == 58
    assert set(LATERAL_WITHOUT_CAMBER) < set(LATERAL)


@pytest.mark.parametrize(("name", "options"), ALL)
def test_shapes_and_state_round_trip(table, name, options):
    representation = make_representation(name, **options).fit(table, seed=1)
    features = representation.encode(table)
    assert features.shape == (len(table), len(representation.feature_names))
    assert np.isfinite(features).all()
    assert representation.is_real(features).all()
    again = representation_from_state(representation.to_state())
    np.testing.assert_array_equal(again.encode(table), features)
    part = table.iloc[:5]
    decoded = again.decode(features[:5], part)
    assert list(decoded.columns) == list(table.columns)
    assert representation.decode_curves(features[:5], part).shape == (5, 3, 100)
    kept = [c for c in table.columns if c not in LATERAL_WITHOUT_CAMBER]
    assert decoded[kept].equals(part[kept])


def test_coefficients_come_back_exactly(table):
    representation = make_representation("coefficients")
    assert representation.decode(representation.encode(table), table).equals(table)


def test_curve_of_one_tire_by_hand():
    table = synthetic_table(1)
    row = table.iloc[0]
    load, alpha = 8000.0, 0.1
    dfz = (load - 6000.0) / 6000.0
    peak = (row.PDY1 + row.PDY2 * dfz) * load
    slope = row.PKY1 * 6000.0 * np.sin(2 * np.arctan(load / (row.PKY2 * 6000.0)))
    b = slope / (row.PCY1 * peak)
    a = alpha + row.PHY1 + row.PHY2 * dfz
    e = (row.PEY1 + row.PEY2 * dfz) * (1 - row.PEY3)
    inner = b * a - e * (b * a - np.arctan(b * a))
    expected = peak * np.sin(row.PCY1 * np.arctan(inner)) + load * (row.PVY1 + row.PVY2 * dfz)
    got = lateral_force(lateral_factors(table, np.array([load])), np.array([alpha]))
    assert got[0, 0, 0] == pytest.approx(expected, rel=1e-12)


def test_fit_finds_the_curves_of_another_tire(table):
    wanted = curves_of(table)
    start = table.copy()
    rng = np.random.default_rng(0)
    names = list(LATERAL_WITHOUT_CAMBER)
    start[names] = start[names] * rng.uniform(0.85, 1.15, size=(len(table), len(names)))
    fitted = fit_lateral(wanted, start, CURVE_LOADS, CURVE_SLIP_ANGLES)
    before = np.abs(curves_of(start) - wanted).max(axis=(1, 2))
    after = np.abs(curves_of(fitted) - wanted).max(axis=(1, 2))
    assert np.median(before) > 200
    assert np.median(after) < 1
    assert (after < 20).all()


def test_fit_leaves_a_tire_without_finite_curves_alone(table):
    wanted = curves_of(table)
    wanted[3] = np.nan
    fitted = fit_lateral(wanted, table, CURVE_LOADS, CURVE_SLIP_ANGLES)
    assert fitted.iloc[3].equals(table.iloc[3])


@pytest.mark.parametrize("seed", [0, 1, 10])  # in the second and the third a peak is beside the range's end
def test_key_attributes_are_those_of_the_curve(seed):
    table = synthetic_table(seed=seed)
    features = make_representation("key_attributes").encode(table)
    slip = np.linspace(0, 0.25, 5001)
    curve = -lateral_force(lateral_factors(table, CURVE_LOADS), slip)
    np.testing.assert_allclose(features[:, 3:6], curve.max(axis=-1), rtol=1e-6)
    np.testing.assert_allclose(features[:, 6:], slip[curve.argmax(axis=-1)], atol=5e-5)
    assert (features[:, :3] < 0).all()


def test_appendix_d_gives_back_a_curve_without_curvature():
    shape, peak, factor = np.array([1.3, 1.6, 1.9]), 5000.0, -12.0
    slip = np.tan(np.pi / 2 / shape) / abs(factor)
    got_shape, got_factor = shape_and_stiffness_factor(factor * shape * peak, np.full(3, peak), slip)
    np.testing.assert_allclose(got_shape, shape, rtol=1e-9)
    np.testing.assert_allclose(got_factor, factor, rtol=1e-9)


def test_appendix_d_without_a_solution_stays_finite():
    shape, factor = shape_and_stiffness_factor(np.array([10_000.0]), np.array([5000.0]), np.array([0.2]))
    assert np.isfinite([shape, factor]).all()


def test_latent_decoder_learns_the_curves(table):
    representation = make_representation("latent", epochs=60).fit(table, seed=0)
    wanted = curves_of(table)
    native = representation.decode_curves(representation.encode(table), table)
    error = np.sqrt(((native - wanted) ** 2).mean())
    spread = np.sqrt(((wanted - wanted.mean(axis=0)) ** 2).mean())
    assert error < 0.25 * spread


def test_latent_training_repeats_with_the_same_seed(table):
    first, again, other = (
        make_representation("latent", epochs=2).fit(table, seed=s).encode(table) for s in (3, 3, 4)
    )
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)


def test_unknown_names_are_refused():
    with pytest.raises(DomainError, match="coefficients"):
        make_representation("wavelets")
    with pytest.raises(DomainError, match="full"):
        make_representation("coefficients", dataset="half")
    with pytest.raises(DomainError, match="published"):
        make_representation("power_series", form="other")


def test_missing_coefficient_is_named(table):
    with pytest.raises(DomainError, match="PKY1"):
        make_representation("coefficients").fit(table.drop(columns="PKY1"))


@pytest.mark.slow
def test_import_needs_no_torch():
    code = (
        "import sys, tire_pipeline.representations as r;"
        "r.make_representation('latent'); r.make_representation('power_series');"
        "sys.exit('torch' in sys.modules or 'sklearn' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
