"""What `benchmarks/bench_translation.py` measured -> one page."""

import pandas as pd
from kedro.pipeline import Node, Pipeline

from tire_pipeline.reporting.translation.translation_page import translation_page


def draw_translation_page(measured: pd.DataFrame, bias: pd.DataFrame, beside_truth: pd.DataFrame) -> str:
    """Every translator on the same hidden tires, and what is learned about the organisations' bias."""
    return translation_page(measured, bias=bias, beside_truth=beside_truth)


def create_pipeline(**_: object) -> Pipeline:
    """Show how well every translator does."""
    return Pipeline(
        [
            Node(
                draw_translation_page,
                inputs=["translation_measured", "bias_measured", "bias_beside_truth"],
                outputs="translation_page",
                name="draw_translation_page",
            )
        ]
    )
