"""From measurements to a tire model, in the stages that engineers use."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tire_pipeline.magic_formula.fitting.model_fit import fit_magic_formula
    from tire_pipeline.magic_formula.fitting.report.result import FitResult
    from tire_pipeline.magic_formula.fitting.report.verdict import PoorFitWarning

_MODULE_OF_NAME = {
    "FitResult": "report.result",
    "PoorFitWarning": "report.verdict",
    "fit_magic_formula": "model_fit",
}

__all__ = ["FitResult", "PoorFitWarning", "fit_magic_formula"]


def __getattr__(name: str) -> Any:
    """Import what is asked for, and with it SciPy's optimizers, only when it is asked for."""
    if name in _MODULE_OF_NAME:
        return getattr(import_module(f"{__name__}.{_MODULE_OF_NAME[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
