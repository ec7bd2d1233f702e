"""The mixed model on a small fleet with a known truth."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from small_fleet import table_of

from tire_pipeline.errors import DomainError
from tire_pipeline.evaluation import evaluate_translations
from tire_pipeline.files.state_files import pack_state, unpack_state
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table import dedupe_and_filter, normalize_table
from tire_pipeline.translation.base import translator_from_state
from tire_pipeline.translation.bias_report import at_each_load, bias_report
from tire_pipeline.translation.curves.features import LOADS
from tire_pipeline.translation.decode.physics import SYMMETRY, violations
from tire_pipeline.translation.judge.bias_band import bias_band, measured_by_both
from tire_pipeline.translation.judge.gain import MOST_HARM, expected_gain, pooled_harm
from tire_pipeline.translation.judge.leave_one_out import leave_one_tire_out
from tire_pipeline.translation.result import (
    LEFT_ALONE,
    REFUSED,
    TRANSLATED,
    UNBIASED,
    UNKNOWN,
    comment_lines,
    write_translated,
)
from tire_pipeline.translation.translator import COEFFICIENTS, MixedModel

pytestmark = pytest.mark.slow
KEYS = (("lateral", 0), ("lateral", 1), ("longitudinal", 0), ("longitudinal", 1))
"""Stiffness and friction, as features of their group."""


@pytest.mark.parametrize("name", ["mixed", "paired"])
def test_translations_are_nearer_to_what_the_target_measured(name, request, hidden, truth):
    translator = request.getfixturevalue(name)
    summary = evaluate_translations(translator.translate(hidden), hidden, truth, lateral_only=True).summary
    assert summary.loc["forces", "ratio"] < 0.5
    assert summary.loc["mean", "improved"] > 0.75


def test_only_p_and_q_coefficients_change(paired, hidden):
    translated = paired.translate(hidden)
    same = [name for name in hidden.columns if name not in COEFFICIENTS]
    pd.testing.assert_frame_equal(translated[same], hidden[same])
    assert (translated[list(COEFFICIENTS)] != hidden[list(COEFFICIENTS)]).any(axis=None)


def test_the_same_after_a_round_trip(paired, hidden):
    first = paired.translate(hidden)
    back = translator_from_state(unpack_state(pack_state(paired.to_state()))).translate(hidden)
    pd.testing.assert_frame_equal(first, back, check_exact=True)


def test_a_file_is_translated_alike_alone_and_among_others(mixed, hidden):
    all_at_once = mixed.translate(hidden)
    one = mixed.translate(hidden.iloc[[7]])
    np.testing.assert_allclose(
        one[list(COEFFICIENTS)].to_numpy(float),
        all_at_once.iloc[[7]][list(COEFFICIENTS)].to_numpy(float),
        rtol=1e-6,
    )


@pytest.mark.long
def test_shuffling_the_truth_changes_no_translated_file(fleet, mixed, hidden):
    before = mixed.translate(hidden)
    keys = list(fleet.truth.first)
    values = [fleet.truth.first[key] for key in keys]
    rng = np.random.default_rng(0)
    shuffled = [values[i] for i in rng.permutation(len(values))]
    assert shuffled != values
    try:
        fleet.truth.first.update(zip(keys, shuffled, strict=True))
        own = {k: v for k, v in fleet.evaluation.items() if k.startswith("hidden")}
        again_hidden = normalize_table(table_of(own), 6000.0)
        kept, _ = dedupe_and_filter(table_of(fleet.files), features=LATERAL_WITHOUT_CAMBER)
        again = (
            MixedModel(pairs=False)
            .fit(normalize_table(kept, 6000.0), target="D", seed=0)
            .translate(again_hidden)
        )
    finally:
        fleet.truth.first.update(zip(keys, values, strict=True))
    assert before[list(COEFFICIENTS)].to_numpy().tobytes() == again[list(COEFFICIENTS)].to_numpy().tobytes()


def test_shuffling_the_truth_changes_nothing_that_a_translator_is_given(fleet, training, hidden):
    true = dict(fleet.truth.first)
    values = list(true.values())
    order = np.random.default_rng(0).permutation(len(values))
    try:
        fleet.truth.first.update(zip(true, (values[i] for i in order), strict=True))
        assert fleet.truth.first != true
        kept, _ = dedupe_and_filter(table_of(fleet.files), features=LATERAL_WITHOUT_CAMBER)
        pd.testing.assert_frame_equal(normalize_table(kept, 6000.0), training, check_exact=True)
        own = {k: v for k, v in fleet.evaluation.items() if k.startswith("hidden")}
        pd.testing.assert_frame_equal(normalize_table(table_of(own), 6000.0), hidden, check_exact=True)
    finally:
        fleet.truth.first.update(true)


def test_translated_tires_are_physical(paired, hidden):
    result = paired.translation(hidden)
    moved = (result.report["verdict"] == TRANSLATED).to_numpy()
    broken = violations(result.table[moved]) & ~violations(hidden[moved])
    assert not broken.any(axis=None)


def test_a_symmetric_source_stays_symmetric(paired, hidden):
    source = hidden.head(6).copy()
    for names in SYMMETRY.values():
        source[list(names)] = 0.0
    result = paired.translation(source, bands=False)
    for names in SYMMETRY.values():
        assert (result.table[list(names)] == 0.0).all(axis=None)


def test_verdicts(paired, hidden):
    rows = hidden.head(5).copy()
    rows["category"] = rows["category"].astype(object)
    rows.iloc[1, rows.columns.get_loc("category")] = "nobody"
    rows.iloc[2, rows.columns.get_loc("category")] = "D"
    rows.iloc[3, rows.columns.get_loc("PKY1")] *= 3.0
    rows.iloc[4, rows.columns.get_loc("PDY1")] = np.nan
    result = paired.translation(rows)
    unchanged = [1, 2, 3, 4]
    assert list(result.report["verdict"]) == [TRANSLATED, UNKNOWN, UNBIASED, REFUSED, REFUSED]
    assert "outside of what D has measured" in result.report["reason"].iloc[3]
    assert result.report["distance"].iloc[3] > 1.0
    figures = result.report[["expected_rms_ratio", "harm_probability"]]
    assert figures.iloc[0].between(0.0, 1.0).all()
    assert figures.iloc[unchanged].isna().all(axis=None), "no error figure where nothing is translated"
    assert result.bands["fy"].middle.shape[0] == 5
    pd.testing.assert_frame_equal(result.table.iloc[unchanged], rows.iloc[unchanged])


def test_a_category_whose_bias_may_be_chance_is_left_alone(paired, hidden):
    rows = hidden.head(10)
    first = str(rows["category"].iloc[0])
    uncertain = paired.with_verdict(harm=np.where(np.array(paired.model.categories) == first, 0.3, 0.0))
    result = uncertain.translation(rows, bands=False)
    own = (rows["category"].astype(str) == first).to_numpy()
    assert result.report.loc[own, "verdict"].isin([LEFT_ALONE, UNBIASED]).all()
    assert result.report.loc[own, "reason"].str.contains("distinguished from chance|contains zero").all()
    pd.testing.assert_frame_equal(result.table[own], rows[own])
    usual = paired.translation(rows, bands=False).report["verdict"]
    assert (usual[own] == TRANSLATED).any()


def test_nothing_beyond_the_asked_distance_is_translated(paired, hidden):
    rows = hidden.head(4).copy()
    rows.iloc[0, rows.columns.get_loc("PKY1")] *= 1.35
    usual = paired.translation(rows)
    distance = usual.report["distance"].to_numpy()
    assert 1.0 < distance[0] < 3.0
    assert (distance[1:] < 1.0).all()
    assert usual.report["verdict"].iloc[0] == TRANSLATED
    with pytest.raises(DomainError, match="beyond the edge of the training data"):
        write_translated(TireModel("5.2", {"FNOMIN": 6000.0}), usual, 0, COEFFICIENTS)
    _, comments = write_translated(TireModel("5.2", {"FNOMIN": 6000.0}), usual, 0, COEFFICIENTS, beyond=True)
    assert any("beyond its edge, 1; written because asked for" in line for line in comments)
    careful = translator_from_state(paired.with_verdict(farthest=1.0).to_state())
    held = careful.translation(rows)
    pd.testing.assert_frame_equal(held.report, paired.translation(rows, farthest=1.0).report)
    assert list(held.report["verdict"]) == [REFUSED, *usual.report["verdict"].iloc[1:]]
    assert f"distance {max(distance[0], 1.01):.2f}, the edge is 1" in held.report["reason"].iloc[0]
    pd.testing.assert_frame_equal(held.table.iloc[[0]], rows.iloc[[0]])


def test_a_distance_just_beyond_the_edge_does_not_read_as_the_edge(paired, hidden):
    rows, found = hidden.head(1), paired.predict(hidden.head(1))
    rules = paired.parts.verdict
    reach = replace(rules.reach, gap=1e9)  # the curves alone tell
    reach = replace(reach, surprise=reach.surprise * reach.distance(paired.model, rows, found)[0] / 1.003)
    near = replace(rules, reach=reach, gate=True, farthest=1.0)
    judged = near.judge(paired.model, rows, rows, found).iloc[0]
    assert judged["distance"] == pytest.approx(1.003)
    assert "distance 1.01, the edge is 1. Add training files of such tires" in judged["reason"]


@pytest.mark.parametrize(
    ("change", "verdict"), [({"PDY1": 2.6}, REFUSED), ({"PCX1": 2.5}, REFUSED), ({"PEY1": 1.3}, TRANSLATED)]
)
def test_a_tire_that_was_impossible_before_is_refused_but_for_its_curvature(paired, hidden, change, verdict):
    """A formula bounds the curvature factor itself."""
    rows = hidden.head(1)
    found = paired.predict(rows)
    moved = paired.parts.decoder.decode(paired.model, rows, found)
    judged = paired.parts.verdict.judge(
        paired.model, rows.assign(**change), moved.assign(**change), found
    ).iloc[0]
    assert judged["verdict"] == verdict
    assert ("no physical tire found: " in judged["reason"]) == (verdict == REFUSED)
    assert bool(np.isnan(judged["expected_rms_ratio"])) == (verdict == REFUSED)


def test_unbiased_is_only_whose_bands_hold_zero_and_little_else(paired, hidden):
    """The same verdict on the same files, with the bias taken out of the model, and with it in."""
    rows = hidden[hidden["category"].astype(str) != "D"]
    uncertain = paired.with_verdict(harm=np.full(len(paired.model.categories), 0.3))
    biased = uncertain.translation(rows, bands=False).report
    band = bias_band(uncertain.model, uncertain.predict(rows))
    assert ((biased["verdict"] == UNBIASED) == band.negligible).all()
    assert (biased["verdict"] == LEFT_ALONE).any()
    found = uncertain.predict(rows)
    moved = uncertain.parts.decoder.decode(uncertain.model, rows, found)
    same = replace(found, shift=np.zeros_like(found.shift))
    without = uncertain.parts.verdict.judge(uncertain.model, rows, moved, same)
    assert (without["verdict"] == UNBIASED).all()
    assert (
        without["reason"]
        .str.contains(
            "contains zero for such a tire in stiffness and friction, and no more than 5%", regex=False
        )
        .all()
    )
    wide = replace(same, shift_variance=100.0 * found.shift_variance)
    open_to_all = uncertain.parts.verdict.judge(uncertain.model, rows, moved, wide)
    assert (open_to_all["verdict"] == LEFT_ALONE).all()
    assert open_to_all["reason"].str.contains("I can't tell whether there is one", regex=False).all()
    assert without["bias_band"].str.count("%").eq(8).all()


def test_the_band_of_a_bias_lies_about_what_the_source_measures_more_than_the_target(paired, hidden):
    found = paired.predict(hidden)
    source, target = measured_by_both(paired.model, hidden, found)
    more = {name: source[name] - target[name] for name in ("lateral", "longitudinal")}  # logarithms
    columns = [more[group][:, part * LOADS.size :][:, : LOADS.size].mean(axis=1) for group, part in KEYS]
    band = bias_band(paired.model, found)
    middle = 0.5 * (np.log1p(band.low) + np.log1p(band.high))
    np.testing.assert_allclose(middle, np.column_stack(columns), atol=1e-9)
    assert (band.low < band.high).all()
    assert np.abs(middle).max() > 0.02


def test_the_expected_error_in_words_is_rms(paired, hidden):
    found = paired.predict(hidden)
    squared, _ = expected_gain(paired.model, found)
    report = paired.translation(hidden, bands=False).report
    np.testing.assert_allclose(report["expected_rms_ratio"].astype(float), np.sqrt(squared))
    moved = report[report["verdict"] == TRANSLATED]
    assert len(moved)
    for ratio, reason in zip(moved["expected_rms_ratio"], moved["reason"], strict=True):
        assert reason == f"expected RMS error {ratio:.0%} of the unchanged file's"


def test_a_file_that_lacks_something_is_told_what(paired, hidden):
    rows = hidden.head(2).copy()
    rows.iloc[0, rows.columns.get_loc("UNLOADED_RADIUS")] = np.nan
    rows["version"] = ["5.2", "6.1"]
    report = paired.translation(rows, bands=False).report
    assert (report["verdict"] == REFUSED).all()
    assert report["reason"].iloc[0] == "it does not state UNLOADED_RADIUS: add what is missing"
    assert "fit 5.2 to its forces first, as docs/tutorials/your_supplier_files.md" in report["reason"].iloc[1]


@pytest.mark.parametrize(
    ("own", "left_alone"),
    [
        ([0.17, 0.30, 0.30, 0.30, 0.30], [True] * 5),  # without any bias one looks sure by chance
        ([0.22, 0.22, 0.05, 0.08, 0.12], [False] * 5),  # a bias is there, and two categories have few tires
        ([0.00, 0.28, 0.28, 0.28, 0.28], [False, True, True, True, True]),  # one is biased
    ],
)
def test_all_categories_together_tell_a_bias_from_chance(own, left_alone):
    names = ("A", "B", "C", "D", "E", "F")
    category = np.repeat(names, 2)
    sure = np.insert(own, 3, 0.5)  # the target's own files are not moved
    harm = np.stack([sure - 0.02, sure + 0.02], axis=1).ravel()
    pooled = pooled_harm(harm, category, names, "D")
    assert pooled[3] == 0.0
    assert list(np.delete(pooled, 3) > MOST_HARM) == left_alone


def test_bands_hold_the_translated_curve(paired, hidden):
    result = paired.translation(hidden)
    for band in result.bands.values():
        assert band.middle.shape == (len(hidden), band.normal_load.size, band.slip.size)
        known = np.isfinite(band.low)
        assert (band.low[known] < band.middle[known]).all()
        assert (band.middle[known] < band.high[known]).all()


def test_what_moved_is_said_in_words_and_comments(paired, hidden, fleet):
    result = paired.translation(hidden, bands=False)
    assert "cornering stiffness" in " ".join(result.report["changes"])
    model = read_tir(fleet.evaluation[hidden["file"].iloc[0]].encode("latin-1"))
    written, comments = write_translated(model.nominal_load_changed(6000.0), result, 0, COEFFICIENTS)
    assert written.coefficients["PDY1"] == result.table["PDY1"].iloc[0]
    text = "\n".join(comments)
    for word in (
        "-> D",
        "method: mixed_model with pairs",
        "hash: ",
        "verdict: translated",
        hidden["file"].iloc[0],
    ):
        assert word in text
    assert hidden["file"].iloc[1] in "\n".join(comment_lines(result, 1, COEFFICIENTS))


def test_what_is_a_tires_own_does_not_depend_on_how_its_category_spreads_it(paired, hidden):
    exact = tuple(replace(f, variances={**f.variances, "noise": 1e-9}) for f in paired.model.fitted)
    model = replace(
        paired.model,
        fitted=exact,
        spread=np.full_like(paired.model.spread, 1.5),
        alone=np.full_like(paired.model.alone, 1e-9),
    )
    rows, own = hidden.head(6), np.linspace(-1.0, 1.0, 6 * model.kinds.scores.size).reshape(6, -1)
    category = rows["category"].to_numpy(dtype=str)
    place = np.array([model.categories.index(name) for name in category])
    here = model.regressors(model.blocks(rows, category, model.protocols.code(rows)))
    source = np.zeros((6, model.scale.size))
    for i, k in enumerate(model.kinds.scores):
        expected = here[0] @ model.fitted[k].mean[: here[0].shape[1]]
        source[:, k] = (expected + 1.5 * own[:, i]) * model.scale[k]
    np.testing.assert_allclose(model.own_scores(source, place, here)[0], own, rtol=1e-6)


def test_categories_spread_stiffness_alike_and_shapes_each_in_its_own_way(paired):
    slices = paired.model.space.slices
    apart = {name: np.log(paired.model.spread[:, place]).std(axis=0).max() for name, place in slices.items()}
    assert max(apart["cornering stiffness"], apart["slip stiffness"]) < 0.02
    assert min(apart["lateral shape"], apart["longitudinal shape"]) > 0.05


def test_bias_report_has_intervals_for_every_pair(paired, training):
    report = bias_report(paired, training, coefficients=False)
    assert set(zip(report.by_region["organisation"], report.by_region["reference"], strict=True)) >= {
        ("D", "A"),
        ("E", "D"),
    }
    for table in (report.by_region, report.by_metadata):
        assert (table["low"] <= table["bias"]).all()
        assert (table["bias"] <= table["high"]).all()
    stiffness = at_each_load(report, "cornering stiffness")
    assert set(stiffness["normal_load"]) == {2000.0, 4000.0, 6000.0, 8000.0}


def test_bias_of_the_mean_tire_is_less_certain_where_fewer_tires_tell_it(paired, training):
    few = training.drop_duplicates("tire_id").groupby("category").head(1)
    wide, usual = (bias_report(paired, rows, coefficients=False).by_region for rows in (few, training))
    np.testing.assert_array_equal(wide["bias"], usual["bias"])
    assert ((wide["high"] - wide["low"]) > (usual["high"] - usual["low"])).all()


def test_leaving_one_tire_out(training, paired):
    left = leave_one_tire_out(training, "D", pairs=True, model=paired.model)
    assert left["tire_id"].nunique() >= 4
    assert left["error"].sum() < left["error_unchanged"].sum()
