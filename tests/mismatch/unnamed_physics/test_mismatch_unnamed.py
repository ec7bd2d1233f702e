"""Unnamed physics: the grammar, its reader, hostile sidecars, and what is found and proved."""

import re
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest
from unnamed_problem import NOMINAL, by_memory, by_speed, jolt, nothing, physics, problem, swinging, table
from weighed import all_but, without_visible

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.corrected.as_recorded import never_worse
from tire_pipeline.mismatch.model.residual import rms
from tire_pipeline.mismatch.unnamed_physics.against_names import NamesToBeat
from tire_pipeline.mismatch.unnamed_physics.found import Alternative, from_sidecar
from tire_pipeline.mismatch.unnamed_physics.language.grammar import EquationError, evaluate, parse
from tire_pipeline.mismatch.unnamed_physics.library import memory_factors
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import by_condition
from tire_pipeline.mismatch.unnamed_physics.products import FOLDS, Columns
from tire_pipeline.mismatch.unnamed_physics.prove import judged
from tire_pipeline.mismatch.unnamed_physics.search import find, find_better
from tire_pipeline.mismatch.unnamed_physics.where_it_holds import distance, way_through_play
from tire_pipeline.tir import read_tir

DOCS = Path(__file__).parents[3] / "docs" / "reference" / "unnamed_physics.md"


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os').system('true')",
        "fy.__class__",
        "open(fy)",
        "fy; fx",
        "lag(fy, -1)",
        "lag(fy)",
        "1e999",
        "fy**2",
        "(" * 900 + "fy" + ")" * 900,
        "+".join(["fy"] * 2000),
        "fy)",
        "",
    ],
)
def test_what_is_not_of_the_grammar_is_refused(text):
    with pytest.raises(EquationError):
        parse(text)


@pytest.mark.parametrize(
    "change",
    [
        {"equation": {"fy": "secret*fy"}},
        {"equation": {"mx": "fy"}},
        {"equation": {}},
        {"equation": "fy"},
        {"range": {"v": [2.0, 1.0]}},
        {"range": {"v": [float("nan"), 1.0]}},
        {"range": {"x": [0.0, 1.0]}},
        {"range": {"sqrt(secret*fy)": [0.0, 1.0]}},
        {"nominal": {"F0": 0.0}},
        {"nominal": {**asdict(NOMINAL), "F0": -1.0}},
        {"format": "other"},
        {"fade": 1e9},
        {"depends_on": 5},
        {"acts_on": "x" * 30_000},
    ],
)
def test_a_hostile_sidecar_is_refused(change):
    entry = physics("0.1*fy*v").to_sidecar()
    assert from_sidecar(entry).equations == {"fy": "0.1*fy*v"}
    with pytest.raises(EquationError):
        from_sidecar({**entry, **change})


def test_a_value_that_is_not_finite_is_refused():
    columns, _, _ = table()
    with pytest.raises(EquationError):
        evaluate(parse("fy/(L - L)"), columns)


def test_outside_of_its_range_it_fades_to_nothing():
    columns, _, _ = table()
    v = columns.columns["v"]
    found = physics("100*v", {"v": (0.9, 1.1)})
    change = found.change(columns)["fy"]
    inside, far = (v >= 0.9) & (v <= 1.1), (v < 0.84) | (v > 1.16)
    assert inside.any()
    assert far.any()
    np.testing.assert_allclose(change[inside], 100.0 * v[inside])
    assert np.all(change[far] == 0.0)


def test_terms_that_cancel_fade_where_they_do_not_cancel_any_more():
    """Each channel within its range, but one term alone: 0.22 N of error became 0.52 N on a small car."""
    columns, _, _ = table()
    fy, v = columns.columns["fy"], columns.columns["v"]
    seen = {"fy": fy, "fy*(v^3)": fy * (1.0 + 0.01 * np.sin(np.arange(v.size)))}
    text, most = distance(seen)
    found = physics("fy - fy*(v^3)", {"v": (0.0, 2.0), text: (0.0, most)})
    weight = found.weight(columns)
    assert np.all(weight[np.abs(v - 1.0) < 0.01] > 0.9)
    assert np.all(weight[(np.abs(v - 1.0) > 0.3) & (np.abs(fy) > 2000.0)] == 0.0)
    assert distance({"fy": fy}) is None


