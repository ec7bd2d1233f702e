"""Files -> one table."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.tire_table.read_files import join_files, read_files


def create_pipeline(**_: object) -> Pipeline:
    """Read every .tir file below the folder."""
    return Pipeline(
        [
            Node(read_files, inputs="tir_files", outputs="tir_blocks", name="read_files"),
            Node(
                join_files,
                inputs=["tir_blocks", "params:ingest_tir"],
                outputs=["tire_table_raw", "ingest_report", "ingest_summary"],
                name="join_files",
            ),
        ]
    )
