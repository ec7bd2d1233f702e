"""Where a simulation and a recording differ, what the model left out, and the proof of it."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tire_pipeline.mismatch.corrected.model import CorrectedModel
    from tire_pipeline.mismatch.explainer import Explainer, explain_mismatch
    from tire_pipeline.mismatch.proof.measured import OutputFit
    from tire_pipeline.mismatch.report.contents import EffectReport, HeldOutFit
    from tire_pipeline.mismatch.report.result import MismatchReport
    from tire_pipeline.mismatch.several import explain_recordings

_MODULE_OF_NAME = {
    "CorrectedModel": "corrected.model",
    "EffectReport": "report.contents",
    "Explainer": "explainer",
    "HeldOutFit": "report.contents",
    "MismatchReport": "report.result",
    "OutputFit": "proof.measured",
    "explain_mismatch": "explainer",
    "explain_recordings": "several",
}

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


def __getattr__(name: str) -> Any:
    """Import what is asked for, and with it pandas, numba and SciPy, only when it is asked for."""
    if name in _MODULE_OF_NAME:
        return getattr(import_module(f"{__name__}.{_MODULE_OF_NAME[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
