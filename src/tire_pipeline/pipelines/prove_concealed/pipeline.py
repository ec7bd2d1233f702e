"""Cases -> explanations -> scores; only ``score_proof`` reads the sealed answers.

Once on cases of the rig simulator, once on cases made from real recordings; one page shows both.
"""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.concealed.proof.recorded import (
    explain_real_by_baselines,
    explain_real_cases,
    part_real_cases,
    real_cases_to_make,
    score_real_proof,
)
from tire_pipeline.concealed.proof.simulated import (
    cases_to_make,
    explain_by_baselines,
    explain_cases,
    part_cases,
    score_proof,
)
from tire_pipeline.reporting.proof.proof_page import proof_page


def create_pipeline(**_: object) -> Pipeline:
    """Prove the explanations on concealed effects."""
    page = Node(
        proof_page,
        inputs=[
            "proof_scores",
            "proof_misses",
            "proof_details",
            "real_proof_scores",
            "real_proof_misses",
            "real_proof_details",
        ],
        outputs="proof_report",
        name="proof_page",
    )
    return Pipeline([*_on_the_simulator(), *_on_recordings(), page])


def _on_the_simulator() -> list[Node]:
    return [
        Node(cases_to_make, inputs="params:prove_concealed", outputs="concealed_made", name="make_cases"),
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
    ]


def _on_recordings() -> list[Node]:
    return [
        Node(
            real_cases_to_make,
            inputs="params:prove_concealed",
            outputs="real_concealed_made",
            name="make_real_cases",
            tags="real",
        ),
        Node(
            part_real_cases,
            inputs="real_concealed_made",
            outputs=["real_concealed_cases", "real_concealed_held_out", "real_concealed_answers"],
            name="part_real_cases",
            tags="real",
        ),
        Node(
            explain_real_cases,
            inputs="real_concealed_cases",
            outputs="real_concealed_reports",
            name="explain_real_cases",
            tags="real",
        ),
        Node(
            explain_real_by_baselines,
            inputs=["real_concealed_cases", "params:prove_concealed"],
            outputs="real_concealed_baseline_reports",
            name="explain_real_by_baselines",
            tags="real",
        ),
        Node(
            score_real_proof,
            inputs=[
                "real_concealed_reports",
                "real_concealed_baseline_reports",
                "real_concealed_held_out",
                "real_concealed_answers",
                "params:prove_concealed",
            ],
            outputs=["real_proof_scores", "real_proof_misses", "real_proof_details"],
            name="score_real_proof",
            tags="real",
        ),
    ]
