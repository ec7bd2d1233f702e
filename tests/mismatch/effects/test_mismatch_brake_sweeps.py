"""Combined slip that the file lacks: looked for in brake sweeps, also where the slip angle stands still."""

import pytest
from brake_rig import brake_sweeps, weighted

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.recording.prepare import prepare


@pytest.mark.parametrize("missing", [[], ["tread_temperature"], ["fx"], ["fy"]], ids=str)
@pytest.mark.parametrize("angles", [(4.0,), (0.0, 4.0), (-3.0, 5.0)])
def test_combined_slip_is_looked_for_in_brake_sweeps(braked, angles, missing):
    """It was not where the slip angle stands still: a gain and crosstalk were named. Shares: ``rates``."""
    data = prepare(braked, brake_sweeps(weighted(braked), angles).drop(columns=missing)).data
    assert catalogue()["combined_slip"].absent(data) is None
