"""A category that changes how it measures: found by the dates of its files, and only there."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.reporting.translation.translated_folder_page import translate_page
from tire_pipeline.translation.parameters import TranslateParameters
from tire_pipeline.translation.population.protocols.of_files import Change, Protocols, days_of
from tire_pipeline.translation.population.protocols.search import Dated, find_changes

pytestmark = pytest.mark.slow

PARTS = {"friction": slice(0, 2), "shape": slice(2, 5)}
FIRST = np.datetime64("2011-01-01")
CHANGE = np.datetime64("2015-06-01")
TIRES = {"A": 40, "D": 120, "E": 100}


def _dated(rng, *, step=0.0, trend=0.0, undated=(), who="E"):
    """Gaps of deviation 1; ``who`` measures ``step`` more from CHANGE on; all grow by ``trend``."""
    category = np.repeat(list(TIRES), list(TIRES.values()))
    day = FIRST + rng.integers(0, 3650, category.size)
    gap = rng.normal(size=(category.size, 5))
    gap[:, 0] += step * ((category == who) & (day >= CHANGE))
    gap += trend * (day - FIRST).astype(float)[:, None] / 3650
    day[np.isin(category, undated)] = np.datetime64("NaT")
    return Dated(gap, category, day, np.arange(category.size))


@pytest.mark.parametrize("who", ["E", "D"])
def test_a_change_is_found_and_its_day(rng, who):
    (change,) = find_changes(_dated(rng, step=2.5, who=who), PARTS)
    assert change.category == who
    assert abs(np.datetime64(change.day) - CHANGE) < np.timedelta64(180, "D")
    assert change.earliest <= change.day <= change.latest
    assert change.probability > 0.999
    assert change.before + change.after == TIRES[who]


@pytest.mark.parametrize(
    "seed", [*range(4), *(pytest.param(n, marks=pytest.mark.long) for n in range(4, 15))]
)
def test_none_is_found_where_there_is_none(seed):
    assert find_changes(_dated(np.random.default_rng(seed)), PARTS) == ()


def _few(seed):
    """A dozen tires in each of six categories, with many scores that hang together, and nothing else."""
    rng = np.random.default_rng(seed)
    category = np.repeat(list("ABCDEF"), (11, 11, 11, 18, 17, 11))
    day = FIRST + rng.integers(0, 3650, category.size)
    gap = rng.normal(size=(category.size, 22)) @ (np.eye(22) + 0.3 * rng.normal(size=(22, 22)))
    return Dated(gap, category, day, np.arange(category.size))


@pytest.mark.parametrize("count", [6, pytest.param(40, marks=pytest.mark.long)])
def test_few_tires_are_no_change_either(count):
    """The odds alone take spreads of a dozen tires for known; by shuffles six categories have one in 3%."""
    parts = {"a": slice(0, 6), "b": slice(6, 12), "c": slice(12, 17), "d": slice(17, 22)}
    fleets = [_few(seed) for seed in range(count)]
    assert sum(len(find_changes(fleet, parts)) > 0 for fleet in fleets) < count / 8
    by_odds_alone = [find_changes(fleet, parts, most_by_chance=1.0) for fleet in fleets]
    assert sum(len(found) > 0 for found in by_odds_alone) >= count / 8


@pytest.mark.parametrize("seed", [0, *(pytest.param(n, marks=pytest.mark.long) for n in range(1, 5))])
def test_tires_that_all_categories_see_change_over_the_years_are_no_change_of_protocol(seed):
    assert find_changes(_dated(np.random.default_rng(seed), trend=2.0), PARTS) == ()
    own = _dated(np.random.default_rng(seed), trend=2.0, undated=("A", "D"))
    assert find_changes(own, PARTS) == ()  # nobody to compare with


def test_a_change_beside_a_trend_is_found(rng):
    (change,) = find_changes(_dated(rng, step=2.5, trend=1.0), PARTS)
    assert change.category == "E"


def test_without_dates_nothing_is_found(rng):
    assert find_changes(_dated(rng, step=3.0, undated=("E",)), PARTS) == ()
    assert find_changes(_dated(rng, step=3.0, undated=tuple(TIRES)), PARTS) == ()


def test_a_few_odd_tires_are_no_change(rng):
    found = _dated(rng)
    late = np.flatnonzero((found.category == "E") & (found.day >= CHANGE))[:3]
    found.gap[late] += 30.0
    assert find_changes(found, PARTS) == ()


@pytest.fixture
def protocols():
    return Protocols((Change("E", "2015-06-01", "2015-05-01", "2015-07-01", 0.999, 60, 40),))


def test_code_of_files(protocols):
    table = pd.DataFrame(
        {
            "category": ["E", "E", "E", "A", "E"],
            "date": ["2015-05-31", "2015-06-01", "", "2016-01-01", "soon"],
        }
    )
    np.testing.assert_allclose(protocols.code(table)[:, 0], [-0.4, 0.6, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(protocols.unsure(table)[:, 0], [0.0, 0.0, 0.24, 0.0, 0.24])
    np.testing.assert_allclose(protocols.newest("E", 2), [[0.6], [0.6]])
    np.testing.assert_allclose(protocols.newest("A", 1), [[0.0]])
    said = protocols.in_words(table)
    assert said[0] == "before 2015-06-01"
    assert said[1] == "from 2015-06-01 on"
    assert "no date" in said[2]
    assert said[4] == said[2]
    assert said[3] == ""


def test_tables_without_dates(protocols):
    table = pd.DataFrame({"category": ["E", "A"]})
    assert np.isnat(days_of(table)).all()
    assert (protocols.code(table) == 0.0).all()
    assert Protocols().code(table).shape == Protocols().unsure(table).shape == (2, 0)


def test_state(protocols):
    assert Protocols.from_state(protocols.to_state()) == protocols
    assert Protocols.from_state({}) == Protocols()


def test_the_page_tells_of_a_change_and_only_then():
    row = {"file": "E/a.tir", "source": "E", "verdict": "refused", "reason": "it cannot be read"}
    report = [pd.DataFrame([{**row, "protocol": "before 2015-06-01"}])]
    changed = pd.DataFrame({"category": ["E"], "day": ["2015-06-01"], "probability": [0.999]})
    given = ([], TranslateParameters(), "D")
    page = str(translate_page(report, {}, changed, *given)[0])
    assert "Changes of protocol" in page
    assert "2015-06-01" in page
    assert "Changes of protocol" not in str(translate_page(report, {}, changed.head(0), *given)[0])
