"""How the first sentence of a report joins what was found."""

from __future__ import annotations

import pytest

from tire_pipeline.mismatch.proof.measured import OutputFit, Remainder
from tire_pipeline.mismatch.report.contents import EffectReport
from tire_pipeline.mismatch.report.headline.sentences import head

NOTHING = Remainder(size={}, located=[], significant=False)


def found(name, *alternatives):
    return EffectReport(name, "physics", name, alternatives, 0.98, "fy", {}, [], 0.5, "", "", {})


def first_sentence(effects, before, after):
    fit = {"fy": OutputFit(16.0, before, after, after, after)}
    return head("ambiguous", effects, fit, [], NOTHING, "").causes


@pytest.mark.parametrize(("after", "said"), [(86.0, "comes in part from"), (30.0, "difference comes from")])
def test_a_cause_of_the_smaller_part_is_not_said_to_be_all(after, said):
    """A lag took 89 N to 86, and "the difference comes from relaxation length"."""
    assert said in first_sentence([found("relaxation_length", "low_pass")], 89.0, after)


def test_causes_that_are_each_one_of_several_are_told_apart():
    """ "From an offset of the slip angle or ply steer and relaxation length or a low-pass filter"."""
    lag, offset = found("relaxation_length", "low_pass"), found("slip_angle_offset", "plysteer_conicity")
    assert ", and from relaxation_length" in first_sentence([offset, lag], 89.0, 30.0)