def test_an_equation_with_play_adds_nothing_before_its_gap_is_spanned():
    """At the start nobody knows at which end of the gap a joint is: 54 N of error became 240 N."""
    columns, _, _ = table()
    memories = list(memory_factors(frozenset({"slip_angle", "time"})))
    play = next(f for f in memories if f.text == "play(s, {}) - s").at(0.01)
    text, (low, high) = way_through_play(play, columns)
    s = columns.columns["s"]
    assert high == pytest.approx(s.max() - s.min())
    assert low == pytest.approx(max(0.02, 0.2 * high))
    found = physics(f"fy*({play.written})", {text: (low, high)})
    assert found.weight(columns)[0] == 0.0
    assert found.weight(columns)[-1] == 1.0
    still = replace(columns, columns={**columns.columns, "s": 1e-6 * s})
    assert np.abs(found.weight(still)).max() < 1e-4
    assert way_through_play(memories[0], columns) is None


def test_a_sidecar_of_the_first_format_is_read():
    entry = physics("0.1*fy*v").to_sidecar()
    assert from_sidecar({**entry, "format": "unnamed physics 1"}).equations == {"fy": "0.1*fy*v"}


NOISE = 5.0
"""N, where the forces are some hundred: how often the driver is found in four times as much: ``rates``."""


@pytest.fixture(scope="module")
def of_speed():
    """A problem with a force that speed drives, and what is found in it."""
    seen = problem(by_speed, noise=NOISE)
    return seen, find(seen)


def test_speed_is_found_as_the_driver_and_its_square_as_the_form(of_speed):
    _, found = of_speed
    assert found.physics.depends_on == ("speed",)
    assert "v^2" in found.physics.equations["fy"]
    assert "fx" not in found.physics.equations
    before, after, _ = found.unseen["fy"]
    assert after < 0.3 * before
    value, error = found.coefficients[0]
    assert abs(value + 0.05) < 4.0 * error + 0.002


@pytest.mark.parametrize(("taken_up", "beaten"), [(0.5, True), (0.9, False), (1.0, False)])
def test_an_equation_beats_names_that_take_up_a_part_and_not_those_that_take_up_nearly_all(taken_up, beaten):
    seen = problem(by_speed, noise=NOISE)
    part = by_speed(seen.table)
    names = {o: rest - taken_up * part if o == "fy" else rest for o, rest in seen.rest.items()}
    found = find_better(seen, NamesToBeat(names))
    assert (found is not None) is beaten
    if found is not None:
        assert found.physics.depends_on == ("speed",)


def test_a_force_is_kept_only_if_it_is_itself_surely_better():
    """What makes the sum of both better may make one of them worse elsewhere."""
    seen = problem(by_speed, noise=NOISE)
    rest = {**seen.rest, "fx": seen.rest["fx"] + jolt(seen.table)}
    seen = replace(seen, rest=rest)
    predicted = {"fx": jolt(seen.table), "fy": by_speed(seen.table)}
    proof = judged(Columns(seen), predicted, FOLDS)
    assert np.mean((rest["fx"] - predicted["fx"]) ** 2) < 0.5 * np.mean(rest["fx"] ** 2)
    assert proof.outputs == ("fy",)
    assert proof.holds


