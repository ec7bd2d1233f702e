"""A surface that dries, one that the file is right on only at the end, and a tire that was changed."""

import numpy as np
import pytest
from weighed import beside, named_sets

RIVALS = ("surface_change", "temperature", "wear", "friction_scale", "sensor_drift")


@pytest.mark.slow
@pytest.mark.parametrize("lags", [3.0, pytest.param(1.25, marks=pytest.mark.ci)])
@beside(*RIVALS)
def test_a_track_that_dries_is_not_named_a_temperature_alone(tire, record, lags, without):
    """It was temperature with 0.999, and the next recording, on the dry track, was off by 511 N."""
    elapsed = np.linspace(0.0, 1.0, len(record()))
    sets = named_sets(tire, record(friction=1.0 - 0.3 * np.exp(-lags * elapsed)), without)
    assert len(sets) == 1
    assert "surface_change" in sets[0]


@pytest.mark.slow
@beside(*RIVALS, "stiffness_scale")
def test_a_tire_that_was_changed_is_no_wear(tire, record, without):
    """Friction and stiffness that step at one moment were wear."""
    late = np.linspace(0.0, 1.0, len(record())) > 0.5
    changed = record(friction=np.where(late, 1.07, 1.0), stiffness=np.where(late, 0.85, 1.0))
    (found,) = named_sets(tire, changed, without)
    assert "surface_change" in found
