import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from synthetic_tires import synthetic_table

from tire_pipeline.representations import CURVE_LOADS, CURVE_SLIP_ANGLES, make_representation
from tire_pipeline.representations.lateral_curve import lateral_factors, lateral_force
from tire_pipeline.representations.power_series import derivatives, nearest_real
from tire_pipeline.representations.power_series_condition import condition_numbers


def curves_of(table):
    return lateral_force(lateral_factors(table, CURVE_LOADS), CURVE_SLIP_ANGLES)


@given(st.floats(5, 30), st.floats(1.0, 1.9), st.floats(-3, 0.9))
def test_derivatives_are_the_coefficients_of_the_series(b, c, e):
    """Against the odd terms of a polynomial through the curve itself, close to the origin."""
    k1, k2, k3 = derivatives(b, c, e)
    # Chebyshev points on |b x| < 0.05: the 7th order is then far below the 5th
    x = np.cos(np.pi * (np.arange(16) + 0.5) / 16) * 0.05
    y = np.sin(c * np.arctan(x - e * (x - np.arctan(x))))
    odd = np.stack([x, x**3, x**5, x**7], axis=1)
    fitted = np.linalg.lstsq(odd / 0.05 ** np.array([1, 3, 5, 7]), y, rcond=None)[0]
    fitted /= 0.05 ** np.array([1, 3, 5, 7])
    np.testing.assert_allclose(fitted[0] * b, k1, rtol=1e-9)
    np.testing.assert_allclose(fitted[1] * b**3 * 6, k2, rtol=1e-5, atol=1e-5 * b**3)
    np.testing.assert_allclose(fitted[2] * b**5 * 120, k3, rtol=1e-2, atol=0.5 * b**5)


def test_stable_form_gives_the_tires_back():
    table = synthetic_table(150)
    representation = make_representation("power_series").fit(table)
    decoded = representation.decode(representation.encode(table), table)
    np.testing.assert_allclose(curves_of(decoded), curves_of(table), atol=1e-3)


def test_published_form_takes_the_wrong_root_between_two_curvatures():
    """A finding about Appendix C: even unmoved features do not give the curve back."""
    table = synthetic_table(150).assign(PEY2=0.0, PHY1=0, PHY2=0, PVY1=0, PVY2=0, PEY3=0)
    published = make_representation("power_series", form="published")
    for curvature, right in ((0.4, True), (0.0, False), (-0.3, False), (-0.9, True)):
        tires = table.assign(PEY1=curvature)
        native = published.decode_curves(published.encode(tires), tires)
        error = np.abs(native - curves_of(tires)).max(axis=(1, 2))
        assert (error < 1e-3).sum() == (len(tires) if right else 0)


def test_every_stable_decoding_is_real():
    table = synthetic_table(200)
    representation = make_representation("power_series").fit(table)
    features = representation.encode(table)
    rng = np.random.default_rng(0)
    moved = features + rng.normal(size=features.shape) * features.std(axis=0)
    assert not representation.is_real(moved).all()
    assert np.isfinite(representation.decode_curves(moved, table)).all()


def test_imaginary_solutions_move_to_the_nearest_real_one():
    spread = np.array([[0.5], [2.0]])
    r2, r3 = np.array([[-1.4]]), np.array([[30.0]])
    near2, near3 = nearest_real(r2, r3, spread)
    found = ((near2 - r2) / 0.5) ** 2 + ((near3 - r3) / 2.0) ** 2
    s = -np.geomspace(1e-2, 60, 400_001)
    distance = ((s - 1 - r2) / 0.5) ** 2 + ((1 - 10 * s + 6.4 * s**2 - r3) / 2.0) ** 2
    np.testing.assert_allclose(found, distance.min(), rtol=1e-6)


def test_published_features_can_be_imaginary_and_are_told():
    table = synthetic_table(100)
    published = make_representation("power_series", form="published").fit(table)
    features = published.encode(table)
    features[:50, 6:9] *= 40
    real = published.is_real(features)
    assert real[50:].all()
    assert 0 < real[:50].sum() < 50
    curves = published.decode_curves(features, table)
    np.testing.assert_array_equal(np.isfinite(curves).all(axis=(1, 2)), real)


def test_stable_form_is_better_conditioned():
    measured = condition_numbers(synthetic_table(300)).set_index(["form", "normal_load"])
    for load in CURVE_LOADS:
        published, stable = measured.loc[("published", load)], measured.loc[("stable", load)]
        assert stable.condition_median < published.condition_median
        assert stable.gain_p95 < published.gain_p95
