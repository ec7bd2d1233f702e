"""The tire model: a tire's coefficients, with its forces, derivatives and conversions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Unpack

import numpy as np

from tire_pipeline.channels import PLANE_FORCES
from tire_pipeline.magic_formula.changes.convert import to_version
from tire_pipeline.magic_formula.changes.nominal_load import nominal_load_changed
from tire_pipeline.magic_formula.derivatives.jacobian import jacobian
from tire_pipeline.magic_formula.forces import TireForces, tire_forces
from tire_pipeline.magic_formula.key_figures import key_figures
from tire_pipeline.magic_formula.parameters.coefficients import (
    EXTENSIONS_6,
    INDEX,
    NAMES_BY_FAMILY,
    family_of,
    is_possible,
    missing_defaults,
)
from tire_pipeline.magic_formula.parameters.points import OperatingPoints, PointFields, points_of
from tire_pipeline.magic_formula.parameters.tire_parameters import TireParameters

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class TireModel(TireParameters):
    """A Magic Formula tire model. It does not change.

    Parameters
    ----------
    version : str
        "5.0", "5.1", "5.2", "6.1", "6.2" or "PAC2002".
    coefficients : mapping of str to float
        By their ``.tir`` names in capitals, in SI units.
    defaulted : mapping of str to float
        Coefficients that the source lacks, with their default values.
    metadata : mapping of str to object
        What is not a coefficient, by "SECTION.KEY" in SI units.
    source : object, optional
        The file that it came from, as read.
    path : str, optional
        The path of that file.

    See Also
    --------
    OperatingPoints : Where it is evaluated.
    tire_pipeline.tir.read_tir : Read one from a file.

    Notes
    -----
    MF 5.2, PAC2002, 5.0 and 5.1: Appendix A of the thesis. MF 6.1 and 6.2: Pacejka, Tire and Vehicle
    Dynamics, 3rd edition, section 4.3.2.

    Examples
    --------
    >>> tire = TireModel.from_coefficients({"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2})
    >>> tire.value("PDY1"), tire.family
    (1.0, 5)
    """

    @classmethod
    def from_coefficients(
        cls,
        coefficients: Mapping[str, float],
        version: str = "5.2",
        metadata: Mapping[str, object] | None = None,
    ) -> TireModel:
        """Build a model without a file.

        Parameters
        ----------
        coefficients : mapping of str to float
            By ``.tir`` name, SI units. ``FNOMIN`` must be there; what else is missing is filled in and
            listed in ``defaulted`` (scale factors 1, PKY4 2, QSY7 1, ``UNLOADED_RADIUS`` NaN, others 0).
        version : str
        metadata : mapping, optional

        Returns
        -------
        TireModel
        """
        return cls(version=version, coefficients=dict(coefficients), metadata=metadata or {})

    def _repr_html_(self) -> str:
        from tire_pipeline.pages.notebook import card
        from tire_pipeline.pages.numbers_in_words import in_digits

        rows = [(figure.name, in_digits(figure.value), figure.unit) for figure in key_figures(self)]
        return card(repr(self), "At the nominal load, without camber:", ("", "value", "unit"), rows)

    def forces(
        self,
        points: OperatingPoints | None = None,
        *,
        side: str | None = None,
        axes: str = "ISO",
        limits: str = "warn",
        outputs: Sequence[str] | None = None,
        **channels: Unpack[PointFields],
    ) -> TireForces:
        """Return forces, moments and related results at operating points.

        Parameters
        ----------
        points : OperatingPoints, optional
            Where to evaluate; or pass its fields by keyword:
        **channels : float or array_like
            ``normal_load`` (N), ``slip_angle`` (rad), ``slip_ratio``, ``camber`` (rad), ``speed`` (m/s),
            ``pressure`` (Pa), ``turn_slip`` (1/m); see :class:`.OperatingPoints`.
        side : {None, "left", "right"}
            The side to mount the tire on: if it is not the side it was measured for (``TYRESIDE``, left
            where it is missing), slip angle, camber, Fy, Mx and Mz are mirrored. None: the tire as it was
            measured.
        axes : {"ISO", "SAE", "adapted SAE"}
            Axis system of arguments and results.
        limits : {"warn", "clip", "raise", "ignore"}
            What to do with points outside the model's ranges: warn with their count and evaluate them as
            they are, clip them, raise, or nothing.
        outputs : sequence of str, optional
            Compute only these fields of the result.

        Returns
        -------
        TireForces
            Fields of the shape that the arguments broadcast to; scalars for scalars.

        Raises
        ------
        TirShapeError
            If the arguments do not broadcast.
        TirValueError
            If an argument is not numeric or an option is not known, or with ``limits="raise"``.

        Warns
        -----
        MissingRadiusWarning
            If outputs are NaN because the model has no ``UNLOADED_RADIUS``.

        Notes
        -----
        MF 5.2, PAC2002, 5.0 and 5.1: Appendix A of the thesis. MF 6.1 and 6.2: Pacejka, Tire and Vehicle
        Dynamics, 3rd edition, section 4.3.2, with MF-Tyre's conventions. docs/explanation/magic_formula.md
        names every deviation.

        Examples
        --------
        >>> tire = TireModel.from_coefficients(
        ...     {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}
        ... )
        >>> round(float(tire.forces(slip_angle=0.05, normal_load=4000).fy), 1)
        -2629.0
        """
        return tire_forces(
            self,
            points_of(points, channels),
            side=side,
            axes=axes,
            limits=limits,
            outputs=outputs,
        )

    def plot(self, *, loads: Sequence[float] | None = None, camber: float = 0.0) -> Figure:
        """Draw Fy, Fx and Mz over slip and the cornering stiffness over load.

        Parameters
        ----------
        loads : sequence of float, optional
            Normal loads (N); half, one and one and a half nominal loads if left out.
        camber : float
            rad.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from tire_pipeline.magic_formula.plots import draw_models
        from tire_pipeline.pages.drawing import captioned

        return captioned(*draw_models({self.path or "tire": self}, loads=loads, camber=camber))

    def nominal_load_changed(self, new: float) -> TireModel:
        """Return the same tire with another nominal load: the same forces and moments at every load.

        Parameters
        ----------
        new : float
            The new ``FNOMIN``, N.

        Returns
        -------
        TireModel
            Coefficients that are relative to the nominal load change.

        Raises
        ------
        TirValueError
            If ``new`` is not positive.
        """
        return nominal_load_changed(self, new)

    def to_version(self, version: str) -> TireModel:
        """Return the tire as a model of another version.

        Parameters
        ----------
        version : str
            5.0, 5.1, 5.2 and PAC2002 convert into one another, so do 6.1 and 6.2, and each of the former into
            the latter.

        Returns
        -------
        TireModel
            From 5.2 to 6.1 forces and moments stay as they are at every point; :func:`conversion_notes` says
            what does not.

        Raises
        ------
        TirVersionError
            From 6.1 or 6.2 to an older version, or for an unknown version.
        TirValueError
            If ``LMX`` is 0.
        """
        return to_version(self, version)

    def jacobian(
        self,
        names: Sequence[str],
        points: OperatingPoints | None = None,
        *,
        outputs: Sequence[str] = PLANE_FORCES,
        out: Mapping[str, np.ndarray] | None = None,
        **channels: Unpack[PointFields],
    ) -> dict[str, np.ndarray]:
        """Return the derivatives of forces with respect to coefficients.

        Parameters
        ----------
        names : sequence of str
            Coefficients, by ``.tir`` name; zeros for one that an output does not depend on.
        points : OperatingPoints, optional
            Where to evaluate, in ISO W axes; or pass its fields by keyword. Ranges are not checked.
        outputs : sequence of str
            Some of "fx", "fy", "mx", "my", "mz".
        out : mapping of str to ndarray of shape (len(names), number of points), optional
            Arrays to write each output's derivatives into, which saves allocating new ones.
        **channels : float or array_like
            As for :meth:`forces`, without ``turn_slip``.

        Returns
        -------
        dict of str to ndarray of shape (*shape of the points, len(names))
            N or N m per unit of the coefficient.

        Raises
        ------
        TirValueError
            For a name that is not a coefficient, an output without derivatives, or points with turn slip.
        TirShapeError
            If the arguments do not broadcast.
        """
        return jacobian(self, names, points_of(points, channels), outputs=outputs, out=out)


def model_of(vector: np.ndarray, version: str, metadata: Mapping[str, object] | None = None) -> TireModel:
    """Return the tire model of a packed vector.

    Parameters
    ----------
    vector : ndarray of shape (len(COEFFICIENT_NAMES),)
        Coefficients in the order of ``COEFFICIENT_NAMES``, SI units.
    version : str
        "5.0", "5.1", "5.2", "6.1", "6.2" or "PAC2002".
    metadata : mapping of str to object, optional
        What is not a coefficient, by "SECTION.KEY".

    Returns
    -------
    TireModel
        Without a source: writing it makes a new file.

    Raises
    ------
    TirValueError
        If a coefficient is not finite, or has a value that the equations divide by.
    TirVersionError
        If the version is unknown.

    See Also
    --------
    pack : The way there.

    Notes
    -----
    What has its neutral value and no model may state, such as a radius of NaN, is missing in the model.

    Examples
    --------
    >>> from tire_pipeline.magic_formula import TireModel, pack
    >>> tire = TireModel.from_coefficients(
    ...     {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}
    ... )
    >>> model_of(pack(tire), "5.2").value("PDY1")
    1.0
    """
    used = NAMES_BY_FAMILY[family_of(version)]
    given = {name: float(vector[INDEX[name]]) for name in used}
    neutral = missing_defaults({}, version)
    coefficients = {  # what no model may state and only stands in is missing: a radius of NaN, PCX1 = 0
        name: value
        for name, value in given.items()
        if is_possible(name, value) or not np.array_equal(value, neutral[name], equal_nan=True)
    }
    extensions = {name: float(vector[INDEX[name]]) for name in EXTENSIONS_6}
    coefficients.update({name: value for name, value in extensions.items() if value != 0})
    return TireModel.from_coefficients(coefficients, version, metadata)
