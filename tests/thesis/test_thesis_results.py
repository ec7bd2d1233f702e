"""Judging an agent, keys of stored results, and numbers as words."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.thesis.experiments.agents import curves_of_forces, judged_agent, thinned_learning_curve
from tire_pipeline.thesis.experiments.files import key_of, pack_frames, unpack_frames
from tire_pipeline.thesis.pages.class_scores import per_class_table
from tire_pipeline.thesis.pages.questions import answer_on_learning
from tire_pipeline.thesis.pages.words import least_within, plus_minus, points, rank_agreement
from tire_pipeline.thesis.result_tables import over_seeds
from tire_pipeline.translation.thesis.grid import Cell, train_cell

CELL = Cell("A2C", "reach_target_fast", "coefficients", 10)


@pytest.fixture(scope="module")
def judged(table):
    state = train_cell(table, CELL, target="A", seed=0, total_steps=1_280)["state"]
    own = table[table["category"] == "A"].head(6).assign(set="four", tire=list("uvwxyz"))
    other = table[table["category"] == "B"].head(6).assign(set="hidden", tire=list("uvwxyz"))
    target = table[table["category"] == "A"].tail(6).assign(tire=list("uvwxyz"))
    sources, references = pd.concat([own, other]), pd.concat([target, target])
    return judged_agent(state, CELL, 3, sources, references)


def test_tires_that_do_not_move_are_neither_better_nor_worse(judged):
    tires = judged["agent_tires"]
    still = tires[(tires["set"] == "four") & (tires["before"] == tires["after"])]
    agents = judged["agents"]
    own = agents[(agents["set"] == "four") & (agents["metric"] != "mean")]
    assert len(still) == 6  # the target's own tires are at their target already
    assert own["ratio"].to_numpy() == pytest.approx(1.0, abs=1e-12)
    assert (own["improved"] == 0).all()


@pytest.mark.parametrize("representation", ["coefficients", "power_series"])
def test_both_decodings_are_judged(table, representation):
    cell = Cell("A2C", "maximize_reward", representation, 10)
    state = train_cell(table, cell, target="A", seed=0, total_steps=2_000)["state"]
    sources = table[table["category"] == "B"].head(6).assign(set="four", tire=list("uvwxyz"))
    target = table[table["category"] == "A"].head(6)
    found = judged_agent(state, cell, 0, sources, target)
    metrics = found["agents"]
    assert set(metrics["decoding"]) == {"tire", "curves"}
    assert np.isfinite(metrics["ratio"]).all()
    assert metrics["improved"].between(0, 1).all()
    assert len(found["agent_tires"]) == 6
    assert len(found["actions"]) == 2 * (11 if representation == "coefficients" else 12)
    if representation == "coefficients":  # both decodings are the same curves here
        forces = metrics[metrics["metric"] == "forces"].set_index("decoding")["ratio"]
        assert forces["tire"] == pytest.approx(forces["curves"], rel=1e-6)


def test_every_row_says_which_agent_it_is_of(judged):
    assert set(judged["agents"]["decoding"]) == {"tire", "curves"}
    for frame in judged.values():
        assert (frame["seed"] == 3).all()
        assert (frame["algorithm"] == "A2C").all()
    assert set(judged["force_curves"]["kind"]) == {"source", "translated", "target", "decoded"}
    assert len(judged["force_curves"]) == 6 * 4 * 3 * 100


def test_slope_and_friction_of_sampled_forces():
    angles, loads = np.linspace(-0.25, 0.25, 100), np.array([4000.0, 6000.0, 8000.0])
    fy = -20.0 * loads[None, :, None] * np.clip(angles, -0.05, 0.05)
    curves = curves_of_forces(fy)
    assert curves.cornering_stiffness[0] == pytest.approx(20.0 * loads)
    assert curves.peak_friction[0] == pytest.approx(1.0)


def test_means_and_spread_over_the_seeds(judged):
    one = judged["agents"]
    both = pd.concat([one.assign(seed=0), one.assign(seed=1, ratio=one["ratio"] + 2)])
    summed = over_seeds(both)
    row = summed[(summed["metric"] == "forces") & (summed["quantity"] == "ratio") & (summed["set"] == "four")]
    assert row["value"].to_numpy() == pytest.approx(2.0)
    assert row["std"].to_numpy() == pytest.approx(np.sqrt(2))
    assert over_seeds(one)["std"].isna().all()  # one seed has no spread


def test_stored_tables_come_back_as_they_were():
    frame = pd.DataFrame({"name": ["a", "b"], "yes": [True, False], "n": [1, 2], "x": [0.5, np.nan]})
    back = unpack_frames(pack_frames({"one": frame, "empty": frame.head(0)}))
    pd.testing.assert_frame_equal(back["one"], frame, check_dtype=False)
    assert list(back["empty"].columns) == list(frame.columns)


def test_a_key_says_all_that_a_result_depends_on():
    frame = pd.DataFrame({"a": [1.0, 2.0], "b": ["x", "y"]})
    assert key_of(frame, {"steps": 10}) == key_of(frame.copy(), {"steps": 10})
    others = [
        key_of(frame, {"steps": 11}),
        key_of(frame.assign(a=[1.0, 2.0 + 1e-12]), {"steps": 10}),
        key_of(frame.rename(columns={"a": "c"}), {"steps": 10}),
        key_of(frame.iloc[::-1], {"steps": 10}),
    ]
    assert len({key_of(frame, {"steps": 10}), *others}) == 5


def test_learning_curves_are_means_of_windows():
    steps = np.arange(1, 601)
    thin = thinned_learning_curve(pd.DataFrame({"step": steps, "reward": steps / 600, "length": 1.0}))
    assert len(thin) == 60
    assert thin["episodes"].sum() == 600
    assert (thin["reward"].diff().dropna() > 0).all()


def test_words():
    assert points(0.95, 0.97) == "2.0 percentage points below the thesis"
    assert points(0.97, 0.97) == "the same as in the thesis"
    assert plus_minus(1.2345, 0.0567) == "1.23 ± 0.06"
    assert plus_minus(1234.5, 56.7) == "1,234 ± 57"
    assert plus_minus(0.75, 0.0) == plus_minus(0.75, float("nan")) == "0.75"
    assert plus_minus(float("nan"), 1.0) == "–"
    curve = pd.DataFrame({"trees": [1, 2, 3, 4], "accuracy": [0.5, 0.8, 0.897, 0.9]})
    assert least_within(curve, "trees") == 3
    assert rank_agreement([1, 2, 3], [10, 20, 30]) == pytest.approx(1.0)
    assert np.isnan(rank_agreement([1, 2], [1, 2]))


@pytest.mark.parametrize(
    ("up", "before", "after", "said", "moved"),
    [
        (60, 0.2, 0.4, "Yes: training raises the reward in 60 of 60 cells, and", "raise"),
        (0, 0.16, 0.21, "Only in part: training raises the reward in 0 of 60 cells, but", "raise"),
        (60, 0.2, 0.2, "Only in part: training raises the reward in 60 of 60 cells, but", "leave"),
        (0, 0.201, 0.203, "No: training raises the reward in 0 of 60 cells, and", "leave"),
        (0, 0.3, 0.1, "No: training raises the reward in 0 of 60 cells, and", "lower"),
    ],
)
def test_what_agents_learn_is_said_by_both_figures(up, before, after, said, moved):
    """A page said "Only in part" beside 0 of 2 cells, and not which part."""
    told = answer_on_learning(up, 60, before, after)
    assert told.startswith(f"{said} the agents' translations {moved} the classifier's mean probability")


@pytest.mark.parametrize("names", [["North", "South"], ["A", "North"]])
def test_a_users_categories_have_any_name(names):
    rows = [(split, name, 0.9, 0.8, 0.7) for split in ("random", "by_tire") for name in names]
    own = pd.DataFrame(rows, columns=["split", "category", "precision", "recall", "f1"])
    table = per_class_table(own).set_index("category")
    assert (table.loc[names, ["precision, random", "precision, by tire"]] == 0.9).all(axis=None)
    assert np.isnan(table.loc["North", "precision, thesis"])
    assert table["precision, thesis"].notna().sum() == 6
