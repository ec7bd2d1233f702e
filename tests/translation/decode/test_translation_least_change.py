"""The coefficients that give the features asked for, and what stays as it is."""

import numpy as np
import pandas as pd
from one_tire import TIRE

from tire_pipeline.representations.coefficients import DATASETS
from tire_pipeline.translation.curves.features import GROUPS, encode
from tire_pipeline.translation.decode.least_change import DecodeTarget, decode
from tire_pipeline.translation.decode.physics import violations

FULL = DATASETS["full"]


def _target(table, wanted):
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
    found = encode(decode(source, _target(source, wanted)))
    before = encode(source)
    for group in GROUPS:
        start = np.sqrt(((before[group.name] - wanted[group.name]) ** 2).mean())
        left = np.sqrt(((found[group.name] - wanted[group.name]) ** 2).mean())
        assert left < 0.1 * start


def test_what_is_locked_stays():
    source = pd.DataFrame([TIRE] * 2)
    other = source.assign(PHY1=0.01, PDY1=1.2)
    target = _target(source, encode(other))
    target.locked["PHY1"] = np.array([True, False])
    found = decode(source, target)
    assert found["PHY1"].iloc[0] == TIRE["PHY1"]
    assert found["PHY1"].iloc[1] != TIRE["PHY1"]


def test_a_target_beyond_the_curvature_bound_ends_at_the_bound_and_not_in_a_tire_to_be_refused():
    source = pd.DataFrame([{**TIRE, "PEY1": 0.8}] * 2)
    beyond = source.assign(PEY1=1.3, PEY3=[0.4, -0.4], PDY1=1.1)
    assert violations(beyond)["curvature"].all()
    found = decode(source, _target(source, encode(beyond)))
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
