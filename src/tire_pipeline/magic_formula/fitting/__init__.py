"""From measurements to a tire model, in the stages that engineers use."""

from tire_pipeline.magic_formula.fitting.fit import fit_magic_formula
from tire_pipeline.magic_formula.fitting.result import FitResult

__all__ = ["FitResult", "fit_magic_formula"]
