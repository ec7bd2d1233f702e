"""Files + fitted translator -> translated files, bands, verdicts, page."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.cluster import given_map
from tire_pipeline.reporting.translation.translated_folder_page import translate_page
from tire_pipeline.translation.fitted import fit_translator
from tire_pipeline.translation.translated_folder import read_sources, translate_all


def create_pipeline(**_: object) -> Pipeline:
    """Translate the user's files to the target category: read, fit, translate, draw."""
    return Pipeline(
        [
            Node(
                given_map(read_sources, without_cluster=1),
                inputs=[
                    "files_to_translate",
                    "normalized_table",
                    "params:translate",
                    "params:normalize",
                    "params:seed",
                ],
                outputs=["source_models", "source_table", "unreadable_sources"],
                name="read_sources",
            ),
            fit_node(),
            Node(
                translate_all,
                inputs=[
                    "translator",
                    "source_models",
                    "source_table",
                    "unreadable_sources",
                    "params:translate",
                ],
                outputs=[
                    "translation_files",
                    "translation_report",
                    "translation_coefficients",
                    "translation_bands",
                    "translation_protocols",
                    "translation_curves",
                ],
                name="translate_all",
            ),
            Node(
                translate_page,
                inputs=[
                    "translation_report",
                    "translation_curves",
                    "translation_coefficients",
                    "translation_protocols",
                    "source_table",
                    "demonstration_files",
                    "params:translate",
                    "params:target_category",
                ],
                outputs=["translation_list", "translation_outcome"],
                name="draw_translated_files",
            ),
        ]
    )


def fit_node() -> Node:
    """Give the node that both ``train_agent`` and ``translate`` run."""
    return Node(
        fit_translator,
        inputs=[
            "normalized_table",
            "params:translate",
            "params:normalize",
            "params:target_category",
            "params:seed",
        ],
        outputs="translator",
        name="fit_translator",
    )
