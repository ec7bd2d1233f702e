"""The published figures are those in the thesis' text."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.thesis import published_agents, published_figure, published_table

TEXT = Path(__file__).resolve().parents[3] / "shared" / "thesis.txt"


@pytest.fixture(scope="module")
def text() -> str:
    if not TEXT.exists() and not os.environ.get("CI"):
        pytest.skip(f"the thesis' text is not at {TEXT}")
    return TEXT.read_text(encoding="utf-8")


def test_every_printed_value_of_the_agents_tables_is_in_the_text(text):
    agents = published_agents()
    assert len(agents) == 12 * 8 * 4
    names = {
        "coefficients": "MF Coefficients",
        "latent": "Latent",
        "power_series": "Power Series",
        "key_attributes": "Key Attributes",
    }
    for (table, representation, algorithm), rows in agents.groupby(["table", "representation", "algorithm"]):
        section = text[text.index(f"Table {table}:") :]
        line = next(
            one for one in section.splitlines() if one.startswith(f"{names[representation]} {algorithm}\t")
        )
        assert [float(value) for value in line.split("\t")[1:]] == rows["value"].to_list()
        caption = section.splitlines()[0]
        assert f"{rows['n_bins'].iloc[0]} bins" in caption
        words = {"reach_target_fast": "Reach Target Fast", "maximize_reward": "Maximize Reward"}
        assert words[rows["reward"].iloc[0]] in caption


@pytest.mark.parametrize("number", ["5.6", "5.8", "5.9", "6.1"])
def test_rows_of_other_tables_are_in_the_text(text, number):
    lines = text[text.index(f"Table {number}:") :].splitlines()[:20]
    printed = [line.split("\t") for line in lines if "\t" in line][1:]
    ours = published_table(number).frame.to_numpy().tolist()
    assert len(printed) >= len(ours)
    for mine, theirs in zip(ours, printed, strict=False):
        assert [_plain(value) for value in mine] == [_plain(value) for value in theirs]


def _plain(value: object) -> object:
    try:
        return float(str(value))
    except ValueError:
        return value


def test_only_two_published_ratios_beat_doing_nothing_as_table_6_1_says():
    agents = published_agents()
    ratios = agents[(agents["quantity"] == "ratio") & (agents["metric"] != "mean")]
    better = ratios[ratios["value"] < 1]
    found = {(row.algorithm, row.n_bins, row.reward, row.metric) for row in better.itertuples()}
    assert found == {
        ("PPO", 20, "reach_target_fast", "forces"),
        ("PPO", 20, "reach_target_fast", "peak_friction"),
    }
    assert len(published_table("6.1").frame) == len(better) == 2


def test_an_unknown_table_is_named():
    with pytest.raises(DomainError, match=r"9\.9"):
        published_table("9.9")
    assert "jagged" in published_figure("5.11").says
