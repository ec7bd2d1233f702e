"""How good translations are: errors of curves, ratios to doing nothing, share of improved curves."""

from .curves import Curves, EvaluationGrid, curves_of
from .metrics import ALL_METRICS, THESIS_METRICS, curve_errors
from .translation_errors import Evaluation, evaluate_translations, floor_evaluation

__all__ = [
    "ALL_METRICS",
    "THESIS_METRICS",
    "Curves",
    "Evaluation",
    "EvaluationGrid",
    "curve_errors",
    "curves_of",
    "evaluate_translations",
    "floor_evaluation",
]
