"""A lag in distance and a lag in time on a real flat belt at one speed: nothing tells them apart."""

from __future__ import annotations

import numpy as np
import pytest
from mismatch_shared import shared

from tire_pipeline.magic_formula import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.recordings import read_recording

IN_TIME = {"time_delay", "low_pass"}


@pytest.fixture(scope="module")
def belt():
    rows = read_recording(shared("recordings/calspan/cornering_part.mat"))
    flat = rows[(rows["camber"].abs() < 0.005) & (rows["pressure"] < 9e4)].reset_index(drop=True)
    channels = ["slip_angle", "normal_load", "fy"]
    return fit_magic_formula(flat.iloc[::5][channels], unloaded_radius=0.2).model, flat


@pytest.mark.parametrize("delay", [0.02, 0.04, 0.08])
def test_a_delay_at_one_speed_is_no_relaxation_by_itself(belt, delay):
    tire, flat = belt
    time, force = flat["time"].to_numpy(), flat["fy"].to_numpy()
    piece = np.cumsum(np.diff(time, prepend=time[0]) > 0.05)
    late = force.copy()
    for number in np.unique(piece):
        here = piece == number
        late[here] = np.interp(time[here] - delay, time[here], force[here])
    report = explain_mismatch(tire, flat.assign(fy=late).iloc[::5].reset_index(drop=True))
    for names, _ in report.sets:
        assert "relaxation_length" not in names or IN_TIME & set(names), names
