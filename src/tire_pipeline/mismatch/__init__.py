"""Where a simulation and a recording differ, what the model left out, and the proof of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tire_pipeline.on_demand import names_on_demand

if TYPE_CHECKING:
    from tire_pipeline.mismatch.corrected.model import CorrectedModel
    from tire_pipeline.mismatch.explainer import Explainer, explain_mismatch
    from tire_pipeline.mismatch.proof.measured import OutputFit
    from tire_pipeline.mismatch.report.contents import EffectReport, HeldOutFit
    from tire_pipeline.mismatch.report.result import MismatchReport
    from tire_pipeline.mismatch.several import explain_recordings

__all__ = [
    "CorrectedModel",
    "EffectReport",
    "Explainer",
    "HeldOutFit",
    "MismatchReport",
    "OutputFit",
    "explain_mismatch",
    "explain_recordings",
]

__getattr__ = names_on_demand(
    __name__,
    {
        "CorrectedModel": "corrected.model",
        "EffectReport": "report.contents",
        "Explainer": "explainer",
        "HeldOutFit": "report.contents",
        "MismatchReport": "report.result",
        "OutputFit": "proof.measured",
        "explain_mismatch": "explainer",
        "explain_recordings": "several",
    },
)
