"""From measurements to a tire model, in the stages that engineers use."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tire_pipeline.on_demand import names_on_demand

if TYPE_CHECKING:
    from tire_pipeline.magic_formula.fitting.model_fit import fit_magic_formula
    from tire_pipeline.magic_formula.fitting.report.result import FitResult
    from tire_pipeline.magic_formula.fitting.report.verdict import PoorFitWarning

__all__ = ["FitResult", "PoorFitWarning", "fit_magic_formula"]

__getattr__ = names_on_demand(
    __name__,
    {
        "FitResult": "report.result",
        "PoorFitWarning": "report.verdict",
        "fit_magic_formula": "model_fit",
    },
)
