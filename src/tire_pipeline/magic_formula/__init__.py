"""The Magic Formula engine: tire models, their forces, and what is done with their coefficients."""

from tire_pipeline.magic_formula.axes import AXES
from tire_pipeline.magic_formula.batch import forces_batch, model_of, pack, pack_matrix
from tire_pipeline.magic_formula.coefficients import COEFFICIENT_NAMES
from tire_pipeline.magic_formula.forces import TireForces
from tire_pipeline.magic_formula.inputs import DegreesWarning, TireRangeWarning
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.numpy_form import OUTPUTS

__all__ = [
    "AXES",
    "COEFFICIENT_NAMES",
    "OUTPUTS",
    "DegreesWarning",
    "TireForces",
    "TireModel",
    "TireRangeWarning",
    "forces_batch",
    "model_of",
    "pack",
    "pack_matrix",
]
