"""The head of a report is three sentences, whatever was found: verdict, size and place, what to do next."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from tire_pipeline.mismatch.corrected.as_recorded import with_unnamed, without_unnamed
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.proof.held_out import made_worse
from tire_pipeline.mismatch.proof.locate import Located, Throughout
from tire_pipeline.mismatch.proof.measured import OutputFit, Remainder
from tire_pipeline.mismatch.recording.cleaning import Cleaning
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.mismatch.report.contents import EffectReport, HeldOutFit, PredictionError
from tire_pipeline.mismatch.report.headline.sentences import (
    head,
    on_question,
    with_held_out,
    without_equation,
)
from tire_pipeline.mismatch.report.remarks import on_moments
from tire_pipeline.mismatch.report.report_page import certainty_of, percent
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedPhysics, UnnamedReport
from tire_pipeline.mismatch.unnamed_physics.language.symbols import NominalValues

NOMINAL = NominalValues(4000.0, 0.3, 16.0, 2e5, 60.0)
EQUATION = UnnamedPhysics({"fy": "0.1*Fz*v"}, ("speed",), "force", {"v": (0.8, 1.2)}, NOMINAL)
FOUND = UnnamedReport(EQUATION, unseen={"fy": (300.0, 120.0, 100.0)})
FIT = {"fy": OutputFit(20.0, 300.0, 120.0, 110.0, 130.0)}
LEFT = Remainder(size={"fy": 280.0}, located=[], significant=True)
NONE = Remainder(size={}, located=[], significant=False)
PLACE = Located("fy", "slip_angle", 0.1, 0.15, -250.0, -0.1, 0.01, True)
EFFECT = EffectReport(
    "friction_scale", "physics", "friction of the track", (), 0.99, "fy", {}, [], 0.8, "", "", {}
)
TURNED = "fy has the other sign; it would look the same if slip_angle had"
OPEN = f"the recording agrees with the model only in other axes ({TURNED})"


RIVALS = [("friction_scale", "wear"), ("stiffness_scale",)]


def said(verdict, effects=(), left=NONE, unnamed=None, rivals=()):
    return head(verdict, list(effects), FIT, [PLACE], left, "Record again.", unnamed=unnamed, rivals=rivals)


def sentences(text):
    return re.split(r"(?<=\.) (?=[A-Z])", text)


NOT_ADDED = head("explained", [EFFECT], FIT, [PLACE], NONE, "", added=False)

HEADS = {
    "explained, and nothing added": NOT_ADDED,
    "agrees": said("agrees"),
    "undecided": said("undecided", left=replace(NONE, unusual={"fy": 0.05}, usual=(0.01, 0.02))),
    "explained": said("explained", [EFFECT]),
    "partly explained, with an equation": said("partly explained", [EFFECT], LEFT, FOUND),
    "unexplained": said("unexplained", left=LEFT),
    "unexplained, with an equation": said("unexplained", left=LEFT, unnamed=FOUND),
    "unexplained, by one of several": said("unexplained", left=LEFT, unnamed=FOUND, rivals=RIVALS),
    "open": on_question(Question(OPEN, "read it in other axes"), said("explained", [EFFECT])),
    "unusable": on_question(Question("it carries no answer", "look at it", "unusable"), said("unexplained")),
}


@pytest.mark.parametrize("case", HEADS)
def test_three_sentences_of_which_the_last_says_what_to_do(case):
    told = sentences(HEADS[case].text)
    assert 2 <= len(told) <= 3, told
    assert told[-1].startswith(("Next, ", "There is nothing to correct"))
    assert all(sentence[0].isupper() and sentence.endswith(".") for sentence in told)


@pytest.mark.parametrize(
    ("share", "told"),
    [
        (0.8, "; it removes 80% of the squared error on sweeps that its fit has not seen, mostly in Fy."),
        (0.0, "; it removes none of the squared error on sweeps"),
        (-0.1, "; it adds 10% to the squared error on sweeps"),
        (1.7, "; without it the other effects leave a larger error than there was before on sweeps"),
        (-1.7, "; beside the other effects it leaves a larger error than there was before on sweeps"),
        (float("nan"), "Probability 99%."),
    ],
)
def test_what_an_effect_removes_is_said_in_words_where_it_is_no_share(share, told):
    """Where effects undo each other, "it removes – of the squared error"."""
    said_of_it = certainty_of(replace(EFFECT, share=share))
    assert told in said_of_it
    assert "–" not in said_of_it


def test_an_equation_is_in_the_middle_and_its_drivers_beside_it():
    told = HEADS["unexplained, with an equation"]
    assert "an equation in speed takes the RMS error of Fy from 300 N to 120 N" in sentences(told.text)[1]
    assert any("it depends most on speed" in remark for remark in told.remarks)
    assert any(
        "removes 60% of the remaining RMS error of Fy" in r
        for r in HEADS["partly explained, with an equation"].remarks
    )


def test_where_nothing_is_added_no_error_after_it_is_told():
    assert "the model stays as it is, with an RMS error of Fy 300 N (noise 20 N)" in NOT_ADDED.text
    assert "corrected model" not in NOT_ADDED.text
    assert "120 N" not in NOT_ADDED.text


def test_explanations_of_which_none_stands_out_are_listed():
    told = HEADS["unexplained, by one of several"]
    titles = [" with ".join(catalogue()[n].title for n in names) for names in RIVALS]
    assert (
        f"which of these explains the difference (Fy 280 N RMS above noise): {' or '.join(titles)}"
        in told.text
    )
    assert any("has several explanations in the catalogue" in remark for remark in told.remarks)
    many = said("unexplained", left=LEFT, rivals=[(name,) for name in sorted(catalogue())[:5]]).text
    assert many.split(".")[0].endswith(", or others")


def test_several_open_causes_are_named_in_a_short_sentence():
    """With four alternatives it had 60 words: each cause said again that it is not told apart."""
    one = replace(EFFECT, alternatives=("load_gain", "force_gain"))
    other = replace(
        EFFECT, name="slip_angle_offset", title="slip offset", alternatives=("plysteer_conicity",)
    )
    told = said("ambiguous", [one, other])
    first = sentences(told.text)[0]
    assert len(first.split()) < 40
    assert all(catalogue()[n].title in first for n in ("load_gain", "force_gain", "plysteer_conicity"))
    assert any('joined by "or"' in note for note in told.notes)
    alone = said("ambiguous", [one])
    assert "this recording cannot tell them apart" in alone.text
    assert not any('joined by "or"' in note for note in alone.notes)


def test_a_cause_without_a_name_stands_beside_what_would_do_as_well():
    """A lag in distance explained all, and the page said that no effect of the catalogue does."""
    told = said("unexplained", left=LEFT, unnamed=FOUND, rivals=[(), ("relaxation_length",)])
    title = catalogue()["relaxation_length"].title
    assert f": a cause that the catalogue does not have or {title}" in told.text
    assert any("has an explanation in the catalogue" in remark for remark in told.remarks)


def test_what_an_equation_predicts_of_unseen_sweeps_was_no_noise():
    noisy = {"fy": replace(FIT["fy"], noise_floor=100.0), "fx": OutputFit(30.0, 25.0, 25.0, 24.0, 26.0)}
    told = with_unnamed(noisy, FOUND)
    assert told["fy"].noise_floor == told["fy"].rms_after == pytest.approx(48.0)
    assert told["fx"] is noisy["fx"]


def test_all_that_is_above_the_noise_is_a_hundred_percent_and_no_dash():
    shares = (1.0, 0.996, 0.5, -1.0, 0.0, 1.7, float("nan"))
    assert [percent(share) for share in shares] == ["100%", "100%", "50%", "-100%", "–", "–", "–"]


@pytest.mark.parametrize(("felt", "said"), [(-0.24, "0%"), (-0.001, "0%"), (0.4, "40%"), (1.22, "100%")])
def test_a_share_that_a_force_follows_lies_between_nothing_and_all(felt, said):
    told = Cleaning("camber", smoothed=True, removed=1e-4, felt=felt, evidence=3.0).text()
    assert f"the force follows {said} of it" in told


@pytest.mark.parametrize("effect", catalogue().values(), ids=catalogue())
def test_what_to_do_next_is_something_to_do(effect):
    first = effect.experiment.split(" ")[0]
    assert first in ("", "record", "repeat", "hang", "look", "drive", "turn")


@pytest.mark.parametrize("case", HEADS)
def test_a_held_out_recording_adds_no_sentence(case):
    errors = {"fy": PredictionError(310.0, 130.0, 0.4, 0.5)}
    told = with_held_out(HEADS[case], HeldOutFit("b", 900, errors), [])
    assert len(sentences(told.text)) <= 3
    assert "in b, which was held out, the RMS error of Fy falls from 310 N to 130 N" in told.text.replace(
        "In b", "in b"
    )


def test_an_equation_that_did_not_hold_is_gone_from_head_and_errors():
    for verdict, effects in (("unexplained", []), ("partly explained", [EFFECT])):
        plain, put_in = FIT, with_unnamed(FIT, FOUND)
        told = head(verdict, effects, put_in, [PLACE], LEFT, "", unnamed=FOUND)
        again = without_unnamed(put_in, FOUND)
        assert again["fy"].rms_after == pytest.approx(plain["fy"].rms_after)
        assert put_in["fy"].rms_after == pytest.approx(0.4 * plain["fy"].rms_after)
        left = without_equation(told, verdict, effects, again)
        assert left.text == head(verdict, effects, again, [PLACE], LEFT, "").text
        assert "equation" not in " ".join([left.text, *left.remarks])


@pytest.mark.parametrize(
    ("when", "said"),
    [
        ([(10.0, 20.0)], " (seen between 10 and 20 s),"),
        ([(10.0, 20.0), (30.0, 41.5)], " (seen between 10 and 20 s, 30.0 and 41.5 s),"),
        ([(0.0, 80.0)], ","),
        ([], ","),
    ],
)
def test_the_summary_says_when_an_effect_is_seen(when, said):
    text = head("explained", [replace(EFFECT, when=when)], FIT, [], NONE, "", {"time": (0.0, 100.0)}).text
    assert text.startswith(
        f"Explained: the difference comes from {EFFECT.title}{said} which the model leaves out. "
    )
    assert text.endswith("Next, test the corrected model on another recording before you use it.")


@pytest.mark.parametrize(
    ("when", "mean"), [([(10.0, 20.0)], 0.1), ([(10.0, 20.0)], 0.3), ([(0.0, 80.0)], 0.1)]
)
def test_what_differs_to_both_sides_is_not_said_by_a_small_mean(when, mean):
    effect = replace(EFFECT, when=when, share=0.9)
    at = replace(PLACE, axis="time", low=10.0, high=20.0, mean=mean * FIT["fy"].rms_before, share=0.01)
    text = head("explained", [effect], FIT, [at], NONE, "", {"time": (0.0, 100.0)}).text
    said = "Fy differs most between 10 and 20 s, to both sides" in text
    assert said == (when == [(10.0, 20.0)] and mean < 0.2)
    assert ("is on average" in text) != said


def test_the_place_is_on_the_axis_of_what_is_named():
    """Hidden pressure was placed at the temperature of the tread, which each sweep warms up."""
    ranges = {"pressure": (7e4, 8.4e4), "tread_temperature": (30.0, 75.0)}
    where = {"pressure": (7e4, 7.1e4), "tread_temperature": (50.0, 70.0)}
    warm = replace(PLACE, axis="tread_temperature", low=56.0, high=58.0, mean=80.0)
    low = replace(PLACE, axis="pressure", low=7e4, high=7.1e4, mean=57.0)
    named, unnamed = (
        head("explained", effects, FIT, [warm, low], NONE, "", ranges).text
        for effects in ([replace(EFFECT, name="inflation_pressure", where=where)], [EFFECT])
    )
    assert "At pressure below 71 kPa, Fy is on average 57 N" in named
    assert "tread temperature" not in named
    assert "At tread temperature between 56 and 58 degC" in unnamed


@pytest.mark.parametrize(
    ("where", "even"),
    [
        ({"slip_angle": (-0.2, 0.2), "tread_temperature": (38.0, 41.0)}, {}),
        ({"slip_angle": (-0.2, 0.2), "tread_temperature": (30.0, 70.0)}, {}),
        ({}, {"fy": Throughout(-250.0, -0.1)}),
    ],
)
def test_no_place_is_on_an_axis_that_merely_came_along(where, even):
    """An offset of the slip angle was placed at the tread's temperature, a gain in the time of a sweep."""
    ranges = {"slip_angle": (-0.21, 0.21), "tread_temperature": (30.0, 75.0), "time": (0.0, 60.0)}
    effect = replace(EFFECT, name="slip_angle_offset" if where else "force_gain", where=where)
    warm = replace(PLACE, axis="tread_temperature", low=38.0, high=41.0, mean=300.0)
    late = replace(PLACE, axis="time", low=21.0, high=41.0, mean=-300.0)
    told = head("explained", [effect], FIT, [warm, late, PLACE], NONE, "", ranges, even).text
    assert "t slip angle between 5.73 and" in told
    assert "temperature" not in told
    assert "41 s" not in told


