"""What a formula leaves over the load: a curvature that the forces share."""

import numpy as np
import pytest
from brake_rig import brake_sweeps, weighted

from tire_pipeline.mismatch.discrepancy.load_curvature import load_curvature
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.recording.prepare import prepare


@pytest.fixture(scope="module")
def data(braked):
    file = weighted(braked)
    return prepare(file, brake_sweeps(file, (-3.0, 5.0))).data


def test_it_has_nothing_of_the_level_and_of_the_slope_over_load(data):
    """These two the fit has met: what is left of them would hide a friction and a load sensitivity."""
    bend = load_curvature(data)[0]
    for effect, value in (("force_gain", {"fx": 1e-3, "fy": 1e-3}), ("load_sensitivity", {"rate": 1e-3})):
        changed = simulate(data, [(effect, value)])
        base = data.simulation.base
        other = np.concatenate([changed[o] - base[o] for o in base])
        own = np.concatenate([bend[o][:, 0] for o in base])
        assert abs(other @ own) < 0.15 * np.linalg.norm(other) * np.linalg.norm(own)


def test_both_forces_share_it(data):
    """By friction all forces change by the same part at the same load, where the tire slides."""
    bend = load_curvature(data)[0]
    sliding = np.abs(data.get("slip_ratio")) > 0.1
    shares = [bend[o][sliding, 0] / data.simulation.base[o][sliding] for o in ("fx", "fy")]
    np.testing.assert_allclose(shares[0], shares[1], atol=0.25 * np.abs(shares[0]).max())


def test_at_one_load_there_is_none(braked):
    file = weighted(braked)
    recording = brake_sweeps(file, (0.0, 5.0))
    assert load_curvature(prepare(file, recording.assign(normal_load=4000.0)).data) == []
