"""The Magic Formula engine: tire models, their forces, and operations on their coefficients."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tire_pipeline.magic_formula.batch import forces_batch, pack, pack_matrix
    from tire_pipeline.magic_formula.changes.convert import conversion_notes
    from tire_pipeline.magic_formula.fitting import FitResult, PoorFitWarning, fit_magic_formula
    from tire_pipeline.magic_formula.forces import MissingRadiusWarning, TireForces
    from tire_pipeline.magic_formula.model import TireModel, model_of
    from tire_pipeline.magic_formula.parameters.coefficients import COEFFICIENT_NAMES
    from tire_pipeline.magic_formula.parameters.inputs import DegreesWarning, TireRangeWarning
    from tire_pipeline.magic_formula.parameters.points import OperatingPoints

_MODULE_OF_NAME = {
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
}

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


def __getattr__(name: str) -> Any:
    """Import what is asked for, and with it numba and SciPy, only when it is asked for."""
    if name in _MODULE_OF_NAME:
        return getattr(import_module(f"{__name__}.{_MODULE_OF_NAME[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
