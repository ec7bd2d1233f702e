"""Translators that learn from the files they translate: what teaches, what must not, and that it helps."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.fleet import FleetSettings, make_fleet
from tire_pipeline.reporting.translation.translated_folder_page import translate_page
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table import dedupe_and_filter, from_models, normalize_table
from tire_pipeline.translation.base import translator_from_state
from tire_pipeline.translation.judge.leave_one_out import leave_one_tire_out
from tire_pipeline.translation.parameters import TranslateParameters
from tire_pipeline.translation.population.fit_model import prepare
from tire_pipeline.translation.population.mixed_effects import posterior_weights
from tire_pipeline.translation.population.update import TaughtCells, learn_from, updated_weights
from tire_pipeline.translation.result import comment_lines
from tire_pipeline.translation.translator import COEFFICIENTS, MixedModel

pytestmark = pytest.mark.slow


def _table(files):
    models = ((path, path.split("/")[-2], read_tir(text.encode("latin-1"))) for path, text in files.items())
    return normalize_table(from_models(models), 6000.0)


@pytest.fixture(scope="module")
def large_fleet():
    """Tires enough to tell whether a batch makes translations better."""
    return make_fleet(FleetSettings(seed=78, files=450, tuning_tires=1, hidden_tires=40))


@pytest.fixture(scope="module")
def large_training(large_fleet):
    table = _table(large_fleet.files)
    return dedupe_and_filter(table, features=LATERAL_WITHOUT_CAMBER)[0].reset_index(drop=True)


@pytest.fixture(scope="module")
def large_batch(large_fleet):
    return _table({k: v for k, v in large_fleet.evaluation.items() if k.startswith("hidden")})


@pytest.fixture(scope="module")
def large_truth(large_fleet, large_batch):
    table = _table({k: v for k, v in large_fleet.truth.first.items() if k.startswith("hidden/D")})
    names = large_batch["file"].str.split("/").str[-1]
    return table.set_index(table["file"].str.split("/").str[-1]).loc[names].reset_index(drop=True)


@pytest.fixture(scope="module")
def batch(hidden):
    return hidden


@pytest.fixture(scope="module")
def few(batch):
    """All files of three tires: each is taught by the two others."""
    return batch[batch["tire_id"].isin(batch["tire_id"].unique()[:3])].reset_index(drop=True)


@pytest.fixture(scope="module")
def learning(training, made_of_pairs):
    """The paired one, but it learns from a batch."""
    return MixedModel(pairs=True, learn_from_batch=True).fit(training, target="D", seed=0, made=made_of_pairs)


@pytest.fixture(scope="module")
def prepared_alone(training):
    """A small training table, and what a translator without pairs begins with."""
    table = training.groupby("category", observed=True).head(25).reset_index(drop=True)
    return table, prepare(table, pairs=False)


@pytest.fixture(scope="module")
def alone(prepared_alone):
    """Learns from a batch, but not from pairs."""
    table, made = prepared_alone
    return MixedModel(pairs=False, learn_from_batch=True).fit(table, target="D", made=made)


@pytest.fixture(scope="module")
def found(learning, few):
    return learning.predict(few)


@pytest.fixture(scope="module")
def translated(learning, few):
    return learning.translation(few, bands=False)


def _error(translator, scores, truth):
    """Squared error of the scores of lateral and longitudinal force, in their standard deviations."""
    model = translator.model
    measured, _ = model.space.encode(truth)
    kept = np.ones(model.scale.size, dtype=bool)
    kept[model.space.slices["aligning torque"]] = False
    return (((scores - measured) / model.scale)[:, kept] ** 2).mean()


def _errors(training, batch, truth, pairs):
    """Errors without a batch and with it; the model below is the same."""
    taught = MixedModel(pairs=pairs, learn_from_batch=True).fit(training, target="D")
    plain = replace(taught.parts, batch=None)
    return (_error(taught, one.predict(batch).target, truth) for one in (plain, taught))


def test_what_the_batch_teaches_makes_translations_better(large_training, large_batch, large_truth):
    by_file, by_batch = _errors(large_training, large_batch, large_truth, pairs=True)
    assert by_batch < 0.97 * by_file


@pytest.mark.long
def test_what_the_batch_teaches_makes_translations_without_pairs_better(
    large_training, large_batch, large_truth
):
    by_file, by_batch = _errors(large_training, large_batch, large_truth, pairs=False)
    assert by_batch < 0.97 * by_file


def test_a_file_alone_is_translated_as_without_a_batch(learning, paired, batch):
    rows = batch.iloc[[3]]
    pd.testing.assert_frame_equal(learning.translate(rows), paired.translate(rows), check_exact=True)


def test_no_file_of_its_own_tire_has_a_say_and_others_have(learning, few, found):
    own = (few["tire_id"] == few["tire_id"].iloc[0]).to_numpy()
    changed = few.copy()
    changed.loc[own & (np.arange(len(few)) != 0), "PKY1"] *= 1.1
    again = learning.predict(changed)
    np.testing.assert_array_equal(again.target[0], found.target[0])
    assert np.abs(again.target - found.target)[~own].max() > 0.0


def _with_what_the_target_measured(translator, rows, truth):
    """Coefficients of translated files beside which lie the target's measurements of the same tires."""
    result = translator.translation(
        pd.concat([rows, truth.drop_duplicates("file")], ignore_index=True), bands=False
    )
    return result.table.iloc[: len(rows)][list(COEFFICIENTS)].to_numpy()