TIMED = {"time": (0.0, 60.0), "pressure": (2e5, 3e5), "slip_ratio": (-0.2, 0.0), "slip_angle": (-0.1, 0.1)}
IN_TIME = replace(PLACE, axis="time", low=22.5, high=37.6, mean=160.0)


@pytest.mark.parametrize(
    ("name", "driver", "said"),
    [
        ("inflation_pressure", ("pressure", 2e5, 2.5e5), "At pressure below 250 kPa, Fy"),
        ("combined_slip", ("slip_ratio", -0.2, -0.1), "At slip ratio below -0.1, Fy"),
        ("sensor_drift", ("pressure", 2e5, 2.5e5), "Between 22.5 and 37.6 s, "),
        ("wear", ("pressure", 2e5, 2.5e5), "Between 22.5 and 37.6 s, "),
    ],
)
def test_what_a_channel_drives_is_placed_by_the_channel_and_what_lives_in_time_by_time(name, driver, said):
    """A hidden pressure was placed between 22.5 and 37.6 s: the pressure was low in that time."""
    axis, low, high = driver
    there = replace(PLACE, axis=axis, low=low, high=high, mean=127.0)
    effect = replace(EFFECT, name=name, when=[(20.0, 45.0)], where={axis: TIMED[axis]})
    text = head("explained", [effect], FIT, [IN_TIME, there], NONE, "", TIMED).text
    assert said in text
    assert (" s," in text) == said.startswith("Between")


