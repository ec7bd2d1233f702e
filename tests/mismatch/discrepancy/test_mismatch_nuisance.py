"""The flexible form of a formula's misfit: its mirror, and its size."""

import numpy as np

from tire_pipeline.mismatch.discrepancy.nuisance.columns import make_nuisance
from tire_pipeline.mismatch.recording.prepare import prepare


def test_misfit_breaks_the_mirror_only_a_little(tire, record):
    """At mirrored points the flexible form of Fy is opposite, but for the small part that is allowed."""
    recording = record(1)
    mirrored = recording.assign(slip_angle=-recording["slip_angle"], fy=-recording["fy"])
    here = make_nuisance(prepare(tire, recording).data).flexible["fy"]
    there = make_nuisance(prepare(tire, mirrored).data).flexible["fy"]
    covariance = np.sum(here * there, axis=1)
    own = np.sum(here * here, axis=1)
    strong = own > np.median(own)
    assert np.median(covariance[strong] / own[strong]) < -0.8


def test_a_slip_that_is_noise_only_makes_no_huge_columns(tire, record):
    """The even grid has no range of such a slip; coefficients that need one are not fitted there."""
    braked = tire.replace(
        PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, PKX3=0.2, PVX1=1e-3, PHX1=3e-7, RBX1=12.0, RBX2=9.0, RCX1=1.0
    )
    recording = record(4)
    noise = np.random.default_rng(4).normal(0.0, 3e-4, (2, len(recording)))
    recording = recording.assign(slip_ratio=noise[0], fx=22.0 * 4000.0 * noise[1])
    data = prepare(braked, recording).data
    assert not data.varies("slip_ratio")
    columns = make_nuisance(data).flexible["fx"]
    largest = max(np.abs(data.simulation.base[o]).max() for o in data.outputs)
    assert np.sqrt(np.mean(columns**2, axis=0)).max() < 10.0 * largest


def test_a_shift_at_zero_slip_is_no_slope(tire, record):
    """Where a force bends does not hang on ply steer: to either side it leaves the same covariance."""
    recording = record(1)

    def covariance(shift):
        shifted = tire.replace(PVY1=tire.coefficients.get("PVY1", 0.0) + shift)
        rows = make_nuisance(prepare(shifted, recording).data).flexible["fy"][::200]
        size = rows @ rows.T
        return size / np.trace(size)

    plain = covariance(0.0)
    for shift in (0.02, -0.02):
        assert np.max(np.abs(covariance(shift) - plain)) < 0.05 * np.max(np.abs(plain))
