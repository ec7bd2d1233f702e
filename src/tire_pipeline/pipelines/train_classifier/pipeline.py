"""Features -> classifiers, measured on both splits."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.classifiers.score_on_splits import join_scores, score_classifiers, train_forest
from tire_pipeline.cluster import given_map
from tire_pipeline.reporting.evaluation.training_figures import confusion_figure


def create_pipeline(**_: object) -> Pipeline:
    """Train and measure the classifiers."""
    return Pipeline(
        [
            Node(
                given_map(score_classifiers),
                inputs=["features", "splits", "params:train_classifier", "params:seed"],
                outputs="scores_of_features",
                name="score_classifiers",
            ),
            Node(
                train_forest,
                inputs=[
                    "binned_features",
                    "binned_features_by_tire",
                    "splits",
                    "params:train_classifier",
                    "params:seed",
                ],
                outputs=["classifier", "scores_of_bins", "classifier_per_class", "confusion_table"],
                name="train_forest",
            ),
            Node(
                confusion_figure,
                inputs="confusion_table",
                outputs="confusion_matrix",
                name="draw_confusion",
            ),
            Node(
                join_scores,
                inputs=["scores_of_features", "scores_of_bins"],
                outputs="classifier_scores",
                name="join_scores",
            ),
        ]
    )
