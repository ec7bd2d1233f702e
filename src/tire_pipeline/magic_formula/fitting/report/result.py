"""What a fit returns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import pandas as pd

from tire_pipeline.magic_formula.fitting.report.valid_ranges import with_measured_ranges
from tire_pipeline.magic_formula.forces import TireForces
from tire_pipeline.magic_formula.model import TireModel

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False)
class FitResult:
    """A fitted tire model and how far to trust it.

    Attributes
    ----------
    model : TireModel
        With what was fitted, and what it started from for the rest.
    standard_errors : mapping of str to float
        One standard error of each fitted coefficient; NaN for one that ends at its bound.
    residuals : DataFrame
        For each output, load and camber: count, bias, RMS and largest residual, and the RMS as a percentage
        of the output's largest magnitude.
    undetermined : list of str
        What the data cannot determine, as "no camber sweeps: PDY3, PKY3 kept at 0".
    notes : list of str
        Further remarks: bounds that were reached, values that were assumed, signs.
    relative_rms : mapping of str to float
        RMS of all residuals of an output over its largest magnitude.
    measured : DataFrame, optional
        The points that were fitted, by canonical name in SI units.
    poor : mapping of str to str
        Implausible outputs, with what is wrong and the likely reason; empty if the fit succeeded.
    not_fitted : sequence of str
        Outputs that were measured, but at no points that a stage could fit; ``undetermined`` says why.

    See Also
    --------
    fit_magic_formula : What returns it.

    Notes
    -----
    The residuals are model minus measurement, over all points of an output that were fitted.

    Examples
    --------
    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.magic_formula import TireModel, fit_magic_formula
    >>> tire = TireModel.from_coefficients(
    ...     {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}
    ... )
    >>> angles, loads = np.meshgrid(np.linspace(-0.2, 0.2, 41), [2000.0, 4000.0, 6000.0])
    >>> points = pd.DataFrame({"slip_angle": angles.ravel(), "normal_load": loads.ravel()})
    >>> points["fy"] = tire.forces(slip_angle=points["slip_angle"], normal_load=points["normal_load"]).fy
    >>> fit = fit_magic_formula(points, starts=1)
    >>> list(fit.relative_rms), dict(fit.poor)
    (['fy'], {})
    """

    model: TireModel
    standard_errors: Mapping[str, float]
    residuals: pd.DataFrame
    undetermined: list[str]
    notes: list[str]
    relative_rms: Mapping[str, float]
    measured: pd.DataFrame | None = None
    poor: Mapping[str, str] = field(default_factory=dict)
    not_fitted: Sequence[str] = ()

    @property
    def model_with_ranges(self) -> TireModel:
        """``model`` with the ranges of slips, camber, load and pressure that it was fitted to: what to write.

        ``model`` states none. Forces are the same, also outside of the ranges, where their evaluation warns.
        """
        return with_measured_ranges(self.model, self.measured)

    def forces(self, **points: Any) -> TireForces:
        """Return the fitted model's forces.

        Parameters
        ----------
        **points : float or array_like
            As for :meth:`TireModel.forces`: ``slip_angle`` (rad), ``normal_load`` (N) and so on.

        Returns
        -------
        TireForces
            N and N m, of the shape that the arguments broadcast to.
        """
        return self.model.forces(**points)

    def plot(self) -> Figure:
        """Draw measured points with the fitted curves, and the residuals, at pure slip.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        DomainError
            No point is at pure slip.
        """
        from tire_pipeline.magic_formula.fitting.report.plots import draw_fit
        from tire_pipeline.pages.drawing import captioned

        return captioned(*draw_fit(self.model, self.measured))

    def __repr__(self) -> str:
        errors = ", ".join(
            f"{name} not fitted" if name in self.not_fitted else f"{name} {100 * value:.2g}%"
            for name, value in self.relative_rms.items()
        )
        poor = f"; POOR FIT of {', '.join(self.poor)}" if self.poor else ""
        return f"FitResult({self.model!r}; RMS of residuals over the largest magnitude: {errors}{poor})"

    def _repr_html_(self) -> str:
        from tire_pipeline.pages.notebook import card

        rows = [
            (name, f"{self.model.value(name):.6g}", f"{error:.2g}")
            for name, error in self.standard_errors.items()
        ]
        return card(
            repr(self),
            " ".join([*(f"{o}: {t}" for o, t in self.poor.items()), *self.notes]),
            ("coefficient", "value", "standard error"),
            rows,
        )

    def summary(self) -> str:
        """Return the fit in plain text.

        Returns
        -------
        str
            Errors by output, coefficients with their standard errors, and the notes.
        """
        lines = [f"Magic Formula {self.model.version}, FNOMIN = {self.model.value('FNOMIN'):g} N", ""]
        for output, value in self.relative_rms.items():
            if output in self.not_fitted:
                lines.append(f"{output}: measured, but not fitted")
                continue
            lines.append(f"{output}: RMS of residuals {100 * value:.2f}% of the largest magnitude")
            if output in self.poor:
                lines.append(f"{output}: POOR FIT, not to be used: {self.poor[output]}")
        lines += ["", "coefficient        value   standard error"]
        for name, error in self.standard_errors.items():
            lines.append(f"{name:<11} {self.model.value(name):>12.6g}   {error:.2g}")
        if self.undetermined:
            lines += ["", "Not determined by the data:", *(f"- {text}" for text in self.undetermined)]
        if self.notes:
            lines += ["", "Notes:", *(f"- {text}" for text in self.notes)]
        return "\n".join(lines)
