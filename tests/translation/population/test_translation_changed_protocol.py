"""A change of protocol in a small fleet: found, told and put right."""

import re

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.translation.base import translator_from_state
from tire_pipeline.translation.curves.features import LOADS
from tire_pipeline.translation.judge.effects import KEY_PARTS
from tire_pipeline.translation.population.fit_model import prepare
from tire_pipeline.translation.result import (
    comment_lines,
)
from tire_pipeline.translation.translator import COEFFICIENTS, MixedModel

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def changed(training):
    """Training files of which E's of the second half show 8% more friction."""
    late = (training["category"] == "E") & (training["date"] >= "2016-07-01")
    scale = np.where(late, 1.08, 1.0)
    return training.assign(**{name: training[name] * scale for name in ("PDY1", "PDX1")})


@pytest.fixture(scope="module")
def changing(changed):
    return MixedModel(pairs=False).fit(changed, target="D", seed=0)


def test_no_change_of_protocol_where_there_is_none(mixed, paired, hidden):
    assert mixed.model.protocols.changes == paired.model.protocols.changes == ()
    assert mixed.translation(hidden.head(2), bands=False).protocols.empty


def test_a_change_of_protocol_is_found_told_and_put_right(changing, hidden):
    (change,) = changing.model.protocols.changes
    assert change.category == "E"
    assert "2015-07" < change.day < "2017-07"
    own = hidden[hidden["category"] == "E"].head(1)
    both = pd.concat([own.assign(date=day) for day in ("2012-01-01", "2020-01-01", "")], ignore_index=True)
    both.loc[1, ["PDY1", "PDX1"]] *= 1.08
    result = changing.translation(both, bands=False)
    friction = result.table["PDY1"].to_numpy()
    assert friction[1] == pytest.approx(friction[0], rel=0.015)  # one tire, by both protocols
    assert result.report["protocol"].str.len().gt(0).all()
    assert any("protocol" in line for line in comment_lines(result, 1, COEFFICIENTS))
    found = changing.model.predict(both, "D")
    place = changing.model.space.slices["lateral friction"]
    assert found.variance[2, place].sum() > found.variance[0, place].sum()  # no date: either protocol
    told = result.protocols.iloc[0]
    assert told["category"] == "E"
    assert 5.0 < float(told["lateral friction"].split("%")[0]) < 11.0
    for part in KEY_PARTS:
        middle, low, high = map(float, re.findall(r"[+-][\d.]+", told[part]))
        assert low < middle < high, part
    assert told["earliest"] <= told["day"] <= told["latest"]
    again = translator_from_state(changing.to_state())
    pd.testing.assert_frame_equal(again.translate(both), result.table)


def test_the_target_is_given_by_its_newest_protocol(changing, mixed, hidden):
    source = hidden[hidden["category"] == "A"].head(4)
    levels = []
    for translator in (changing, mixed):
        found = translator.model.predict(source, "E")
        features = translator.model.space.features(found.target, translator.model.space.encode(source)[1])
        levels.append(features["lateral"][:, LOADS.size : 2 * LOADS.size].mean())
    assert 0.04 < levels[0] - levels[1] < 0.11


def test_tables_without_dates_are_translated_as_before_there_were_any(training, space, mixed, hidden):
    undated = training.drop(columns="date")
    made = prepare(undated, pairs=False, space_and_cells=space)
    again = MixedModel(pairs=False).fit(undated, target="D", seed=0, made=made)
    told = mixed.translate(hidden.head(3))
    pd.testing.assert_frame_equal(
        again.translate(hidden.head(3).drop(columns="date")), told.drop(columns="date")
    )