def test_a_driver_that_did_not_vary_is_no_place():
    effect = replace(EFFECT, name="inflation_pressure", where={"pressure": (2.5e5, 2.5e5)})
    ranges = {"time": TIMED["time"]}
    text = head("explained", [effect], FIT, [IN_TIME], NONE, "", ranges).text
    assert "Between 22.5 and 37.6 s, Fy is on average 160 N" in text


@pytest.mark.parametrize(
    ("camber", "gain", "placeless"),
    [(True, True, []), (True, False, ["A wrong gain"]), (False, True, ["Camber"]), (False, False, [])],
)
def test_an_effect_without_a_place_is_said_to_have_none_beside_one_that_has(camber, gain, placeless):
    """A page placed the camber and was silent about the gain that it named beside it."""
    ranges = {"camber": (0.0, 0.035), "normal_load": (1000.0, 6000.0)}
    here = {True: {"camber": (0.03, 0.035)}, False: {"camber": (0.0, 0.035)}}
    effects = [
        replace(EFFECT, title="camber", where=here[camber]),
        replace(EFFECT, title="a wrong gain", where=here[gain]),
    ]
    told = head("explained", effects, FIT, [replace(PLACE, mean=-90.0)], NONE, "", ranges)
    said = [r for r in told.remarks if "no place of its own" in r]
    assert [r.split(" has ")[0] for r in said] == placeless


