"""What `benchmarks/bench_translation.py` measured -> one page."""

import pandas as pd
from kedro.pipeline import Node, Pipeline

from tire_pipeline.reporting.translation_page import translation_page


def draw_translation_page(measured: pd.DataFrame) -> str:
    """Every translator on the same hidden tires, beside floor, oracle and doing nothing."""
    return translation_page(measured)


def create_pipeline(**_: object) -> Pipeline:
    """Show how well every translator does."""
    return Pipeline(
        [
            Node(
                draw_translation_page,
                inputs="translation_measured",
                outputs="translation_page",
                name="draw_translation_page",
            )
        ]
    )
