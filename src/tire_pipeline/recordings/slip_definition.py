"""How a slip ratio was defined: the wheel's speed beside the road's tells, else the force at no slip."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
import pandas as pd

from tire_pipeline.magic_formula.fitting.setup.measured import locked_parts
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import PURE_SLIP_ANGLE, PURE_SLIP_RATIO
from tire_pipeline.magic_formula.fitting.setup.unlike_tires import MOST_ROLLING_RESISTANCE, braked_at_no_slip
from tire_pipeline.numerics.independent_rows import rows_of_one
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.recordings.issue import Issue
from tire_pipeline.recordings.physical_signs import FEWEST_ROWS, STRAIGHT

Array = np.ndarray

_SURE = 2.0
"""Standard errors."""
_BY_EFFECTIVE_RADIUS, _BY_LOADED_RADIUS, _BY_UNKNOWN_RADIUS = "effective_radius", "loaded_radius", ""


class _SlipForm(NamedTuple):
    """A definition of the slip ratio: of s = w R / V - 1 and back, in words, and what makes it s."""

    of: Callable[[Array], Array]
    back: Callable[[Array], Array]
    words: str
    todo: str


_SLIP_FORMS = (
    _SlipForm(lambda s: s, lambda x: x, "", ""),
    _SlipForm(lambda s: -s, lambda x: -x, "1 - {}", "turn its sign: driving is positive here"),
    _SlipForm(lambda s: s + 1.0, lambda x: x - 1.0, "{}", "subtract 1"),
    _SlipForm(
        lambda s: s / (1.0 + s),
        lambda x: x / (1.0 - x),
        "1 - 1 / ({})",
        "it is over the wheel's speed; over the road's speed, as here, it is slip_ratio / (1 - slip_ratio)",
    ),
)


def slip_ratio_defined_otherwise(frame: pd.DataFrame) -> list[Issue]:
    """Report a slip ratio that does not count from free rolling, over the road's speed, driving positive.

    One that is missing is reported where the wheel braked or was driven.

    Parameters
    ----------
    frame : DataFrame
        Canonical columns.
    """
    held = pd.DataFrame(frame, copy=False).items()  # without attrs: pandas copies them
    columns = {str(n): x.to_numpy(dtype=float) for n, x in held if pd.api.types.is_numeric_dtype(x)}
    slip = columns.get("slip_ratio")
    if slip is None or not np.any(slip):
        return _braked(columns)
    if locked_parts(frame, slip):
        return []
    return _by_speeds(columns) or _by_force(columns)


def _braked(columns: Mapping[str, Array]) -> list[Issue]:
    """Report a wheel that braked without a slip ratio: it would count as one that rolls freely."""
    if not {"fx", "normal_load"} <= set(columns):
        return []
    where = braked_at_no_slip(columns["normal_load"], columns["fx"])
    todo = (
        "record slip_ratio, or wheel_speed and effective_radius; or leave out the rows of braking and driving"
    )
    return [Issue("braked_at_no_slip", "warning", where, todo)] if where else []


def _by_speeds(columns: Mapping[str, Array]) -> list[Issue]:
    """Report which slip ratio the wheel's speed, the road's speed and a radius give.

    The definition is the one with the largest likelihood, less what parameters cost (Schwarz 1978): another
    form or radius than usual counts as one, and so does the value of a radius that nobody recorded.
    """
    if not {"wheel_speed", "speed"} <= set(columns):
        return []
    slip, turns = columns["slip_ratio"], columns["wheel_speed"]
    with np.errstate(divide="ignore", invalid="ignore"):
        turns = np.abs(turns) / np.abs(columns["speed"])
    radii = {
        n: columns[n]
        for n in (_BY_EFFECTIVE_RADIUS, _BY_LOADED_RADIUS)
        if n in columns and np.isfinite(columns[n]).any()
    }
    good = np.isfinite(slip) & np.isfinite(turns) & (turns > 0.0)
    good &= np.all([np.isfinite(r) & (r > 0.0) for r in radii.values()], axis=0)
    slip, turns = slip[good], turns[good]
    if not radii or slip.size < FEWEST_ROWS or np.ptp(slip) == 0.0:
        return []
    known = {n: r[good] for n, r in radii.items()}
    return _said([each for form in _SLIP_FORMS for each in _kinds(form, slip, turns, known)], slip)


class _SlipDefinition(NamedTuple):
    """A definition of the slip ratio: its form, the radius in it, and what it leaves."""

    form: _SlipForm
    radius: str
    left: Array


def _kinds(form: _SlipForm, slip: Array, turns: Array, radii: Mapping[str, Array]) -> list[_SlipDefinition]:
    """Return one form with each radius, and with the constant one that fits best."""
    with np.errstate(divide="ignore", invalid="ignore"):
        rolls = 1.0 + form.back(slip)
        constant = np.full(slip.size, float(turns @ rolls) / float(turns @ turns))
        every = {_BY_UNKNOWN_RADIUS: constant, **radii}
        found = [_SlipDefinition(form, n, slip - form.of(turns * r - 1.0)) for n, r in every.items()]
    return [each for each in found if np.isfinite(each.left).all()]


def _said(found: list[_SlipDefinition], slip: Array) -> list[Issue]:
    """Report the best of the definitions, if it is not the usual one."""
    best = min(found, key=lambda each: float(each.left @ each.left))
    number = best.left.size / rows_of_one(best.left)
    least = float(np.finfo(float).eps) * float(np.mean(slip**2))

    def cost(each: _SlipDefinition) -> float:
        unusual = (
            (each.form is not _SLIP_FORMS[0])
            + (each.radius != _BY_EFFECTIVE_RADIUS)
            + (each.radius == _BY_UNKNOWN_RADIUS)
        )
        return number * float(np.log(max(np.mean(each.left**2), least))) + unusual * float(np.log(number))

    form, radius, left = min(found, key=cost)
    if form is _SLIP_FORMS[0] and radius != _BY_LOADED_RADIUS:
        return []
    of = f"wheel_speed x {radius or 'a radius'} / speed"
    what = form.words.format(of) if form.words else f"{of} - 1"
    where = f"slip_ratio, which is {what}, within {in_digits(float(np.sqrt(np.mean(left**2))))} RMS"
    todo = [form.todo] if form.todo else []
    if radius == _BY_LOADED_RADIUS:
        todo.append(
            "by the loaded radius it is not zero at free rolling, from where the Magic Formula counts: use "
            "the slip ratio by the effective radius"
        )
    return [Issue("slip_ratio_defined_otherwise", "warning", where, "; ".join(todo))]


def _by_force(columns: Mapping[str, Array]) -> list[Issue]:
    """Report a force at no slip that is no rolling resistance, and one that falls with the slip."""
    if not {"fx", "normal_load"} <= set(columns):
        return []
    slip, load, fx = (columns[name] for name in ("slip_ratio", "normal_load", "fx"))
    angle = columns.get("slip_angle", np.zeros(slip.size))
    good = np.isfinite(slip) & np.isfinite(fx) & (np.abs(load) > 0.0) & (np.abs(angle) <= PURE_SLIP_ANGLE)
    good &= np.abs(slip) <= PURE_SLIP_RATIO
    slip, share = slip[good], fx[good] / np.abs(load[good])
    if slip.size < FEWEST_ROWS or np.ptp(slip) == 0.0:
        return []
    line = np.vander(slip, 3, increasing=True)
    (level, slope, bend), _, rank, _ = np.linalg.lstsq(line, share, rcond=None)
    left = share - line @ np.array([level, slope, bend])
    if rank < line.shape[1] or float(left @ left) > (1.0 - STRAIGHT) * float(np.var(share)) * share.size:
        return []
    if slope < 0.0:
        todo = "no tire brakes where its wheel turns faster than the road: turn the sign of slip_ratio or fx"
        return [Issue("fx_of_other_sign", "warning", "fx, which falls with slip_ratio", todo)]
    freedom = slip.size / rows_of_one(left)
    error = float(np.sqrt(left @ left / slip.size / freedom * np.linalg.inv(line.T @ line / slip.size)[0, 0]))
    if abs(level) - _SURE * error <= MOST_ROLLING_RESISTANCE:
        return []
    where = f"fx, {in_digits(float(level))} of the load at a slip_ratio of 0"
    todo = (
        "a wheel that rolls freely has its rolling resistance only: fx has an offset, or slip_ratio has one, "
        "as by the loaded radius; the Magic Formula counts from free rolling"
    )
    return [Issue("force_at_no_slip", "warning", where, todo)]
