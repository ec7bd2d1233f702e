"""An open question is one value with its own sentence, before what was found all the same."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tire_pipeline.mismatch.proof.locate import Located
from tire_pipeline.mismatch.proof.measured import OutputFit, Remainder
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.mismatch.report.contents import EffectReport
from tire_pipeline.mismatch.report.headline.sentences import head, on_question

FIT = {"fy": OutputFit(20.0, 300.0, 120.0, 110.0, 130.0)}
LEFT = Remainder(size={"fy": 280.0}, located=[], significant=True)
NONE = Remainder(size={}, located=[], significant=False)
PLACE = Located("fy", "slip_angle", 0.1, 0.15, -250.0, -0.1, 0.01, True)
EFFECT = EffectReport(
    "friction_scale", "physics", "friction of the track", (), 0.99, "fy", {}, [], 0.8, "", "", {}
)
TURNED = "fy has the other sign; it would look the same if slip_angle had"
OPEN = f"the recording agrees with the model only in other axes ({TURNED})"


def said(verdict, effects=(), left=NONE, stated=()):
    return head(verdict, list(effects), FIT, [PLACE], left, "Record again.", stated=stated)


def test_an_open_question_comes_before_what_was_found_and_says_what_to_do():
    told = on_question(Question(OPEN, "read it in other axes"), said("explained", [EFFECT])).text
    assert told.startswith(f"Open: {OPEN}; as it was read, the difference comes from friction of the track")
    assert told.endswith("Next, read it in other axes; no corrected file is written until then.")


TURNED_AXES = Question(OPEN, "read it in other axes", stated=(TURNED,))
SIGN = replace(
    EFFECT,
    name="sign_convention",
    kind="artefact",
    title=f"a channel with the other sign ({TURNED})",
    evidence={"found": TURNED},
)


def test_an_open_question_says_once_that_a_channel_is_turned():
    """ "Open: ... (fy has the other sign); ..., and from a channel with the other sign, a fault ..."."""
    told = on_question(TURNED_AXES, said("ambiguous", [EFFECT, SIGN], stated=TURNED_AXES.stated)).text
    assert told.count("other sign") == 1
    assert told.startswith(f"Open: {OPEN}; beside that, the difference comes from friction of the track, ")
    assert "mbiguous" not in told


@pytest.mark.parametrize(("left", "rest"), [(NONE, ""), (LEFT, "; beside that, an unexplained residual")])
def test_a_turned_channel_alone_is_no_cause_beside_the_question(left, rest):
    told = on_question(TURNED_AXES, said("explained", [SIGN], left, stated=TURNED_AXES.stated)).text
    assert told.startswith(f"Open: {OPEN}{rest}")
    assert "the difference comes" not in told


@pytest.mark.parametrize("case", ["agrees", "undecided", "unexplained"])
def test_what_was_found_beside_an_open_question_has_no_verdict_of_its_own(case):
    told = on_question(Question("the axes are open", "read it in other axes"), said(case)).text
    assert told.startswith("Open: the axes are open; as it was read, ")
    assert "ndecided:" not in told
    assert "read: " not in told
