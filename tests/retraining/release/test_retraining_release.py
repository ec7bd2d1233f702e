"""Released only if not worse, on tires that no model saw; and back again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from retraining_files import put_fleet

from tire_pipeline.classifiers.methods.random_forest import RandomForest
from tire_pipeline.errors import DomainError
from tire_pipeline.representations import make_representation
from tire_pipeline.retraining import (
    BALANCED,
    CategoryModel,
    Judged,
    Manifest,
    Release,
    Store,
    compare_models,
    difference,
    held_out_rows,
    ingest,
    judge,
    not_worse,
    roll_back,
    train_model,
)
from tire_pipeline.retraining.release.record import check_split
from tire_pipeline.tire_table import normalize_table

SPLIT = "share 0.2, seed 0"
FIGURES = {"candidate": 0.9, "released": 0.8}


@pytest.fixture(scope="module")
def tires(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fleet")
    put_fleet(folder, range(60))
    return ingest(Store(), folder, difference(folder, Manifest()))[0].table


def _train(tires, rows) -> CategoryModel:
    table = normalize_table(tires[rows].reset_index(drop=True), 6000.0)
    return train_model(
        table, make_representation("coefficients"), RandomForest(10, 6), nominal_load=6000.0, seed=1
    )


def _judged(digest="d", settings="s", sequence=1):
    return Judged(digest=digest, settings=settings, sequence=sequence, split=SPLIT)


def _release(*names):
    release = Release()
    for number, name in enumerate(names):
        release = judge(release, name, _judged(f"d{number}"), better=True, time="t", figures=FIGURES)
    return release


def test_a_tire_stays_on_its_side_when_others_arrive(tires):
    held = pd.Series(held_out_rows(tires, share=0.2, seed=0), index=tires["file"])
    part = tires.sample(frac=0.5, random_state=1)
    alone = pd.Series(held_out_rows(part, share=0.2, seed=0), index=part["file"])
    assert (held[alone.index] == alone).all()
    assert (held.groupby(tires.set_index("file")["tire_id"]).nunique() == 1).all()
    assert 0.05 < held.mean() < 0.4


def test_a_model_comes_back_from_its_state(tires):
    model = _train(tires, np.arange(len(tires)) % 2 == 0)
    again = CategoryModel.from_state(model.to_state())
    assert (again.predict(tires) == model.predict(tires)).all()
    assert again.categories == ["A", "B", "D"]


def test_tires_that_lack_a_feature_are_answered_with_nothing(tires):
    model = _train(tires, np.ones(len(tires), dtype=bool))
    broken = tires.head(4).assign(PCY1=[np.nan, 1.3, 1.3, 1.3])
    assert (model.predict(broken) == "").tolist() == [True, False, False, False]


def test_a_better_and_a_worse_candidate(tires):
    held = held_out_rows(tires, share=0.3, seed=0)
    good = _train(tires, ~held)
    spoiled = tires.assign(category=np.roll(tires["category"].to_numpy(), len(tires) // 3))
    bad = _train(spoiled, ~held)
    assert not_worse(compare_models(good, bad, tires[held]))
    assert not not_worse(compare_models(bad, good, tires[held]))
    assert not_worse(compare_models(bad, None, tires[held]))
    assert not_worse(compare_models(good, good, tires[held]))


def test_many_files_of_one_category_do_not_hide_a_loss_in_another(tires):
    held = held_out_rows(tires, share=0.3, seed=0)
    good = _train(tires, ~held)
    no_d = _train(tires, ~held & (tires["category"] != "D").to_numpy())
    flood = pd.concat([tires[held]] + [tires[held & (tires["category"] == "A").to_numpy()]] * 20)
    table = compare_models(no_d, good, flood)
    assert not not_worse(table)
    scores = table.set_index(["model", "category"])["accuracy"]
    assert scores["candidate", "D"] == 0.0
    assert scores["candidate", BALANCED] < scores["candidate", "all"]


def test_without_held_out_tires_nothing_is_compared(tires):
    model = _train(tires, np.ones(len(tires), dtype=bool))
    with pytest.raises(DomainError, match="no tire is held out"):
        compare_models(model, None, tires.head(0))


def test_a_worse_candidate_is_refused_and_recorded():
    release = _release("m1")
    after = judge(release, "m2", _judged("new"), better=False, time="t", figures=FIGURES)
    assert after.current == "m1"
    assert after.last_event["event"] == "refused"


def test_the_same_files_and_settings_are_not_judged_twice():
    release = _release("m1", "m2")
    assert judge(release, "m3", _judged("d1"), better=True, time="t", figures=FIGURES) is release
    back = roll_back(release, time="t")
    assert back.current == "m1"
    assert judge(back, "m3", _judged("d1"), better=True, time="t", figures=FIGURES).current == "m1"
    assert judge(back, "m3", _judged("d2"), better=True, time="t", figures=FIGURES).current == "m3"
    other = replace(_judged("d1"), settings="other")
    assert judge(back, "m3", other, better=True, time="t", figures=FIGURES).current == "m3"


def test_rolling_back_further_than_the_first_is_an_error():
    with pytest.raises(DomainError, match="no model was released yet"):
        roll_back(Release(), time="t")
    with pytest.raises(DomainError, match="m1 is the only one on record"):
        roll_back(_release("m1"), time="t")
    with pytest.raises(DomainError, match="m1 is the only one on record"):  # m2 was released, too
        roll_back(roll_back(_release("m1", "m2"), time="t"), time="t")


def test_models_with_other_held_out_tires_are_not_compared():
    check_split(_release("m1"), SPLIT)
    with pytest.raises(DomainError, match="had other tires held out"):
        check_split(_release("m1"), "share 0.3, seed 0")


def test_the_record_survives_json():
    release = roll_back(_release("m1", "m2", "m3"), time="t")
    assert Release.from_dict(release.to_dict()) == release
