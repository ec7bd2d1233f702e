"""The half of the proof from real recordings: scorer, nodes, and what is shown without the recordings."""

import json
import re

import pandas as pd
import pytest

from tire_pipeline.concealed import EffectTruth
from tire_pipeline.concealed.effect_names import UNKNOWN_EFFECTS
from tire_pipeline.concealed.proof import recorded as real_nodes
from tire_pipeline.concealed.proof.simulated import ProveConcealedParameters
from tire_pipeline.concealed.real import RealAnswer
from tire_pipeline.concealed.real.parameters import RealParameters
from tire_pipeline.concealed.real.published import published_text
from tire_pipeline.concealed.real.score_sets import score_real
from tire_pipeline.concealed.scoring.findings import name_sets
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.reporting.proof.proof_page import proof_page
from tire_pipeline.reporting.proof.proof_tables import misses_table


def answer(case_id: str, kind: str, *names: str, over_misfit: float = 3.0, source="calspan", **more):
    effects = tuple(
        EffectTruth(n, "physics", 1.0, 50.0, over_misfit, over_misfit, "fy", (), {}, {}) for n in names
    )
    oracle = {"fy": {"rms_before": 100.0, "rms_oracle": 40.0}}
    return RealAnswer(
        case_id, kind, effects, (), (), (), (), 3000.0, 30.0, 30.0, oracle, source=source, **more
    )


def report(*sets: tuple[tuple[str, ...], float]) -> dict:
    return {
        "verdict": "explained",
        "effects": [{"name": n[0], "alternatives": list(n[1:]), "confidence": p} for n, p in sets],
    }


def held(*cases: str, after: float = 50.0) -> dict:
    return {c: {"fy": {"rms_before": 100.0, "rms_after": after}} for c in cases}


def value(result: dict, name: str, source: str = "all"):
    (row,) = [r for r in result["scores"] if r["name"] == name and r["source"] == source]
    return row["value"]


def test_sets_are_read_from_the_report_or_made_of_name_and_alternatives():
    told = report((("wear", "temperature"), 0.8))
    assert name_sets(told) == [(("wear", "temperature"), 0.8)]
    assert name_sets({**told, "sets": [[["wear"], 0.7]]}) == [(("wear",), 0.7)]
    assert name_sets({**told, "sets": [{"names": ["wear"], "confidence": 0.7}]}) == [(("wear",), 0.7)]
    assert name_sets({**told, "sets": None}) == name_sets(told)
    assert name_sets({"sets": [[["unexplained"], 0.7]]}) == []


def test_right_first_among_and_too_many_names():
    answers = [
        answer("first", "single", "wear"),
        answer("second", "single", "wear"),
        answer("crowd", "single", "wear"),
        answer("wrong", "single", "wear"),
        answer("weak", "single", "wear", over_misfit=1.0),
        answer("lag", "ambiguous", "time_delay"),
    ]
    reports = {
        "first": report((("wear",), 0.9)),
        "second": report((("temperature", "wear"), 0.9)),
        "crowd": report((("wear", "temperature", "camber", "turn_slip"), 0.9)),
        "wrong": report((("camber",), 0.9)),
        "weak": report(),
        "lag": report((("relaxation_length", "time_delay"), 0.9)),
    }
    result = score_real(reports, answers, held_out=held(*reports))
    assert value(result, "right name first, twice the misfit") == pytest.approx(1 / 4)
    assert value(result, "the same, ambiguous ones too") == pytest.approx(1 / 5)
    assert value(result, "truth among the names, twice the misfit") == pytest.approx(3 / 5)
    assert value(result, "truth among the names, any strength") == pytest.approx(3 / 6)
    assert value(result, "sets that hold nothing of the truth") == pytest.approx(1 / 4)
    assert value(result, "sets of more than three names") == pytest.approx(1 / 5)
    assert value(result, "names a set") == pytest.approx((1 + 2 + 4 + 1 + 2) / 5)
    assert {m["case"] for m in result["misses"]} == {"second", "crowd", "wrong", "weak", "lag"}


def test_nothing_missing_counts_physics_among_alternatives_too():
    answers = [answer("a", "nothing"), answer("b", "nothing", source="dart"), answer("c", "nothing")]
    reports = {"a": report(), "b": report((("force_gain", "friction_scale"), 0.4)), "c": report()}
    result = score_real(reports, answers, held_out=held("a", "b", "c", after=100.0))
    assert value(result, "false physics, nothing missing") == pytest.approx(1 / 3)
    assert value(result, "false physics, nothing missing", "dart") == 1.0
    assert value(result, "false physics, nothing missing", "calspan") == 0.0
    assert value(result, "held-out error above the model's own") == 0.0


