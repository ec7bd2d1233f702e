import subprocess
import sys

import numpy as np
import pytest

from tire_pipeline.classifiers import CLASSIFIERS, classifier_from_state, make_classifier
from tire_pipeline.classifiers.evaluate import compare_classifiers, evaluate_classifier
from tire_pipeline.classifiers.methods.compiled_forest import CompiledForest, compile_forest
from tire_pipeline.classifiers.methods.oversampling import oversample
from tire_pipeline.classifiers.reliability import expected_calibration_error, reliability_curve
from tire_pipeline.errors import DomainError

pytestmark = pytest.mark.slow

OPTIONS = {"ann": {"epochs": 30}, "gradient_boosting": {"n_rounds": 20}}


@pytest.mark.parametrize("smote", [False, True])
@pytest.mark.parametrize("name", list(CLASSIFIERS))
def test_learns_and_comes_back_from_its_state(binned, parts, name, smote):
    features, labels = binned
    train, test = parts
    options = OPTIONS.get(name, {})
    trained = make_classifier(name, smote=smote, **options).fit(features[train], labels[train], seed=1)
    probabilities = trained.predict_proba(features[test])
    np.testing.assert_allclose(probabilities.sum(axis=1), 1)
    assert list(trained.classes_) == ["A", "B", "C", "D"]
    right = trained.classes_[probabilities.argmax(axis=1)] == labels[test]
    assert right.mean() > 0.6
    state = trained.to_state()
    assert all(isinstance(v, np.ndarray | str | int | float) for v in state.values())
    assert all(v.dtype != object for v in state.values() if isinstance(v, np.ndarray))
    again = classifier_from_state(state)
    np.testing.assert_array_equal(again.predict_proba(features[test]), probabilities)


@pytest.mark.parametrize("name", list(CLASSIFIERS))
def test_same_seed_same_classifier(binned, name):
    features, labels = binned
    options = {**OPTIONS.get(name, {})}
    if name == "ann":
        options["epochs"] = 2
    first, again = (make_classifier(name, **options).fit(features, labels, seed=5) for _ in range(2))
    np.testing.assert_array_equal(first.predict_proba(features), again.predict_proba(features))


def test_compiled_forest_agrees_with_scikit_learn(binned):
    from sklearn.ensemble import RandomForestClassifier

    features, labels = binned
    model = RandomForestClassifier(30, max_depth=10, random_state=0).fit(features, labels)
    compiled = compile_forest(model)
    rng = np.random.default_rng(0)
    for rows in (
        features,
        rng.integers(0, 40, size=(2000, 8)),
        rng.normal(5, 5, size=(2000, 8)),
        features[:1],
    ):
        expected = model.predict_proba(rows)
        np.testing.assert_allclose(compiled.sums(rows), expected, rtol=0, atol=1e-6)
        np.testing.assert_allclose(compiled.sums_without_numba(rows), expected, rtol=0, atol=1e-6)
    back = CompiledForest.from_state(compiled.to_state())
    np.testing.assert_array_equal(back.sums(features), compiled.sums(features))


def test_gradient_boosting_agrees_with_scikit_learn(binned):
    from sklearn.ensemble import GradientBoostingClassifier

    features, labels = binned
    for keep in (labels != "", np.isin(labels, ["A", "B"])):
        ours = make_classifier("gradient_boosting", n_rounds=15, smote=False)
        ours.fit(features[keep], labels[keep], seed=3)
        theirs = GradientBoostingClassifier(
            n_estimators=15, max_depth=4, learning_rate=0.2, subsample=0.7, random_state=3
        ).fit(features[keep], labels[keep])
        np.testing.assert_allclose(ours.predict_proba(features), theirs.predict_proba(features), atol=1e-9)


def test_calibrated_forest_agrees_with_scikit_learn(binned):
    from sklearn.calibration import CalibratedClassifierCV
    from sklearn.ensemble import RandomForestClassifier
    from sklearn.model_selection import StratifiedKFold

    features, labels = binned
    ours = make_classifier("calibrated", method="sigmoid", smote=False).fit(features, labels, seed=2)
    theirs = CalibratedClassifierCV(
        RandomForestClassifier(30, max_depth=10, random_state=2),
        method="sigmoid",
        cv=StratifiedKFold(5, shuffle=True, random_state=2),
        ensemble=False,
    ).fit(features, labels)
    np.testing.assert_allclose(ours.predict_proba(features), theirs.predict_proba(features), atol=2e-3)


def test_smote_balances_the_training_rows_only(binned):
    features, labels = binned
    more, names = oversample(features, labels, smote=True, seed=0)
    counts = np.unique(names, return_counts=True)[1]
    assert (counts == np.unique(labels, return_counts=True)[1].max()).all()
    np.testing.assert_array_equal(more[: len(features)], features)


def test_smote_with_a_single_row_names_the_category(binned):
    features, labels = binned
    keep = np.r_[np.flatnonzero(labels != "D"), np.flatnonzero(labels == "D")[:1]]
    with pytest.raises(DomainError, match="D has one"):
        make_classifier("random_forest").fit(features[keep], labels[keep], seed=0)


def test_unknown_classifier_is_refused():
    with pytest.raises(DomainError, match="random_forest"):
        make_classifier("oracle")


def test_evaluation_by_hand(binned, parts):
    features, labels = binned
    train, test = parts
    result = evaluate_classifier("random_forest", features, labels, train, test, seeds=(0, 1))
    predicted = [c.classes_[c.predict_proba(features[test]).argmax(axis=1)] for c in result.classifiers]
    assert result.accuracy == pytest.approx(np.mean([p == labels[test] for p in predicted]))
    assert result.confusion.to_numpy().sum() == pytest.approx(1)
    assert np.trace(result.confusion.to_numpy()) == pytest.approx(result.accuracy)
    recall = np.mean([(p[labels[test] == "A"] == "A").mean() for p in predicted])
    assert result.per_class.loc["A", "recall"] == pytest.approx(recall)
    assert result.per_class["rows"].sum() == len(test)


def test_comparison_has_every_cell(binned, parts):
    table = compare_classifiers(
        *binned,
        {"random": parts, "tire": parts},
        names=("naive_bayes", "random_forest"),
        seeds=(0,),
    )
    assert len(table) == 2 * 2 * 2
    assert table[["accuracy", "f1"]].gt(0.5).all().all()


def test_reliability_of_a_classifier_that_knows_its_limits():
    rng = np.random.default_rng(0)
    top = rng.uniform(0.5, 1, 20_000)
    probabilities = np.stack([top, 1 - top], axis=1)
    honest = np.where(rng.uniform(size=len(top)) < top, "A", "B")
    classes = np.array(["A", "B"])
    curve = reliability_curve(probabilities, honest, classes)
    assert curve["rows"].sum() == len(top)
    assert expected_calibration_error(curve) < 0.02
    boaster = np.where(rng.uniform(size=len(top)) < 0.5, "A", "B")
    wrong = reliability_curve(probabilities, boaster, classes)
    assert expected_calibration_error(wrong) == pytest.approx(0.25, abs=0.02)


def test_import_needs_nothing_heavy():
    code = (
        "import sys, tire_pipeline.classifiers;"
        "sys.exit(bool({'torch', 'sklearn', 'imblearn', 'numba'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
