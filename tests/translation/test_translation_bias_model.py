"""The statistics and the geometry under the translators."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.representations.coefficients import DATASETS
from tire_pipeline.translation.curves import pure_slip
from tire_pipeline.translation.curves.features import GROUPS, encode
from tire_pipeline.translation.decode.least_change import DecodeTarget, decode
from tire_pipeline.translation.decode.physics import violations
from tire_pipeline.translation.population.mixed_effects import (
    Design,
    MarginalLikelihood,
    fit_mixed_effects,
    posterior_weights,
)

FULL = DATASETS["full"]
# ruff: noqa: E501
TIRE = {
    "FNOMIN": 6000.0, "UNLOADED_RADIUS": 0.33,
    "PCX1": 1.6, "PDX1": 1.1, "PDX2": -0.1, "PDX3": 0.4, "PEX1": 0.2, "PEX2": 0.1, "PEX3": -0.05, "PEX4": 0.02,
    "PKX1": 22.0, "PKX2": -1.0, "PKX3": 0.2, "PHX1": 0.001, "PHX2": 0.0005, "PVX1": 0.003, "PVX2": 0.001,
    "PCY1": 1.4, "PDY1": 1.0, "PDY2": -0.15, "PDY3": 1.5, "PEY1": -0.6, "PEY2": -0.2, "PEY3": 0.05, "PEY4": 0.4,
    "PKY1": -18.0, "PKY2": 1.8, "PKY3": 0.4, "PHY1": 0.002, "PHY2": 0.001, "PHY3": 0.04, "PVY1": 0.01,
    "PVY2": -0.01, "PVY3": -0.1, "PVY4": -0.05,
    "QBZ1": 9.0, "QBZ2": -1.2, "QBZ3": 0.1, "QBZ4": 0.1, "QBZ5": -0.2, "QBZ9": 12.0, "QBZ10": 0.1, "QCZ1": 1.15,
    "QDZ1": 0.11, "QDZ2": -0.002, "QDZ3": 0.1, "QDZ4": 0.5, "QDZ6": 0.002, "QDZ7": 0.001, "QDZ8": -0.1,
    "QDZ9": -0.05, "QEZ1": -1.5, "QEZ2": 0.3, "QEZ3": 0.1, "QEZ4": 0.05, "QEZ5": 0.2, "QHZ1": 0.003, "QHZ2": 0.001,
    "QHZ3": 0.05, "QHZ4": 0.01,
}  # fmt: skip
SCALES = {
    "LMUY": 0.9,
    "LKY": 1.1,
    "LCY": 1.02,
    "LEY": 0.9,
    "LMUX": 0.95,
    "LKX": 1.05,
    "LTR": 0.9,
    "LRES": 1.1,
}


@pytest.mark.parametrize("scales", [{}, SCALES])
@pytest.mark.parametrize("camber", [0.0, -0.06, 0.05])
def test_forces_of_many_tires_are_those_of_the_engine(scales, camber):
    slips, loads = np.linspace(-0.25, 0.25, 11), np.array([2500.0, 6000.0, 8000.0])
    points = pure_slip.Points.grid(slips, loads, [camber])
    p = pure_slip.columns(pd.DataFrame([{**TIRE, **scales}]))
    model = TireModel.from_coefficients({**TIRE, **scales}, version="5.2")
    load, tilt = points.normal_load, np.full(slips.size * loads.size, camber)
    side = model.forces(normal_load=load, slip_angle=points.slip, camber=tilt, limits="ignore")
    along = model.forces(normal_load=load, slip_ratio=points.slip, camber=tilt, limits="ignore")
    for ours, theirs in (
        (pure_slip.lateral_force(p, points), side.fy),
        (pure_slip.aligning_torque(p, points), side.mz),
        (pure_slip.longitudinal_force(p, points), along.fx),
    ):
        np.testing.assert_allclose(ours[0], theirs, rtol=1e-9, atol=1e-9 * np.abs(theirs).max())


def _wish(table, wanted):
    values = table[list(FULL)]
    spread = {name: max(0.1 * abs(float(values[name].iloc[0])), 1e-3) for name in FULL}
    far = {name: (-1e3, 1e3) for name in FULL}
    unit = {"lateral": 0.01, "camber": 0.01, "longitudinal": 0.01, "aligning": 0.002}
    return DecodeTarget(wanted, unit, spread, values.iloc[0].to_dict(), far, {})


def test_decoding_finds_a_tire_with_the_features_asked_for():
    rng = np.random.default_rng(1)
    source = pd.DataFrame([TIRE] * 4)
    other = source.copy()
    for name in ("PDY1", "PKY1", "PKY2", "PCY1", "PDX1", "PKX1", "QDZ1", "PVY3"):
        other[name] *= rng.uniform(0.92, 1.08, 4)
    wanted = encode(other)
    found = encode(decode(source, _wish(source, wanted)))
    before = encode(source)
    for group in GROUPS:
        start = np.sqrt(((before[group.name] - wanted[group.name]) ** 2).mean())
        left = np.sqrt(((found[group.name] - wanted[group.name]) ** 2).mean())
        assert left < 0.1 * start


def test_what_is_locked_stays():
    source = pd.DataFrame([TIRE] * 2)
    other = source.assign(PHY1=0.01, PDY1=1.2)
    wish = _wish(source, encode(other))
    wish.locked["PHY1"] = np.array([True, False])
    found = decode(source, wish)
    assert found["PHY1"].iloc[0] == TIRE["PHY1"]
    assert found["PHY1"].iloc[1] != TIRE["PHY1"]


def test_a_wish_beyond_the_curvature_bound_ends_at_the_bound_and_not_in_a_tire_to_be_refused():
    source = pd.DataFrame([{**TIRE, "PEY1": 0.8}] * 2)
    beyond = source.assign(PEY1=1.3, PEY3=[0.4, -0.4], PDY1=1.1)
    assert violations(beyond)["curvature"].all()
    found = decode(source, _wish(source, encode(beyond)))
    assert not violations(found).to_numpy().any()
    wanted, got, before = (encode(t)["lateral"][:, 4:8] for t in (beyond, found, source))
    assert (np.abs(got - wanted).max(axis=1) < 0.2 * np.abs(before - wanted).max(axis=1)).all()


def test_violations_name_what_is_broken():
    table = pd.DataFrame(
        [TIRE, {**TIRE, "PDY1": 2.5}, {**TIRE, "PKY1": 18.0}, {**TIRE, "PEY1": 1.5, "PEY3": 0.0}]
    )
    broken = violations(table)
    assert not broken.iloc[0].any()
    assert broken.iloc[1]["lateral friction"]
    assert broken.iloc[2]["cornering stiffness"]
    assert broken.iloc[3]["curvature"]


def _design(rng, effect, tires=60):
    organisation = rng.integers(0, 3, tires)
    x = rng.normal(size=(tires, 2))
    indicators = np.eye(3)[organisation]
    response = x @ [0.6, -0.4] + indicators @ np.array([0.0, effect, -effect]) + 0.3 * rng.normal(size=tires)
    blocks = {"level": np.ones((tires, 1)), "metadata": x, "category": indicators}
    return Design(blocks, np.zeros((tires, 0)), rng.integers(1, 5, tires).astype(float)), response


GUESS = {"level": 100.0, "metadata": 0.1, "category": 0.1, "tire": 0.2, "tire_category": 0.02}


def test_gradient_of_the_marginal_likelihood():
    rng = np.random.default_rng(3)
    design, response = _design(rng, 0.5)
    shared = np.zeros((60, 2))
    shared[:2, 0] = shared[2:4, 1] = 1.0
    marginal = MarginalLikelihood(Design(design.blocks, shared, design.files), response, 0.05)
    logs = np.log([5.0, 0.3, 0.2, 0.1, 0.04])
    _, slope = marginal.value_and_gradient(logs)
    for k in range(logs.size):
        step = np.zeros(logs.size)
        step[k] = 1e-5
        up, down = (marginal.value_and_gradient(logs + sign * step)[0] for sign in (1, -1))
        assert slope[k] == pytest.approx((up - down) / 2e-5, rel=1e-4, abs=1e-6)


def test_an_effect_that_is_there_is_found_and_one_that_is_not_shrinks_to_nothing():
    rng = np.random.default_rng(5)
    design, response = _design(rng, 1.0)
    found = fit_mixed_effects(design, response, noise=0.05, guess=GUESS, tire_category=0.02)
    np.testing.assert_allclose(found.mean[4] - found.mean[5], 2.0, atol=0.4)
    design, response = _design(rng, 0.0)
    none = fit_mixed_effects(design, response, noise=0.05, guess=GUESS, tire_category=0.02)
    assert none.variances["category"] < 0.05 * found.variances["category"]
    assert np.abs(none.mean[3:6]).max() < 0.1


def test_known_variances_give_the_same_weights():
    rng = np.random.default_rng(6)
    design, response = _design(rng, 0.7)
    found = fit_mixed_effects(design, response, noise=0.05, guess=GUESS, tire_category=0.02)
    again = posterior_weights(design, response, found.variances)
    np.testing.assert_allclose(again.mean, found.mean, atol=1e-9)