def test_what_the_target_measured_of_the_batch_never_teaches(learning, batch, few, translated, truth):
    """Not even if it lies among the files: what is left is bit for bit what it was without it."""
    own = truth[batch["tire_id"].isin(few["tire_id"]).to_numpy()]
    without = translated.table[list(COEFFICIENTS)].to_numpy()
    assert _with_what_the_target_measured(learning, few, own).tobytes() == without.tobytes()


@pytest.mark.long
def test_what_the_target_measured_of_a_large_batch_never_teaches(large_training, large_batch, large_truth):
    learning = MixedModel(pairs=True, learn_from_batch=True).fit(large_training, target="D")
    without = learning.translation(large_batch, bands=False).table[list(COEFFICIENTS)].to_numpy()
    found = _with_what_the_target_measured(learning, large_batch, large_truth)
    assert found.tobytes() == without.tobytes()


def test_who_teaches(learning, training, batch, few):
    rows = few.copy()
    rows["category_probability"] = 1.0
    rows.loc[0, "category_probability"] = 0.9
    rows.loc[1, "tire_id"] = training["tire_id"].iloc[0]
    rows.loc[2, ["PKY1", "PDY1"]] *= 4.0
    alone = batch.iloc[[-1]].assign(tire_id="another tire", category_probability=1.0)
    for i in range(3):  # beside it lies one file only, which may not teach
        beside = pd.concat([rows.iloc[[i]], alone], ignore_index=True)
        assert learning.predict(beside).taught[-1] == 0
    teaches = np.arange(len(rows)) > 2
    others = [(teaches & (rows["tire_id"] != tire)).sum() for tire in rows["tire_id"]]
    np.testing.assert_array_equal(learning.predict(rows).taught, others)


def test_files_of_one_tire_in_one_category_are_one_cell(alone, learning, batch):
    rows = pd.concat([batch.head(8), batch.head(3)], ignore_index=True)
    cells = TaughtCells.of_files(learning.model, rows)
    once = TaughtCells.of_files(learning.model, batch.head(8))
    np.testing.assert_array_equal(cells.files, [2, 2, 2, 1, 1, 1, 1, 1])
    np.testing.assert_allclose(cells.scores, once.scores)
    linked = TaughtCells.of_files(learning.model, batch)
    assert linked.shared().sum(axis=0).max() == 5  # of five categories
    assert TaughtCells.of_files(alone.model, batch).shared().size == 0  # pairs may not be used


