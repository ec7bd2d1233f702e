"""What a report says of an aligning moment that does not agree."""

from __future__ import annotations

import pytest

from tire_pipeline.mismatch.proof.measured import OutputFit
from tire_pipeline.mismatch.report.headline.moment_words import on_moment
from tire_pipeline.mismatch.report.unnamed_part import MomentError


@pytest.mark.parametrize(
    ("before", "after", "mirrored", "told"),
    [
        (649.0, 1.1, 59.0, ""),
        (42.0, 42.0, 2.0, "with the other sign it is off by 2"),
        (30.0, 30.0, 59.0, "agree"),
    ],
)
def test_no_sign_of_mz_is_asked_for_where_what_was_found_brings_it_right(before, after, mirrored, told):
    """Degrees for radians: 649 N m became 1.1, and "check the sign: with the other sign it is off by 59"."""
    moment = MomentError(before, after, mirrored, 90.0, 0.5)
    said_of_it = on_moment(moment, {"mz": OutputFit(0.5, before, after, 0.9 * after, 1.1 * after)})
    assert told in said_of_it
    assert bool(told) == bool(said_of_it)
    assert ("sign" in said_of_it) == (mirrored < after)