@pytest.mark.parametrize(
    ("share", "said"), [(-0.1, "10% lower"), (1.0, "at least 100% higher"), (1.13, "at least 100% higher")]
)
def test_what_is_off_throughout_is_at_no_place_of_an_effect(share, said):
    """A gain does most at large loads, and is everywhere."""
    ranges = {"normal_load": (1000.0, 6000.0)}
    effect = replace(EFFECT, where={"normal_load": (4000.0, 6000.0)})
    even = {"fy": Throughout(900.0 * share, share)}
    text = head("explained", [effect], FIT, [replace(PLACE, mean=-90.0)], NONE, "", ranges, even).text
    assert f"Fy is {said} than the model throughout" in text
    assert "changes Fy" not in text


def test_an_effect_that_no_sure_mean_shows_is_said_to_be_where_it_acts():
    effect = replace(EFFECT, title="camber", where={"camber": (0.03, 0.035)}, share=0.1)
    warm = replace(PLACE, axis="tread_temperature", low=56.0, high=58.0, mean=80.0)
    text = head("explained", [effect], FIT, [warm], NONE, "", {"camber": (0.0, 0.035)}).text
    assert "Camber changes Fy at camber above 1.72 deg; with that corrected" in text
    assert "tread temperature" not in text


def test_what_differs_to_both_sides_is_at_the_channel_that_holds_the_effect():
    effect = replace(EFFECT, share=0.9, where={"camber": (0.03, 0.035)})
    text = head(
        "explained", [effect], FIT, [replace(PLACE, mean=30.0)], NONE, "", {"camber": (0.0, 0.035)}
    ).text
    assert "Fy differs most at camber above 1.72 deg, to both sides" in text