def test_a_force_has_its_own_equation_where_another_force_takes_up_all_terms():
    """Three strong causes act on fx; one equation of three terms would leave out what acts on fy."""
    seen = problem(by_speed, noise=NOISE)
    x = seen.table.columns
    strong = 0.3 * x["fx"] * (x["g"] / 0.04) + 0.3 * x["F0"] * x["h"] + 0.3 * x["fx"] * x["L"]
    seen = replace(seen, rest={**seen.rest, "fx": seen.rest["fx"] + strong})
    physics = find(seen).physics
    assert "v" in physics.equations["fy"]
    before = np.mean(seen.rest["fy"] ** 2)
    assert np.mean((seen.rest["fy"] - physics.change(seen.table)["fy"]) ** 2) < 0.3 * before


def test_a_channel_that_was_held_may_differ_by_what_counts_as_held():
    """A slip ratio that is zero but for the encoder's steps is a range without a width."""
    seen = problem(by_speed, noise=NOISE)
    still = {**seen.table.columns, "k": np.zeros(seen.table.size)}
    physics = find(replace(seen, table=replace(seen.table, columns=still))).physics
    assert "k" in physics.ranges
    moved = replace(seen.table, columns={**still, "k": np.full(seen.table.size, 1e-4)})
    assert np.mean(physics.weight(moved)) > 0.9


def test_at_a_load_that_was_not_recorded_an_equation_adds_nothing(of_speed):
    """It multiplies forces: what they do at that load was never compared with it."""
    seen, found = of_speed
    physics = found.physics
    columns = dict(seen.table.columns)
    inside = physics.weight(seen.table) > 0.0
    assert inside.mean() > 0.95
    twice = replace(seen.table, columns={**columns, "L": 2.0 * columns["L"].max() + 0.0 * columns["L"]})
    assert not np.any(physics.weight(twice))


def test_a_recording_that_turns_to_one_side_gives_no_equation():
    both = problem(by_speed, noise=NOISE)
    one = {**both.table.columns, "s": np.abs(both.table.columns["s"])}
    found = find(replace(both, table=replace(both.table, columns=one)))
    assert found.physics is None
    assert "one side" in found.why_not


def test_a_memory_is_found_where_the_force_follows_what_was():
    assert find(problem(by_memory, noise=NOISE)).physics.depends_on == ("memory of slip_angle",)


RIVALS = ("nonuniformity", "friction_scale", "force_gain", "force_offset", "sensor_drift", "surface_change")
"""Of an equation of the way rolled."""


@pytest.fixture(
    scope="module", params=[RIVALS, pytest.param((), marks=pytest.mark.ci)], ids=["rivals", "catalogue"]
)
def on_a_drum(tire, record, request):
    """A recording whose forces swing by a quarter, and its report; by less: ``rates``."""
    recording = swinging(record(9), 0.25)
    return recording, explain_mismatch(
        tire, recording, without=all_but(*request.param) if request.param else ()
    )


def test_an_equation_is_in_the_corrected_model_and_makes_it_better(on_a_drum):
    recording, report = on_a_drum
    assert report.unnamed.physics.depends_on == ("path",)
    assert "time" not in report.unnamed.independent_of, "the way rolled goes with it"
    assert max(report.unnamed.drivers.values()) <= 1.0
    named = replace(report.corrected, unnamed=None).predict(recording)
    with_it = report.corrected.predict(recording)
    left = {n: np.std(recording["fy"] - f["fy"]) for n, f in (("named", named), ("all", with_it))}
    assert left["all"] < 0.7 * left["named"]
    assert report.fit["fy"].rms_after < report.fit["fy"].rms_before
    assert any("it depends most on path" in remark for remark in report.head.remarks)


def test_the_sidecar_holds_the_equation_and_reads_back(on_a_drum, tmp_path):
    _, report = on_a_drum
    written = report.corrected.to_tir(tmp_path / "corrected.tir")
    entry = read_tir(written).metadata["sidecar"]["unnamed"]
    assert entry["title"] == "unnamed: depends on path"
    read = from_sidecar(entry)
    assert read.equations == report.corrected.unnamed.equations
    assert read.ranges["t"] == pytest.approx(report.corrected.unnamed.ranges["t"])


