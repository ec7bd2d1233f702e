"""The page of translators says what the measured table says, be it good or bad."""

from itertools import product

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.reporting.translation.translated_rows import (
    ROW_COLUMNS,
    SHOWN_VERDICTS,
    by_supplier,
    in_order,
    listed,
    median_expected,
)
from tire_pipeline.reporting.translation.translation_page import MORE, RATIOS, check_goals, translation_page

pytestmark = pytest.mark.slow

SHARES = ["coverage_fy", "coverage_fx", "coverage_mz", "left_alone", "harmful"]
SHARES += ["refusal_precision", "refusal_recall"]
LEVELS = {"no_change": 1.0, "mixed_model": 0.2, "paired_mixed_model": 0.12, "oracle": 0.1, "floor": 0.1}


def measured(seeds: tuple[int, ...] = (1, 2, 3), **levels: float) -> pd.DataFrame:
    """Every kind at two sizes; each translator's ratios are one number."""
    rows = []
    for kind, size, seed in product(("additive", "interacting", "drifting"), (1.0, 0.0), seeds):
        for name, level in {**LEVELS, **levels}.items():
            row = {"set": "hidden", "kind": kind, "bias_size": size, "seed": seed, "translator": name}
            row |= {column: level for column in (*RATIOS, *MORE)} | dict.fromkeys(SHARES, 0.5)
            rows.append({**row, "improved": 0.95})
    other = {**rows[0], "set": "four", "ratio_forces": 99.0}
    return pd.DataFrame([*rows, other])


def goals(table: pd.DataFrame) -> pd.DataFrame:
    return check_goals(table[table["set"] == "hidden"]).set_index(["translator", "fleet", "goal"])["met"]


def test_goals_are_met_exactly_at_their_bounds():
    met = goals(measured(paired_mixed_model=0.15, mixed_model=0.30))
    assert met["paired_mixed_model", "additive", "at most 1.5 x floor"] == "yes"
    assert met["mixed_model", "drifting", "at most 3 x floor"] == "yes"
    missed = goals(measured(paired_mixed_model=0.16, mixed_model=0.31))
    assert missed["paired_mixed_model", "additive", "at most 1.5 x floor"] == "no"
    assert missed["mixed_model", "drifting", "at most 3 x floor"] == "no"


def test_one_fleet_is_too_few_for_a_goal():
    assert set(goals(measured(seeds=(1,))).drop("all kinds and sizes", level="fleet")) == {"too few fleets"}


def test_the_oracle_stands_beside_each_goal():
    table = measured(oracle=0.25)
    found = check_goals(table[table["set"] == "hidden"]).set_index(["translator", "fleet", "goal"])["oracle"]
    assert found["paired_mixed_model", "additive", "at most 1.5 x floor"] == "2.50 / 2.50 / 2.50"


@pytest.mark.parametrize(
    ("level", "word", "met"),
    [(1.0, "No mixed model does harm", "yes"), (1.01, "A mixed model does harm", "no")],
)
def test_harm_is_said(level, word, met):
    table = measured(mixed_model=level)
    page = translation_page(table)
    assert word in page
    assert f"{level:.2f}" in page
    assert "99" not in page.split("<svg")[0]  # only hidden tires count
    assert goals(table)["mixed_model", "all kinds and sizes", "no ratio above 1"] == met


def test_a_translator_that_was_not_measured_has_no_goal():
    assert "likelihood_agent" not in goals(measured()).index.get_level_values(0)
    assert "likelihood_agent" in goals(measured(likelihood_agent=0.2)).index.get_level_values(0)
    assert "paired_batch_mixed_model" not in goals(measured()).index.get_level_values(0)
    met = goals(measured(paired_batch_mixed_model=0.15))
    assert met["paired_batch_mixed_model", "drifting", "at most 1.5 x floor"] == "yes"
    assert met["paired_batch_mixed_model", "all kinds and sizes", "no ratio above 1"] == "yes"


