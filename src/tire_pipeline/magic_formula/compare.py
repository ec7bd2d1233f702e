"""Differences between two tire models."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tire_pipeline.channels import SLIP_OF_FORCE
from tire_pipeline.magic_formula.key_figures import slip_range, usual_loads
from tire_pipeline.magic_formula.model import TireModel


@dataclass(frozen=True)
class Difference:
    """Difference of one force or moment between two models, at pure slip.

    Attributes
    ----------
    output : str
        ``fx``, ``fy`` or ``mz``.
    rms, largest : float
        N or N m.
    share : float
        RMS over the first model's largest magnitude; NaN if either model has no such force.
    opposite : bool
        Whether the second model's curves have the other sign: it is in other axes.
    lacking : tuple of bool
        Whether the force is zero throughout in the first model, and in the second one.
    """

    output: str
    rms: float
    largest: float
    share: float
    opposite: bool
    lacking: tuple[bool, bool]


def compare_models(
    first: TireModel, second: TireModel, *, loads: Sequence[float] | None = None, camber: float = 0.0
) -> list[Difference]:
    """Compare forces at pure slip where both models are valid.

    Parameters
    ----------
    first, second : TireModel
    loads : sequence of float, optional
        N; half, one and one and a half times the mean nominal load if left out.
    camber : float
        rad.

    Returns
    -------
    list of Difference
        Of ``fy`` and ``mz`` over slip angle, and ``fx`` over slip ratio.

    Examples
    --------
    >>> from tire_pipeline.magic_formula import TireModel
    >>> tire = TireModel.from_coefficients(
    ...     {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}
    ... )
    >>> compare_models(tire, tire.replace(LMUY=0.9))[0].output
    'fy'
    """
    loads = usual_loads([first, second]) if loads is None else list(loads)
    return [_difference(first, second, output, slip, loads, camber) for output, slip in SLIP_OF_FORCE.items()]


def changed_values(first: TireModel, second: TireModel) -> list[tuple[str, float, float]]:
    """Return the coefficients that differ, with both values; NaN where a model does not use it."""
    names = dict.fromkeys([*first.coefficients, *second.coefficients])
    pairs = [(name, _value(first, name), _value(second, name)) for name in names]
    return [(n, a, b) for n, a, b in pairs if not (a == b or (np.isnan(a) and np.isnan(b)))]


def _value(model: TireModel, name: str) -> float:
    if name in model.coefficients:
        return model.coefficients[name]
    return float(model.defaulted.get(name, np.nan))


def _difference(
    first: TireModel, second: TireModel, output: str, slip: str, loads: Sequence[float], camber: float
) -> Difference:
    own, other = slip_range(first, slip), slip_range(second, slip)
    x = np.linspace(max(own[0], other[0]), min(own[-1], other[-1]), own.size)
    points: dict[str, Any] = {slip: x[None, :], "normal_load": np.asarray(loads)[:, None], "camber": camber}
    a, b = (
        np.asarray(getattr(m.forces(**points, limits="ignore", outputs=(output,)), output))
        for m in (first, second)
    )
    apart = b - a
    size = float(np.max(np.abs(a)))
    lacking = (not np.any(a), not np.any(b))
    rms = float(np.sqrt(np.mean(apart**2)))
    return Difference(
        output,
        rms,
        float(np.max(np.abs(apart))),
        float("nan") if any(lacking) else rms / size,
        bool(np.sum(a * b) < 0.0),
        lacking,
    )