@pytest.mark.parametrize("change", [{"time": 1e4}, {"normal_load": 1e-6}], ids=["later", "at once"])
def test_an_equation_of_the_way_is_left_out_of_another_recording_and_that_is_said(on_a_drum, change):
    """Another recording has another phase, even where its clock starts at the same time."""
    recording, report = on_a_drum
    other = recording.assign(**{name: recording[name] + by for name, by in change.items()})
    empty = replace(report.corrected.unnamed, equations={"fy": "0*fy"})
    without = replace(report.corrected, unnamed=empty).predict(other)
    with_it = report.corrected.predict(other)
    np.testing.assert_allclose(with_it["fy"], without["fy"])
    assert "left out at 100.0% of the samples" in with_it.attrs["notes"][0]
    assert "left out" not in " ".join(report.corrected.predict(recording).attrs["notes"])


def test_the_page_and_the_dictionary_show_it_apart_from_ideas(on_a_drum, tmp_path):
    report = without_visible(on_a_drum[1])
    page = report.to_html(tmp_path / "report.html").read_text("utf-8")
    assert "Unnamed physics" in page
    assert "Ideas to test" in page
    assert page.index("sin(way/") < page.index("Ideas to test")
    shown = re.findall(r"<code>(f[xy] \+= .*?)</code>", page)
    assert shown
    assert not re.search(r"\d\.\d{6}", " ".join(shown)), "digits that no reader needs"
    assert f"F0: {report.unnamed.physics.nominal.F0:,.6g} N" in page
    used = set().union(*(parse(text.split(" += ")[1]).symbols for text in shown))
    assert not [symbol for symbol in used if f"{symbol}: " not in page], "a symbol that nobody explains"
    told = report.to_dict()["unnamed"]
    assert told["physics"]["equations"]["fy"] == report.unnamed.physics.equations["fy"]
    assert [idea["name"] for idea in told["ideas"]] == ["drum or wheel out of round"]


def test_a_page_without_an_equation_has_nothing_as_good_and_no_line(on_a_drum, tmp_path):
    report = without_visible(on_a_drum[1])
    found = replace(report.unnamed, alternatives=[Alternative({"fy": "0.1*fy*v"}, ("speed",), 9.0)])
    pages = {}
    for name, unnamed in (("with", found), ("without", found.refused("it predicts no better"))):
        told = replace(report, unnamed=unnamed)
        pages[name] = told.to_html(tmp_path / f"{name}.html").read_text("utf-8")
    claims = ("Equally good", "The line should go", "Nothing points to", "95% intervals")
    assert all(words in pages["with"] for words in claims[:2])
    assert not [words for words in claims if words in pages["without"]]
    assert "No equation is in the corrected model: it predicts no better" in pages["without"]
    assert "Possible drivers" in pages["without"]


def test_where_nothing_is_found_the_report_says_why_and_the_documented_lines_run(tire, record, tmp_path):
    """``agrees`` has drivers with evidence, too: odds alone do not say that nothing is there."""
    few = all_but("friction_scale", "stiffness_scale", "force_offset")
    agreeing = explain_mismatch(tire, record(9).iloc[:1500], without=few)
    assert agreeing.verdict == "agrees"
    lines = re.search(r"```python\n(.*?)```", DOCS.read_text(encoding="utf-8"), re.DOTALL)[1]
    exec(compile(lines, DOCS.name, "exec"), {"report": agreeing})
    assert agreeing.unnamed.physics is None
    assert agreeing.unnamed.why_not
    assert agreeing.to_dict()["unnamed"]["why_not"] == agreeing.unnamed.why_not
    page = without_visible(agreeing).to_html(tmp_path / "agrees.html").read_text("utf-8")
    assert "Unnamed physics" not in page, "nothing asks for an equation"


