"""Forces and moments at operating points: arguments in, arrays out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from tire_pipeline.errors import TirValueError
from tire_pipeline.magic_formula import inputs, numpy_form
from tire_pipeline.magic_formula.axes import Signs, is_mirrored, signs_of
from tire_pipeline.magic_formula.numpy_form import OUTPUTS

if TYPE_CHECKING:
    from tire_pipeline.magic_formula.model import TireModel


@dataclass(frozen=True)
class TireForces:
    """What the contact patch transmits, and what the model says on the way. None: not asked for.

    Attributes
    ----------
    fx, fy : float or ndarray
        Longitudinal and lateral force (N).
    mx, my, mz : float or ndarray
        Overturning, rolling resistance and aligning moment (N m).
    trail : float or ndarray
        Pneumatic trail (m).
    friction_x, friction_y : float or ndarray
        Peak friction coefficients mu_x and mu_y.
    cornering_stiffness : float or ndarray
        K_y, slope of the side force over the slip angle (N/rad); negative in ISO W axes.
    slip_stiffness : float or ndarray
        K_x, slope of the longitudinal force over the slip ratio (N).
    relaxation_lateral, relaxation_longitudinal : float or ndarray
        Relaxation lengths (m).
    """

    fx: Any = None
    fy: Any = None
    mx: Any = None
    my: Any = None
    mz: Any = None
    trail: Any = None
    friction_x: Any = None
    friction_y: Any = None
    cornering_stiffness: Any = None
    slip_stiffness: Any = None
    relaxation_lateral: Any = None
    relaxation_longitudinal: Any = None


def tire_forces(
    model: TireModel,
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
    outputs: Sequence[str] | None = None,
) -> TireForces:
    """Evaluate a tire model; see :meth:`TireModel.forces`."""
    wanted = _wanted(outputs)
    signs = signs_of(axes, is_mirrored(side, model.metadata.get("MODEL.TYRESIDE")))
    given = {
        "slip_angle": slip_angle,
        "slip_ratio": slip_ratio,
        "camber": camber,
        "normal_load": normal_load,
        "speed": model.value("LONGVL") if speed is None else speed,
    }
    if model.family == 6:
        given["pressure"] = model.value("NOMPRES") if pressure is None else pressure
        given["turn_slip"] = turn_slip
    arrays, shape = inputs.as_float_arrays(given)
    for name in ("slip_angle", "camber", "turn_slip"):
        if name in arrays and getattr(signs, name) < 0:
            arrays[name] = -arrays[name]
    arrays = inputs.apply_limits(arrays, model.coefficients, limits)
    turn = arrays.get("turn_slip")
    results = numpy_form.evaluate(
        model.packed,
        model.family,
        arrays["slip_angle"],
        arrays["slip_ratio"],
        arrays["camber"],
        arrays["normal_load"],
        arrays["speed"],
        arrays.get("pressure", 0.0),
        turn if turn is not None and np.any(turn) else None,
    )
    return _as_forces(results, shape, signs, wanted)


def _wanted(outputs: Sequence[str] | None) -> tuple[str, ...]:
    if outputs is None:
        return OUTPUTS
    unknown = [name for name in outputs if name not in OUTPUTS]
    if unknown:
        raise TirValueError(
            f"outputs {unknown} are not known", key="outputs", todo=f"use some of {list(OUTPUTS)}"
        )
    return tuple(outputs)


def _as_forces(
    results: Sequence[np.ndarray], shape: tuple[int, ...], signs: Signs, wanted: Sequence[str]
) -> TireForces:
    values = {}
    for name, value in zip(OUTPUTS, results, strict=True):
        if name not in wanted:
            continue
        sign = getattr(signs, name, 1.0)
        if name == "cornering_stiffness":
            sign = signs.fy * signs.slip_angle
        value = np.broadcast_to(value, shape)
        value = -value if sign < 0 else np.array(value)
        values[name] = value if shape else value[()]
    return TireForces(**values)
