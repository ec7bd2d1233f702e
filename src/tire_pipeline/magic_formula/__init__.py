"""The Magic Formula engine: tire models, their forces, and operations on their coefficients."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tire_pipeline.magic_formula.batch import forces_batch, pack, pack_matrix
from tire_pipeline.magic_formula.changes.convert import conversion_notes
from tire_pipeline.magic_formula.forces import MissingRadiusWarning, TireForces
from tire_pipeline.magic_formula.model import TireModel, model_of
from tire_pipeline.magic_formula.parameters.coefficients import COEFFICIENT_NAMES
from tire_pipeline.magic_formula.parameters.inputs import DegreesWarning, TireRangeWarning
from tire_pipeline.magic_formula.parameters.points import OperatingPoints

if TYPE_CHECKING:
    from tire_pipeline.magic_formula.fitting import FitResult, PoorFitWarning, fit_magic_formula

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
    """Import the fitter, and with it SciPy's optimizers, only when it is asked for."""
    if name in ("FitResult", "PoorFitWarning", "fit_magic_formula"):
        from tire_pipeline.magic_formula import fitting

        return getattr(fitting, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