@pytest.mark.parametrize(
    ("after", "ratio", "said", "todo"),
    [
        (130.0, (0.4, 0.5), "falls from 310 N to 130 N", "use the corrected model within the ranges"),
        (400.0, (1.1, 1.4), "rises from 310 N to 400 N: what was found does not hold there", "find out what"),
        (305.0, (0.9, 1.1), "is about the same as before", "keep the model as it is"),
    ],
)
def test_what_to_do_after_a_held_out_recording_goes_by_its_error(after, ratio, said, todo):
    fit = HeldOutFit("b", 900, {"fy": PredictionError(310.0, after, *ratio)})
    told = with_held_out(head("explained", [EFFECT], FIT, [PLACE], NONE, ""), fit, [EFFECT])
    assert f"the RMS error of Fy {said}" in told.text
    assert todo in told.text


@pytest.mark.parametrize(
    ("name", "alternatives", "causes"),
    [
        ("force_gain", (), "a fault of the recording"),
        ("force_gain", ("sensor_drift",), "a fault of the recording"),
        ("wear", ("temperature",), "which the model leaves out"),
        ("force_gain", ("temperature", "friction_scale"), "a fault of the recording or something that"),
        ("friction_scale", ("force_gain",), "a fault of the recording or something that"),
    ],
)
def test_what_may_be_a_fault_or_the_tire_is_called_neither(name, alternatives, causes):
    effect = replace(EFFECT, name=name, kind=catalogue()[name].kind, alternatives=alternatives)
    told = said("ambiguous" if alternatives else "explained", [effect]).causes
    assert causes in told
    assert ("which the model leaves out" in told) + ("a fault of the recording" in told) == 1


@pytest.mark.parametrize(("after", "worse"), [(11.0, True), (10.0, False)])
def test_a_moment_that_the_correction_makes_worse_is_said(after, worse):
    told = on_moments(made_worse({"mz": OutputFit(1.0, 10.0, after, 9.0, 18.0)}))
    assert ("Mz 10 N m before, 11 N m after" in told) is worse


def test_the_place_and_the_error_are_of_one_force():
    """Fx is off most, and Fy alone is corrected: "Fx is lower; with that corrected, Fy ..."."""
    fit = {**FIT, "fx": OutputFit(40.0, 400.0, 400.0, 390.0, 410.0)}
    other = replace(PLACE, output="fx", axis="slip_ratio", mean=-900.0)
    told = head("explained", [EFFECT], fit, [other, PLACE], NONE, "")
    assert "Fy" in told.spot
    assert "Fx" not in told.spot
    assert "RMS error of Fy" in told.size
