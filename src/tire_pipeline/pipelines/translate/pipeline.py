"""Files + fitted translator -> translated files, bands, verdicts, page."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.cluster import given_map
from tire_pipeline.reporting.translation.translated_folder_page import translate_page
from tire_pipeline.translation.files.chosen_files import choose_files
from tire_pipeline.translation.files.translated_folder import join_translated, translate_each
from tire_pipeline.translation.fitted import fit_translator


def create_pipeline(**_: object) -> Pipeline:
    """Translate the user's files to the target category: read, fit, translate, join, draw."""
    choosing = Node(
        choose_files,
        inputs=["files_to_translate", "params:translate"],
        outputs="chosen_files",
        name="choose_files",
    )
    return Pipeline([choosing, fit_node(), *_translating(), _drawing()])


def fit_node() -> Node:
    """Return the node that both ``train_agent`` and ``translate`` run."""
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


def _translating() -> list[Node]:
    return [
        Node(
            given_map(translate_each),
            inputs=[
                "translator",
                "chosen_files",
                "normalized_table",
                "params:translate",
                "params:normalize",
                "params:seed",
            ],
            outputs="translated_blocks",
            name="translate_each",
        ),
        Node(
            join_translated,
            inputs=["translated_blocks", "translator", "params:translate"],
            outputs=[
                "translation_files",
                "translation_report",
                "source_table",
                "translation_coefficients",
                "translation_bands",
                "translation_protocols",
            ],
            name="join_translated",
        ),
    ]


def _drawing() -> Node:
    return Node(
        translate_page,
        inputs=[
            "translation_report",
            "translated_blocks",
            "translation_protocols",
            "demonstration_files",
            "params:translate",
            "params:target_category",
            "translator",
        ],
        outputs=["translation_list", "translation_outcome"],
        name="draw_translated_files",
    )
