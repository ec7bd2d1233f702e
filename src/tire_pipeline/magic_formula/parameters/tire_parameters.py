"""The coefficients of a tire for one Magic Formula version, without the equations."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Any, Self, TypeVar

import numpy as np

from tire_pipeline.channels import POINT_CHANNELS
from tire_pipeline.errors import TirValueError
from tire_pipeline.magic_formula.parameters.coefficients import (
    INDEX,
    RANGE_KEYS,
    are_moderate,
    check_values,
    family_of,
    missing_defaults,
    pack_mapping,
)
from tire_pipeline.magic_formula.parameters.points import OperatingPoints


@dataclass(frozen=True, eq=False, repr=False)
class TireParameters:
    """The coefficients of a tire, of one version of the Magic Formula.

    Parameters
    ----------
    version : str
        "5.0", "5.1", "5.2", "6.1", "6.2" or "PAC2002".
    coefficients : mapping of str to float
        By their ``.tir`` names in capitals, in SI units: p, q, r and s coefficients, scale factors,
        ``FNOMIN``, ``UNLOADED_RADIUS``, ``LONGVL``, ``NOMPRES``, ranges (``ALPMIN``, ``FZMAX``, ...).
    defaulted : mapping of str to float
        Coefficients that the source lacks, with their default values.
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
        If the version is unknown.
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

    def __deepcopy__(self, memo: dict[int, object]) -> Self:
        return self  # nothing in it changes

    def __reduce__(self) -> tuple[Any, ...]:
        parts = (dict(self.coefficients), dict(self.defaulted), dict(self.metadata))
        return type(self), (self.version, *parts, self.source, self.path)

    def __repr__(self) -> str:
        where = f"{self.path!r}, " if self.path else ""
        return (
            f"{type(self).__name__}({where}version {self.version!r}, FNOMIN = {self.value('FNOMIN'):g} N, "
            f"{len(self.coefficients)} coefficients, {len(self.defaulted)} missing)"
        )

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
    def moderate(self) -> bool:
        """Whether compiled code is right for these coefficients; see :func:`.coefficients.are_moderate`."""
        return bool(are_moderate(self.packed[None, :])[0])

    @cached_property
    def lacks_radius(self) -> bool:
        """Whether there is no ``UNLOADED_RADIUS``: moments are NaN then."""
        return bool(np.isnan(self.packed[INDEX["UNLOADED_RADIUS"]]))

    @cached_property
    def ranges(self) -> dict[str, tuple[str, str, float, float]]:
        """The ranges that the model is valid for: input -> names and values of its two ends."""
        found = {}
        for name, (low_key, high_key) in RANGE_KEYS.items():
            low = self.coefficients.get(low_key, -np.inf)
            high = self.coefficients.get(high_key, np.inf)
            if low < high and np.isfinite([low, high]).any() and (name != "pressure" or self.family == 6):
                found[name] = (low_key, high_key, low, high)
        return found

    @cached_property
    def range_list(self) -> list[tuple[int, float, float]]:
        """The ranges by the place of the input among the arguments, for quick checks."""
        return [(POINT_CHANNELS.index(name), low, high) for name, (*_, low, high) in self.ranges.items()]

    def channels_at(self, points: OperatingPoints) -> tuple[Any, ...]:
        """Return points in the order of ``POINT_CHANNELS``; speed and pressure are the tire's own for None.

        Parameters
        ----------
        points : OperatingPoints
            In ISO W axes, SI.

        Returns
        -------
        tuple of float or ndarray
            MF 5.2 knows no pressure: its is 0.
        """
        normal_load, slip_angle, slip_ratio, camber, speed, pressure, _ = points
        if speed is None:
            speed = self.value("LONGVL")
        if self.family != 6:
            pressure = 0.0
        elif pressure is None:
            pressure = self.value("NOMPRES")
        return slip_angle, slip_ratio, camber, normal_load, speed, pressure

    def value(self, name: str) -> float:
        """Return a coefficient's value, or its default.

        Parameters
        ----------
        name : str
            By ``.tir`` name.

        Returns
        -------
        float
            SI units. A coefficient of another version, which this one has no use for, has its neutral value,
            0 or 1.

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

    def replace(self, **coefficients: float) -> Self:
        """Return the tire with some coefficients changed.

        Parameters
        ----------
        **coefficients : float
            New values by ``.tir`` name, SI units. One that was defaulted is no longer defaulted.

        Returns
        -------
        TireParameters
            Of the class that came in.

        Raises
        ------
        TirValueError
            If a value is not finite, or one that the equations divide by is zero.
        """
        changed = {**self.coefficients, **coefficients}
        left = {k: v for k, v in self.defaulted.items() if k not in coefficients}
        return dataclasses.replace(self, coefficients=changed, defaulted=left)


Tire = TypeVar("Tire", bound=TireParameters)
"""A function that takes a model returns a model."""