def test_held_out_above_the_models_own_is_counted_whatever_little_it_is():
    answers = [answer("a", "nothing"), answer("b", "nothing")]
    errors = {**held("a", after=100.01), **held("b", after=100.0)}
    result = score_real({"a": report(), "b": report()}, answers, held_out=errors)
    assert value(result, "held-out error above the model's own") == 0.5
    assert [m["case"] for m in result["misses"]] == ["a"]


def parameters(folder) -> ProveConcealedParameters:
    return ProveConcealedParameters(seed=10_000, real=RealParameters(recordings=str(folder)))


def test_without_recordings_the_committed_table_is_shown_and_says_so(tmp_path, monkeypatch):
    asked = parameters(tmp_path / "nowhere")
    made = real_nodes.real_cases_to_make(asked)
    assert made == {}
    shown, held_out, sealed = real_nodes.part_real_cases(made)
    committed = score_real({"a": report()}, [answer("a", "nothing")], held_out=held("a"))
    table = pd.DataFrame(committed["scores"]).assign(method="explain_mismatch")
    known = {
        "seed": 4711,
        "cases": 1,
        "by_source": {"calspan": 1},
        "code": "abc",
        "date": "2026-11-23",
        "sha256": "0f",
        "sealed_sweeps": 3,
        "development_sweeps": 4,
    }
    monkeypatch.setattr(real_nodes, "published", lambda: (table, known))
    scores, misses, details = real_nodes.score_real_proof(shown, {}, held_out, sealed, asked)
    assert details["published"] is True
    page = _page(scores, misses, details)
    assert "are not available: this is the committed table" in page
    assert "4711" in page
    assert "1 case made from real recordings: " in page
    monkeypatch.setattr(real_nodes, "published", lambda: (table.head(0), {}))
    page = _page(*real_nodes.score_real_proof(shown, {}, held_out, sealed, asked))
    assert "no proof on them has been published yet" in page


def test_the_committed_table_is_read_as_it_was_written(tmp_path, monkeypatch):
    from tire_pipeline.concealed.real import published as module

    table = pd.DataFrame({"method": ["explain_mismatch"], "source": ["all"], "name": ["x"], "value": [0.5]})
    (tmp_path / module.TABLE).write_text(published_text(table, {"seed": 7}))
    monkeypatch.setattr(module.resources, "files", lambda _: tmp_path)
    scores, made = module.published()
    pd.testing.assert_frame_equal(scores, table)
    assert made == {"seed": 7}


def test_who_knows_the_answers_scores_one_and_who_says_nothing_zero():
    answers = [answer("a", "single", "wear"), answer("b", "nothing"), answer("c", "pair", "wear", "camber")]
    for method, (reports, errors) in real_nodes.oracle_and_floor(answers).items():
        result = score_real(reports, answers, held_out=errors)
        found = value(result, "right name first, twice the misfit")
        assert found == (1.0 if method == "oracle" else 0.0)
        assert value(result, "false physics, nothing missing") == 0.0
        assert value(result, "held-out error above the model's own") == 0.0


def test_a_miss_names_effects_as_the_page_of_a_recording_does():
    """By the titles of the catalogue, not by names of the code."""
    row = {"case": "case_1", "kind": "single", "true": "['friction_scale']", "over_noise": "[1.2]"}
    row |= {"verdict": "ambiguous", "named": "['plysteer_conicity']", "alternatives": "['force_offset']"}
    simulated = pd.DataFrame([{**row, "missing_channels": "['tread_temperature']"}])
    table = misses_table(simulated, "", "").frame
    assert table.to_dict("records") == [
        {
            "case": "1",
            "kind": "one effect, without tread temperature",
            "true effects": "another friction level (1.20)",
            "verdict": "ambiguous",
            "named": "conicity or ply steer (alternatives: offset of a force channel)",
        }
    ]
    every = [*catalogue(), *UNKNOWN_EFFECTS]
    shown = misses_table(
        pd.DataFrame([{"case": "c", "true": str(every), "sets": str([[every, 0.9]])}]), "", ""
    )
    text = " ".join(shown.frame.iloc[0])
    assert "_" not in text
    assert not re.search("friction scale|plysteer|low pass|stick slip|load rate|speed dependence", text)


def _page(scores, misses, details) -> str:
    own = pd.DataFrame(
        {"method": ["explain_mismatch"], "name": ["a"], "value": [1.0], "target": [None], "met": [None]}
    )
    simulated = {"sha256": "x", "explain_mismatch": {"n": 1, "by_strength": [], "by_effect": []}}
    json.dumps(details)
    return proof_page(own, pd.DataFrame(), simulated, scores, misses, details)
