"""From measurements to a tire model, in the stages that engineers use."""

from tire_pipeline.magic_formula.fitting.model_fit import fit_magic_formula
from tire_pipeline.magic_formula.fitting.report.result import FitResult
from tire_pipeline.magic_formula.fitting.report.verdict import PoorFitWarning

__all__ = ["FitResult", "PoorFitWarning", "fit_magic_formula"]