def test_an_effect_can_be_taken_out_of_the_catalogue(tire, record):
    with pytest.raises(RecordingError, match="no such_effect"):
        explain_mismatch(tire, record(9), without=("such_effect",))
    report = explain_mismatch(tire, record(8, offset=150.0).iloc[:1500], without=all_but("force_gain"))
    assert "force_offset" not in [e.name for e in report.effects]
    rows = {row["name"]: row["why"] for row in report.candidates}
    assert rows["force_offset"] == "it was taken out of the catalogue"


def test_without_speed_no_equation_remembers_the_way_rolled():
    """One that did could not be put into the recording that it was found in."""
    without = [factor.text for factor in memory_factors(frozenset({"time", "slip_angle", "normal_load"}))]
    known = [
        factor.text for factor in memory_factors(frozenset({"time", "way", "slip_angle", "normal_load"}))
    ]
    assert without
    assert not any("lagway(" in text for text in without)
    assert any("lagway(" in text for text in known)


def levels(count):
    """A recording at so many loads, each in several sweeps."""
    both = problem(nothing)
    sweeps = int(both.block.max()) + 1
    load = np.linspace(0.5, 1.5, count)[np.arange(sweeps) % count][both.block]
    columns = {**both.table.columns, "L": load, "v": np.ones(load.size), "g": np.zeros(load.size)}
    moves = frozenset({"slip_angle", "normal_load", "time"})
    return replace(both, table=replace(both.table, columns=columns), moves=moves), load


def test_whole_operating_conditions_are_held_out_where_there_is_more_than_one():
    recording, load = levels(6)
    together = by_condition(recording).together
    assert len(set(zip(together, load, strict=True))) == len(set(load)) == len(set(together)) == 6
    assert len(set(by_condition(levels(2)[0]).together)) == 2
    one = levels(1)[0]
    assert by_condition(replace(one, moves=one.moves - {"normal_load"})).together is None


def test_a_condition_is_in_one_fold_only():
    recording, load = levels(7)
    folds = Columns(by_condition(recording)).folds
    assert all(len(set(folds[load == one])) == 1 for one in set(load))
    assert any(len(set(Columns(recording).folds[load == one])) > 1 for one in set(load))


def test_what_was_proved_is_no_agreement(on_a_drum):
    """Nothing in the catalogue swings with the drum, and odds alone would have called it agreement."""
    _, report = on_a_drum
    assert not report.effects
    assert report.verdict == "unexplained"


def test_an_equation_alone_leaves_the_inputs_as_they_were_recorded(on_a_drum):
    """With a cleaned input the forces that it does not act on would change as well."""
    recording, report = on_a_drum
    assert not report.corrected.changes
    noisy = replace(report.corrected, unnamed=None, cleaned={"slip_angle": 1e-4})
    _, with_it = never_worse(report.unnamed, noisy, recording)
    assert with_it.unnamed is not None
    assert with_it.cleaned == {}


def test_an_equation_knows_nothing_of_what_is_left_out(on_a_drum):
    """It was said to take a third off an error of which half was what open explanations do not agree on."""
    recording, report = on_a_drum
    shifted = recording.assign(fy=recording["fy"] + 600.0)
    offset = (("force_offset", {"fy": 600.0, "fx": 0.0}),)
    half = replace(report.corrected, unnamed=None, changes=offset, part=0.5)
    found, with_it = never_worse(report.unnamed, half, shifted)
    left, own = np.square(found.unseen["fy"]), np.square(report.unnamed.unseen["fy"])
    assert left[0] - own[0] == pytest.approx(300.0**2, rel=0.2)
    assert left[0] - left[1] == pytest.approx(own[0] - own[1], rel=0.3)
    assert rms(shifted["fy"] - with_it.predict(shifted)["fy"]) < 1.05 * np.sqrt(left[1])
    again, _ = never_worse(report.unnamed, replace(half, part=1.0), shifted)
    assert again.unseen == report.unnamed.unseen