def test_learning_is_what_a_fit_to_all_cells_gives(alone, prepared_alone, batch):
    """With spreads of 1 and errors alike, conjugate updating is exact: a fit of both gives the same."""
    (_, made), model, k = prepared_alone, alone.model, 0
    one = model.fitted[k]
    variances = {**one.variances, "tire_category": 0.3}
    start = posterior_weights(made.design, alone.parts.batch.training.scores[:, k], variances)
    alike = replace(
        model,
        fitted=(start,) * model.scale.size,
        spread=np.ones_like(model.spread),
        alone=np.full_like(model.alone, 0.3),
    )
    cells = TaughtCells.of_files(model, batch.head(20))
    cells = replace(cells, scores=np.tile(cells.design @ start.mean[:, None] + 0.1, model.scale.size))
    learnt = updated_weights(alike, cells)[k]
    design = made.design
    ends = np.cumsum([block.shape[1] for block in design.blocks.values()])[:-1]
    more = dict(zip(design.blocks, np.split(cells.design, ends, axis=1), strict=True))
    both = replace(
        design,
        blocks={name: np.concatenate([block, more[name]]) for name, block in design.blocks.items()},
        tire=np.zeros((len(design.files) + len(cells), 0)),
        files=np.concatenate([design.files, cells.files]),
    )
    scores = np.concatenate([alone.parts.batch.training.scores[:, k], cells.scores[:, k]])
    at_once = posterior_weights(both, scores, variances)
    np.testing.assert_allclose(learnt.mean, at_once.mean, atol=1e-7)
    np.testing.assert_allclose(learnt.covariance, at_once.covariance, atol=1e-7)


def test_nothing_is_learnt_from_nothing(learning, batch):
    none = TaughtCells.of_files(learning.model, batch.head(2)).part(np.arange(0))
    assert (
        learn_from(learning.model, none, learning.parts.batch.training, learning.parts.batch.repeats)
        is learning.model
    )


def test_the_same_after_a_round_trip_and_the_file_says_what_taught(learning, few, translated):
    back = translator_from_state(learning.to_state()).translation(few, bands=False)
    pd.testing.assert_frame_equal(translated.table, back.table, check_exact=True)
    taught = translated.report["taught"].iloc[0]
    assert 0 < taught < len(few)
    assert f"learned also from {taught} files of other tires in the same batch" in comment_lines(
        translated, 0, COEFFICIENTS
    )


@pytest.fixture(scope="module")
def left_out(training, made_of_pairs, learning, batch):
    """Leaves one training tire out after the other, beside a batch or alone."""
    options = {"pairs": True, "model": learning.model, "made": made_of_pairs}
    return lambda beside: leave_one_tire_out(training, "D", batch=beside, **options)


def test_leaving_one_tire_out_tells_whether_to_let_a_batch_teach(left_out, batch):
    without, with_it = left_out(None), left_out(batch)
    keys = ["tire_id", "source", "error_unchanged"]
    pd.testing.assert_frame_equal(with_it[keys], without[keys])
    assert (with_it["error"] != without["error"]).all()


@pytest.mark.long
def test_no_file_of_the_training_tires_or_the_target_teaches_who_leaves_one_out(left_out, training, batch):
    more = pd.concat([batch, training.head(20), batch.head(3).assign(category="D")], ignore_index=True)
    pd.testing.assert_frame_equal(left_out(more), left_out(batch))


REFUSED_FILE = {"file": "E/a.tir", "source": "E", "verdict": "refused", "reason": "it cannot be read"}


def test_the_page_says_that_the_files_taught():
    parameters = TranslateParameters(learn_from_batch=True)
    for taught, said in ((40, True), (0, False)):  # a file alone learns from no other
        report = [pd.DataFrame([{**REFUSED_FILE, "taught": taught}])]
        page, _ = translate_page(report, {}, pd.DataFrame(), [], parameters, "D")
        assert ("Among other files the result would differ a little" in str(page)) is said


def test_a_translator_that_cannot_learn_from_the_batch_says_so():
    with pytest.raises(ValueError, match="likelihood_agent cannot learn from the files to translate"):
        TranslateParameters(translator="likelihood_agent", learn_from_batch=True)
