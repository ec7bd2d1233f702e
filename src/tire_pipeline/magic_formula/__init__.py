"""The Magic Formula engine: tire models, their forces, and operations on their coefficients."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tire_pipeline.on_demand import names_on_demand

if TYPE_CHECKING:
    from tire_pipeline.magic_formula.batch import forces_batch, pack, pack_matrix
    from tire_pipeline.magic_formula.changes.convert import conversion_notes
    from tire_pipeline.magic_formula.fitting import FitResult, PoorFitWarning, fit_magic_formula
    from tire_pipeline.magic_formula.forces import MissingRadiusWarning, TireForces
    from tire_pipeline.magic_formula.model import TireModel, model_of
    from tire_pipeline.magic_formula.parameters.coefficients import COEFFICIENT_NAMES
    from tire_pipeline.magic_formula.parameters.inputs import DegreesWarning, TireRangeWarning
    from tire_pipeline.magic_formula.parameters.points import OperatingPoints

__all__ = [
    "COEFFICIENT_NAMES",
    "DegreesWarning",
    "FitResult",
    "MissingRadiusWarning",
    "OperatingPoints",
    "PoorFitWarning",
    "TireForces",
    "TireModel",
    "TireRangeWarning",
    "conversion_notes",
    "fit_magic_formula",
    "forces_batch",
    "model_of",
    "pack",
    "pack_matrix",
]

__getattr__ = names_on_demand(
    __name__,
    {
        "COEFFICIENT_NAMES": "parameters.coefficients",
        "DegreesWarning": "parameters.inputs",
        "FitResult": "fitting.report.result",
        "MissingRadiusWarning": "forces",
        "OperatingPoints": "parameters.points",
        "PoorFitWarning": "fitting.report.verdict",
        "TireForces": "forces",
        "TireModel": "model",
        "TireRangeWarning": "parameters.inputs",
        "conversion_notes": "changes.convert",
        "fit_magic_formula": "fitting.model_fit",
        "forces_batch": "batch",
        "model_of": "model",
        "pack": "batch",
        "pack_matrix": "batch",
    },
)
