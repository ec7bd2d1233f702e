"""A recording at one camber that is not zero, beside a file that was fitted without camber."""

from __future__ import annotations

import numpy as np
import pytest
from weighed import all_but, named_sets

OFFSETS = {"slip_angle_offset", "plysteer_conicity"}
RIVALS = (*OFFSETS, "camber", "camber_offset", "force_offset", "stiffness_scale")


def tilted(tire, record, camber, seed=3):
    """The rig's recording of a tire that answers to camber as a car's does, at one camber, rad."""
    recording = record(seed)
    at = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    leaning = tire.replace(PHY3=-0.03, PVY3=-0.6, PDY3=3.0)
    more = leaning.forces(**at, camber=camber).fy - tire.forces(**at).fy
    noise = np.random.default_rng(seed).normal(0.0, 1e-3, len(recording))
    return recording.assign(fy=recording["fy"] + more, camber=camber + noise)


@pytest.mark.parametrize("camber", [0.07, -0.035])
def test_a_camber_that_stays_is_named_with_the_offsets_it_looks_like(tire, record, camber):
    """It could not be tested ("camber does not vary"), and was conicity or an offset of the angle, 0.99."""
    sets = named_sets(tire, tilted(tire, record, camber), without=all_but(*RIVALS))
    assert any("camber" in names and names & OFFSETS for names in sets) or {"camber"} in sets, sets


def test_a_camber_within_the_range_of_the_file_is_no_cause(tire, record):
    """The file says that it holds there; an offset of the slip angle stays one."""
    ranged = tire.replace(CAMMIN=-0.1, CAMMAX=0.1)
    recording = record(4).assign(camber=0.07)
    off = recording.assign(slip_angle=recording["slip_angle"] + 0.006)
    sets = named_sets(ranged, off, without=all_but(*RIVALS))
    assert any("slip_angle_offset" in names for names in sets)
    assert not any("camber" in names for names in sets)
