"""What a fit returns."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import pandas as pd

from tire_pipeline.magic_formula.forces import TireForces
from tire_pipeline.magic_formula.model import TireModel


@dataclass(frozen=True)
class FitResult:
    """A fitted tire model and how far to trust it.

    Attributes
    ----------
    model : TireModel
    standard_errors : mapping of str to float
        One standard error of each fitted coefficient; NaN for one that ends at its bound.
    residuals : DataFrame
        For each output, load and camber: count, bias, RMS and largest residual, and the RMS as a percentage
        of the output's largest magnitude.
    undetermined : list of str
        What the data cannot determine, as "no camber sweeps: PDY3, PKY3 kept at 0".
    notes : list of str
        What else to know: bounds that were reached, values that were assumed, signs.
    relative_rms : mapping of str to float
        RMS of all residuals of an output over its largest magnitude.
    """

    model: TireModel
    standard_errors: Mapping[str, float]
    residuals: pd.DataFrame
    undetermined: list[str]
    notes: list[str]
    relative_rms: Mapping[str, float]

    def forces(self, **points: Any) -> TireForces:
        """Return the fitted model's forces; see :meth:`TireModel.forces`."""
        return self.model.forces(**points)

    def summary(self) -> str:
        """Return the fit in plain text."""
        lines = [f"Magic Formula {self.model.version}, FNOMIN = {self.model.value('FNOMIN'):g} N", ""]
        for output, value in self.relative_rms.items():
            lines.append(f"{output}: RMS of residuals {100 * value:.2f} % of the largest magnitude")
        lines += ["", "coefficient        value   standard error"]
        for name, error in self.standard_errors.items():
            lines.append(f"{name:<11} {self.model.value(name):>12.6g}   {error:.2g}")
        if self.undetermined:
            lines += ["", "Not determined by the data:", *(f"- {text}" for text in self.undetermined)]
        if self.notes:
            lines += ["", "Notes:", *(f"- {text}" for text in self.notes)]
        return "\n".join(lines)
