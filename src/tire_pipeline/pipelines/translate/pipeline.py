"""Files + training table -> translated files, bands, verdicts."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.pipelines.translate.nodes import translate_all


def create_pipeline(**_: object) -> Pipeline:
    """Translate the user's files to the target category."""
    pipeline = Pipeline(
        [
            Node(
                translate_all,
                inputs=[
                    "files_to_translate",
                    "normalized_table",
                    "classifier",
                    "representation",
                    "binning",
                    "params:translate",
                    "params:normalize",
                    "params:target_category",
                    "params:seed",
                ],
                outputs=[
                    "translation_files",
                    "translation_report",
                    "translation_coefficients",
                    "translation_bands",
                    "translation_list",
                ],
                name="translate_all",
            )
        ]
    )
    return pipeline
