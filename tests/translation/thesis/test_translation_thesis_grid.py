import numpy as np
import pandas as pd
import pytest

from tire_pipeline.classifiers.experiments import (
    accuracy_by_bins,
    accuracy_by_latent_features,
    class_distribution,
)
from tire_pipeline.representations import make_representation
from tire_pipeline.tire_table import random_split, split_by_tire
from tire_pipeline.translation.thesis.grid import CELLS, Cell, train_cell
from tire_pipeline.translation.thesis.tables import (
    better_than_nothing,
    collect_cells,
    thesis_table,
)

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def splits(table):
    labels = table["category"].to_numpy()
    return {
        "random": random_split(labels, seed=0),
        "by_tire": split_by_tire(labels, table["tire_id"].to_numpy(), seed=0),
    }


def test_grid_has_48_cells_with_names_of_their_own():
    assert len(CELLS) == len({cell.name for cell in CELLS}) == 48
    assert all(cell.name.isidentifier() for cell in CELLS)


@pytest.mark.parametrize("representation", ["coefficients", "power_series"])
def test_one_cell_is_trained(table, representation):
    cell = Cell("A2C", "maximize_reward", representation, 10)
    given = make_representation(representation).fit(table) if representation != "coefficients" else None
    trained = train_cell(table, cell, target="A", seed=0, total_steps=2_000, representation=given)
    assert trained["state"]["translator"] == "agent"
    assert len(trained["learning_curve"]) > 0


def test_experiments_give_every_cell(table, splits):
    bins = accuracy_by_bins(
        table, splits, representations=("coefficients", "key_attributes"), bins=(2, 10), seeds=(0,)
    )
    assert len(bins) == 2 * 2 * 2
    random = bins[(bins["split"] == "random") & (bins["representation"] == "coefficients")]
    assert random["accuracy"].iloc[1] > random["accuracy"].iloc[0]
    latent = accuracy_by_latent_features(table, splits, counts=(1, 2), seeds=(0,), epochs=2)
    assert list(latent["features"]) == [1, 2, 1, 2]
    counts = class_distribution(np.zeros((len(table), 1)), table["category"], splits)
    assert counts.groupby("split")["all"].sum().eq(len(table)).all()
    assert counts.groupby("split")["training_smote"].nunique().eq(1).all()


def test_tables_of_the_thesis_from_judged_cells():
    def metrics(ratio):
        names = ["forces", "cornering_stiffness", "peak_friction", "mean"]
        ratios = [ratio, 2.0, 3.0, (ratio + 5) / 3]
        return pd.DataFrame(
            {"metric": names, "ratio": ratios, "improved": 0.25, "worst": 9.0, "files": 16}
        ).assign(decoding="tire")

    first, second = CELLS[0], CELLS[-1]
    judged = {first.name: [metrics(0.5), metrics(0.7)], second.name: [metrics(1.5), metrics(0.9)]}
    collected = collect_cells(judged)
    assert len(collected) == 16
    table = thesis_table(collected, reward=first.reward, n_bins=first.n_bins)
    row = table.loc[(first.representation, first.algorithm)]
    assert row["forces"] == pytest.approx(0.6)
    assert row["forces_std"] == pytest.approx(0.1)
    assert len(table) == 1
    improved = thesis_table(collected, reward=second.reward, n_bins=second.n_bins, value="improved")
    assert improved.iloc[0]["mean"] == 0.25
    better = better_than_nothing(collected)
    assert better[["algorithm", "metric"]].to_numpy().tolist() == [[first.algorithm, "forces"]]
    assert better["seeds_below_1"].item() == 1.0
