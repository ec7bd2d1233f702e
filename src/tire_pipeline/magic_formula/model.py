"""The tire model: coefficients of one Magic Formula version, and what is asked of them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from tire_pipeline.errors import TirValueError
from tire_pipeline.magic_formula.coefficients import (
    INDEX,
    RANGES,
    check_values,
    family_of,
    missing_defaults,
    pack_mapping,
)
from tire_pipeline.magic_formula.convert import to_version
from tire_pipeline.magic_formula.engine import compiles
from tire_pipeline.magic_formula.forces import TireForces, tire_forces
from tire_pipeline.magic_formula.nominal_load import nominal_load_changed

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False, repr=False)
class TireModel:
    """A Magic Formula tire model.

    Parameters
    ----------
    version : str
        "5.0", "5.1", "5.2", "6.1", "6.2" or "PAC2002".
    coefficients : mapping of str to float
        By their ``.tir`` names in capitals, in SI units: p, q, r and s coefficients, scale factors,
        ``FNOMIN``, ``UNLOADED_RADIUS``, ``LONGVL``, ``NOMPRES``, ranges (``ALPMIN``, ``FZMAX``, ...).
    defaulted : mapping of str to float
        Coefficients that the source lacks, and the value that stands in.
    metadata : mapping of str to object
        What is not a coefficient, by "SECTION.KEY" in SI units: "DIMENSION.WIDTH", "MODEL.TYRESIDE", ...
    source : object, optional
        The file that it came from, as read.
    path : str, optional
        The path of that file.

    Raises
    ------
    TirValueError
        If a coefficient is not a finite number, or has a value that the equations divide by; it names the
        key.
    TirVersionError
        If the version is not known.
    """

    version: str
    coefficients: Mapping[str, float]
    defaulted: Mapping[str, float] = field(default_factory=dict)
    metadata: Mapping[str, object] = field(default_factory=dict)
    source: object | None = field(default=None, repr=False)
    path: str | None = None

    def __post_init__(self) -> None:
        family_of(self.version)
        check_values(self.coefficients, self.path)
        values = {key: float(value) for key, value in self.coefficients.items()}
        missing = missing_defaults(values, self.version)
        missing.update({key: value for key, value in self.defaulted.items() if key not in values})
        object.__setattr__(self, "coefficients", MappingProxyType(values))
        object.__setattr__(self, "defaulted", MappingProxyType(missing))
        object.__setattr__(self, "metadata", MappingProxyType(dict(self.metadata)))

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

    def __deepcopy__(self, memo: dict[int, object]) -> TireModel:
        return self  # nothing in it changes

    def __reduce__(self) -> tuple[Any, ...]:
        parts = (dict(self.coefficients), dict(self.defaulted), dict(self.metadata))
        return TireModel, (self.version, *parts, self.source, self.path)

    def __repr__(self) -> str:
        where = f"{self.path!r}, " if self.path else ""
        return (
            f"TireModel({where}version {self.version!r}, FNOMIN = {self.value('FNOMIN'):g} N, "
            f"{len(self.coefficients)} coefficients, {len(self.defaulted)} missing)"
        )

    def _repr_html_(self) -> str:
        from tire_pipeline.magic_formula.key_figures import key_figures
        from tire_pipeline.notebook import card

        rows = [(figure.name, f"{figure.value:.4g}", figure.unit) for figure in key_figures(self)]
        return card(repr(self), "At the nominal load, without camber:", ("", "value", "unit"), rows)

    @cached_property
    def family(self) -> int:
        """5 for the equations of MF 5.2, 6 for those of MF 6.1 and 6.2."""
        return family_of(self.version)

    @cached_property
    def packed(self) -> np.ndarray:
        """All coefficients as one read-only vector, in the order of ``COEFFICIENT_NAMES``."""
        vector = pack_mapping(self.coefficients, self.defaulted)
        vector.flags.writeable = False
        return vector

    @cached_property
    def simple(self) -> bool:
        """Whether compiled code is there for this model."""
        return compiles(self.packed[None, :])

    @cached_property
    def lacks_radius(self) -> bool:
        """Whether there is no ``UNLOADED_RADIUS``: moments are NaN then."""
        return bool(np.isnan(self.packed[INDEX["UNLOADED_RADIUS"]]))

    @cached_property
    def ranges(self) -> dict[str, tuple[str, str, float, float]]:
        """The ranges that the model is valid for: input -> names and values of its two ends."""
        found = {}
        for name, (low_key, high_key) in RANGES.items():
            low = self.coefficients.get(low_key, -np.inf)
            high = self.coefficients.get(high_key, np.inf)
            if low < high and np.isfinite([low, high]).any() and (name != "pressure" or self.family == 6):
                found[name] = (low_key, high_key, low, high)
        return found

    @cached_property
    def range_list(self) -> list[tuple[int, float, float]]:
        """The ranges by the place of the input among the arguments, for quick checks."""
        order = ("slip_angle", "slip_ratio", "camber", "normal_load", "speed", "pressure")
        return [(order.index(name), low, high) for name, (*_, low, high) in self.ranges.items()]

    def value(self, name: str) -> float:
        """Return a coefficient's value, or what stands in for it.

        A coefficient of another version, which this one has no use for, has its neutral value, 0 or 1.

        Raises
        ------
        TirValueError
            If the model has no such coefficient.
        """
        if name in self.coefficients:
            return self.coefficients[name]
        if name in self.defaulted:
            return self.defaulted[name]
        if name in INDEX:
            return float(self.packed[INDEX[name]])
        raise TirValueError(f"the model has no coefficient {name}", key=name, path=self.path)

    def forces(
        self,
        *,
        normal_load: Any,
        slip_angle: Any = 0.0,
        slip_ratio: Any = 0.0,
        camber: Any = 0.0,
        speed: Any = None,
        pressure: Any = None,
        turn_slip: Any = 0.0,
        side: str | None = None,
        axes: str = "ISO",
        limits: str = "warn",
        outputs: Any = None,
    ) -> TireForces:
        """Return forces, moments and what belongs to them at operating points.

        Parameters
        ----------
        normal_load : float or array_like
            Vertical load (N). A load of zero or less gives zero everywhere.
        slip_angle, slip_ratio, camber : float or array_like
            Slip angle (rad), longitudinal slip (-1 is a locked wheel), camber (rad).
        speed : float or array_like, optional
            Forward speed (m/s), for the rolling resistance; ``LONGVL`` if left out.
        pressure : float or array_like, optional
            Inflation pressure (Pa); the nominal one if left out. Only MF 6.1 and 6.2 use it.
        turn_slip : float or array_like
            Curvature of the path (1/m). 0 everywhere switches the turn slip equations off. Only MF 6.1 and
            6.2.
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
            normal_load=normal_load,
            slip_angle=slip_angle,
            slip_ratio=slip_ratio,
            camber=camber,
            speed=speed,
            pressure=pressure,
            turn_slip=turn_slip,
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
        from tire_pipeline.drawing import captioned
        from tire_pipeline.magic_formula.plots import draw_models

        return captioned(*draw_models({self.path or "tire": self}, loads=loads, camber=camber))

    def replace(self, **coefficients: float) -> TireModel:
        """Return a model with some coefficients changed.

        A coefficient that was defaulted and is set here is no longer defaulted.
        """
        changed = {**self.coefficients, **coefficients}
        left = {k: v for k, v in self.defaulted.items() if k not in coefficients}
        return dataclasses.replace(self, coefficients=changed, defaulted=left)

    def nominal_load_changed(self, new: float) -> TireModel:
        """Return the same tire with another nominal load; see :func:`.nominal_load.nominal_load_changed`."""
        return nominal_load_changed(self, new)

    def to_version(self, version: str) -> TireModel:
        """Return the tire as a model of another version; see :func:`.convert.to_version`."""
        return to_version(self, version)

    def jacobian(self, names: Sequence[str], **points: Any) -> dict[str, np.ndarray]:
        """Return the derivatives of forces with respect to coefficients; see :func:`.jacobian.jacobian`."""
        from tire_pipeline.magic_formula.jacobian import jacobian

        return jacobian(self, names, **points)
