"""Where a simulation and a recording differ, what the model left out, and the proof of it."""

from tire_pipeline.mismatch.corrected import CorrectedModel
from tire_pipeline.mismatch.explain import explain_mismatch
from tire_pipeline.mismatch.report import EffectReport, MismatchReport, OutputFit

__all__ = ["CorrectedModel", "EffectReport", "MismatchReport", "OutputFit", "explain_mismatch"]
