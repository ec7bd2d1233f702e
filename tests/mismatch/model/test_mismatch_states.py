"""What a recording tells of its wheel: the radius at which something comes back once a turn."""

import pytest
from small_rig import out_of_round, with_pauses

from tire_pipeline.mismatch.proof.trial import put_in
from tire_pipeline.mismatch.recording.prepare import prepare

DRAWS = range(4)
"""What is named in such draws: ``rates``."""


@pytest.mark.parametrize("seed", DRAWS)
def test_a_wheel_turns_on_in_the_pauses_of_a_recording(tire, record, seed):
    """Phase holds over pauses: without that, pieces that begin at another angle of the wheel cancel out."""
    data = prepare(tire, with_pauses(out_of_round(tire, record(seed), force=150.0))).data
    assert data.wheel.rolling_radius() == pytest.approx(0.97 * data.nominal.radius, rel=1e-3)


@pytest.mark.parametrize("seed", DRAWS)
def test_a_load_that_varies_once_a_turn_shows_its_radius_in_sweeps_to_both_sides(tire, record, seed):
    """It changes a force of either sign the other way, so the force has hardly any power once a turn."""
    recording = record(seed)
    radius = 0.97 * prepare(tire, recording).data.nominal.radius
    wobbling = put_in(tire, recording, "nonuniformity", {"load_sine": 0.06, "radius": radius})
    found = prepare(tire, wobbling).data.wheel.rolling_radius(("slip_angle", "normal_load"))
    assert found == pytest.approx(radius, rel=1e-3)
