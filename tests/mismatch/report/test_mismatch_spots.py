"""Where the head of a report says that recording and model differ."""

import pytest

from tire_pipeline.mismatch.proof.locate import Located
from tire_pipeline.mismatch.proof.measured import OutputFit, Remainder
from tire_pipeline.mismatch.report.contents import EffectReport
from tire_pipeline.mismatch.report.headline.sentences import head


@pytest.mark.parametrize(
    ("name", "kind", "spot"),
    [
        ("sensor_drift", "artefact", "Between 80 and 120 s, Fy is on average 180 N"),
        (
            "surface_change",
            "physics",
            "At load above 5 kN and between 80 and 120 s, Fy is on average 250 N",
        ),
        ("friction_scale", "physics", "At load above 5 kN, Fy is on average 250 N"),
    ],
)
def test_what_follows_the_clock_is_placed_in_time(name, kind, spot):
    """A drift was "at load above 39.9 kN", or "at camber above 0.01 deg": what was recorded last."""
    ranges = {"time": (0.0, 120.0), "normal_load": (2000.0, 6000.0)}
    places = [
        Located("fy", "normal_load", 5000.0, 6000.0, -250.0, -0.1, 0.01, True),
        Located("fy", "time", 80.0, 120.0, -180.0, -0.05, 0.01, True),
    ]
    where = {"normal_load": (5000.0, 6000.0)}
    effect = EffectReport(name, kind, "a cause", (), 0.99, "fy", where, [], 0.8, "", "", {})
    fit, nothing = {"fy": OutputFit(20.0, 300.0, 120.0, 110.0, 130.0)}, Remainder({}, [], False)
    told = head("explained", [effect], fit, places, nothing, "", ranges)
    assert spot in told.text
