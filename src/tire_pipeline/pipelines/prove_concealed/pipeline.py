"""Cases -> explanations -> scores; only ``score_proof`` reads the sealed answers."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.pipelines.prove_concealed.nodes import (
    explain_by_baselines,
    explain_cases,
    make_cases,
    part_cases,
    score_proof,
)
from tire_pipeline.pipelines.prove_concealed.report import proof_page


def create_pipeline(**_: object) -> Pipeline:
    """Prove the explanations on concealed effects."""
    return Pipeline(
        [
            Node(make_cases, inputs="params:prove_concealed", outputs="concealed_made", name="make_cases"),
            Node(
                part_cases,
                inputs="concealed_made",
                outputs=["concealed_cases", "concealed_held_out", "concealed_answers"],
                name="part_cases",
            ),
            Node(
                explain_cases,
                inputs="concealed_cases",
                outputs="concealed_reports",
                name="explain_cases",
            ),
            Node(
                explain_by_baselines,
                inputs=["concealed_cases", "params:prove_concealed"],
                outputs="concealed_baseline_reports",
                name="explain_by_baselines",
            ),
            Node(
                score_proof,
                inputs=[
                    "concealed_reports",
                    "concealed_baseline_reports",
                    "concealed_held_out",
                    "concealed_answers",
                ],
                outputs=["proof_scores", "proof_misses", "proof_details"],
                name="score_proof",
            ),
            Node(
                proof_page,
                inputs=["proof_scores", "proof_misses", "proof_details"],
                outputs="proof_report",
                name="proof_page",
            ),
        ]
    )