def test_bias_and_truth_are_shown_with_intervals():
    bias = pd.DataFrame(
        {
            "organisation": ["B", "C", "C"],
            "reference": "A",
            "output": "lateral",
            "region": ["friction level, 4000 N", "cornering stiffness, 4000 N", "ply steer"],
            "bias": [-0.05, 0.2, 0.9],
            "low": [-0.06, 0.1, 0.8],
            "high": [-0.04, 0.3, 1.0],
        }
    )
    truth = bias.head(2).assign(true_bias=[-0.055, 0.4], inside=[True, False])
    page = translation_page(measured(), bias=bias, beside_truth=truth, note="measured on one day")
    assert "50% of 2 lie inside" in page
    assert page.index("+20.0%") < page.index("-5.0%")  # largest first
    assert "+90.0%" not in page  # other regions are not listed
    assert "measured on one day" in page


def test_a_file_just_beyond_the_edge_is_not_shown_on_it():
    report = pd.DataFrame(
        {"file": ["a", "b"], "distance": [1.0004, 0.9], "verdict": ["refused", "translated"]}
    )
    rows = in_order(listed([report], set()))
    assert [row[ROW_COLUMNS.index("distance")] for row in rows] == [1.01, 0.9]


def test_own_files_come_first_and_those_that_need_no_translation_last():
    verdicts = {
        "lab/a.tir": "already unbiased",
        "x/b.tir": "translated",
        "x/a.tir": "refused",
        "A/1.tir": "translated",
    }
    report = pd.DataFrame({"file": list(verdicts), "verdict": list(verdicts.values())})
    rows = listed([report.head(3), report.tail(1)], {"A/1.tir"})
    assert [row[0] for row in in_order(rows)] == ["x/a.tir", "x/b.tir", "lab/a.tir", "A/1.tir"]


def test_what_is_unusual_in_a_file_is_counted():
    notes = {"a.tir": "", "b.tir": "PKY1 has two values", "c.tir": "one | two | three"}
    report = pd.DataFrame({"file": list(notes), "verdict": "translated", "notes": list(notes.values())})
    rows = in_order(listed([report], set()))
    assert [row[ROW_COLUMNS.index("noted")] for row in rows] == [0, 1, 3]


def test_an_unknown_supplier_is_called_by_its_folder():
    report = pd.DataFrame(
        {
            "file": ["lab/1.tir", "2.tir", "C/3.tir", "lab/4.tir"],
            "source": ["unknown", "unknown", "C", "unknown"],
            "verdict": ["unknown supplier", "unknown supplier", "refused", "refused"],
        }
    )
    suppliers = {row[0]: row[ROW_COLUMNS.index("supplier")] for row in in_order(listed([report], set()))}
    assert suppliers == {"lab/1.tir": "lab", "2.tir": "unknown", "C/3.tir": "C", "lab/4.tir": "lab"}


@pytest.mark.parametrize("count", [1, 2, 31, 200])
def test_each_supplier_has_its_counts_and_its_median(count):
    rng = np.random.default_rng(count)
    verdict = rng.choice(SHOWN_VERDICTS[:-1], count)
    ratio = np.where(rng.random(count) < 0.2, np.nan, rng.random(count))
    report = pd.DataFrame({"file": [f"{i}.tir" for i in range(count)], "source": rng.choice([*"AB"], count)})
    report = report.assign(verdict=verdict, expected_rms_ratio=ratio)
    rows = listed([report[:20], report[20:]], set())
    acted = report[report["verdict"] == "translated"]
    expected = acted["expected_rms_ratio"].median()
    assert (median_expected(rows) is None) if np.isnan(expected) else (median_expected(rows) == expected)
    found = {one["name"]: one for one in by_supplier(rows)}
    assert sorted(found) == list(found) == sorted(set(report["source"]))
    for name, part in report.groupby("source"):
        counts = [(part["verdict"] == each).sum() for each in SHOWN_VERDICTS]
        assert (found[name]["files"], found[name]["counts"]) == (len(part), counts)
        shown = acted.loc[acted["source"] == name, "expected_rms_ratio"].dropna().map("{:.3g}".format)
        assert found[name]["ratio"] == (f"{np.median(shown.astype(float)):.0%}" if len(shown) else "–")
