import numpy as np
import pandas as pd
import pytest

from tire_pipeline.classifiers.methods.ann import Ann
from tire_pipeline.classifiers.methods.random_forest import RandomForest
from tire_pipeline.classifiers.tuning import (
    ANN_GRID,
    ann_combinations,
    folds_of,
    narrowed_grid,
    random_combinations,
    tune_ann,
    tune_forest_depth,
    tune_forest_trees,
)


def test_table_4_2_has_1728_combinations():
    combinations = ann_combinations()
    assert len(combinations) == 1728
    assert not combinations.duplicated().any()
    drawn = random_combinations(50, seed=1)
    assert len(drawn) == 50
    assert not drawn.duplicated().any()


def test_folds_by_tire_keep_tires_together(binned):
    labels = binned[1]
    tires = np.array([f"t{i // 4}" for i in range(len(labels))])
    for train, test in folds_of(labels, seed=0, tires=tires):
        assert not set(tires[train]) & set(tires[test])
    assert len(folds_of(labels, seed=0)) == 4


def test_ann_tuning_is_a_cross_validation_of_single_networks(binned):
    features, labels = binned
    grid = {**ANN_GRID, "learning_rate": (0.001,), "weight_decay": (0.01,), "batch_size": (64,)}
    grid |= {"epochs": (2, 3), "optimizer": ("AdamW",)}
    scores = tune_ann(features, labels, ann_combinations(grid), seed=7)
    assert len(scores) == 6
    for loss in ("CrossEntropyLoss", "MSELoss"):
        expected = []
        for train, test in folds_of(np.unique(labels, return_inverse=True)[1], seed=7):
            one = Ann(epochs=3, batch_size=64, loss=loss, smote=False)
            one.fit(features[train], labels[train], seed=7)
            predicted = one.classes_[one.predict_proba(features[test]).argmax(axis=1)]
            expected.append((predicted == labels[test]).mean())
        cell = scores[(scores["loss"] == loss) & (scores["epochs"] == 3)]
        # matrix products of other sizes round differently: a row may tip over
        assert cell["accuracy"].item() == pytest.approx(np.mean(expected), abs=2 / len(labels))
    both = scores.pivot(index="epochs", columns="loss", values="accuracy")
    assert (both["CrossEntropyLoss"] == both["NLLLoss"]).all()


def test_narrowed_grid_keeps_what_the_best_share():
    scores = random_combinations(60, seed=0)
    scores["accuracy"] = np.where(scores["optimizer"] == "AdamW", 0.9, 0.1)
    assert narrowed_grid(scores, best=10)["optimizer"] == ("AdamW",)


@pytest.mark.parametrize("smote", [False, True])
def test_trees_are_counted_as_separate_forests_would(binned, smote):
    features, labels = binned
    curve = tune_forest_trees(features, labels, most=6, seed=3, smote=smote).set_index("trees")
    for trees in (1, 4, 6):
        expected = []
        for train, test in folds_of(labels, seed=3):
            forest = RandomForest(trees, None, smote=smote)
            forest.fit(features[train], labels[train], seed=3)
            predicted = forest.classes_[forest.predict_proba(features[test]).argmax(axis=1)]
            expected.append((predicted == labels[test]).mean())
        # ties between classes may fall the other way where sums round differently
        assert curve.loc[trees, "accuracy"] == pytest.approx(np.mean(expected), abs=2 / len(labels))


def test_depths_beyond_the_deepest_tree_are_flat(binned):
    curve = tune_forest_depth(*binned, trees=5, most=40, seed=0)
    assert list(curve["depth"]) == list(range(1, 41))
    free = []
    for train, test in folds_of(binned[1], seed=0):
        forest = RandomForest(5, None, smote=False).fit(binned[0][train], binned[1][train], seed=0)
        predicted = forest.classes_[forest.predict_proba(binned[0][test]).argmax(axis=1)]
        free.append((predicted == binned[1][test]).mean())
    assert curve["accuracy"].iloc[-1] == pytest.approx(np.mean(free), abs=2 / 400)
    assert isinstance(curve, pd.DataFrame)
