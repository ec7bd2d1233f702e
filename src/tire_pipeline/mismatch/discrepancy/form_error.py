"""Errors in the form of an effect: columns in proportion to its own part of the force."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tire_pipeline.channels import SLIP_OF_FORCE
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.channels import used
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate

Array = np.ndarray
_TIME_KNOTS = 12
"""Moments, over the whole recording, at which the wheel's angle may have drifted by any amount."""
USUAL_FORM_ERROR = 0.15
"""How wrong a form usually is, as a share of it: what half a sample of shift is measured by."""
_IMAGINED = 4.0
"""Times as wrong as usual where an effect's driver was not recorded and is simulated: friction power behind
the best single lag (5 s) explains 0.40 of the variance of calspan's recorded tread temperature."""
_WHEEL_ANGLE_DRIFT = 2.0
"""The wheel's angle is integrated from a speed with noise, and drifts: by so many radians times
``USUAL_FORM_ERROR`` (standard deviation) about each of so many moments."""


def shape_columns(data: Data, changes: Sequence[Change], index: int) -> dict[str, Array]:
    """Columns for errors in the form of an accepted effect.

    Its own part times own inputs, and what other forms of it would do instead.
    """
    whole = simulate(data, changes)
    without = simulate(data, [c for j, c in enumerate(changes) if j != index])
    name, found = changes[index]
    effect = catalogue()[name]

    def instead(form: dict[str, float]) -> dict[str, Array]:
        return simulate(data, [*changes[:index], (name, form), *changes[index + 1 :]])

    others = [instead(form) for form in effect.other_forms(data, found)]
    later = effect.quarter_turn(found)
    ahead, hats = (instead(later), _hats(data)) if later else (None, [])
    load = data.nominal.load_excess(data.get("normal_load"))
    load = load / max(float(np.max(np.abs(load))), 1e-9)
    out = {}
    for o in data.outputs:
        part = whole[o] - without[o]
        use = used(data.get(SLIP_OF_FORCE[o]))
        use = 2.0 * use / max(float(use.max()), 1e-9) - 1.0
        columns = [part * use, part * load, part * (2.0 * use**2 - 1.0), part * use * load, part]
        columns = [_IMAGINED * column for column in columns] if effect.blind(data) else columns
        if effect.dynamic:
            shift = 0.5 / USUAL_FORM_ERROR
            columns += [shift * _change(data, whole[o]), shift * _change(data, part)]
        columns += [other[o] - whole[o] for other in others]
        if ahead is not None:
            columns += [_WHEEL_ANGLE_DRIFT * (ahead[o] - without[o]) * hat for hat in hats]
        out[o] = np.column_stack(columns)
    return out


def _hats(data: Data) -> list[Array]:
    """Triangles over time whose sum is one."""
    time = data.time
    assert time is not None  # asked only of effects that need a time line
    knots = np.linspace(time[0], time[-1] + 1e-9, _TIME_KNOTS)
    return [np.interp(time, knots, row) for row in np.eye(_TIME_KNOTS)]


def _change(data: Data, x: Array) -> Array:
    """Change of a force over one sample: what half a sample of time shift could do, twice."""
    d = np.zeros_like(x)
    d[1:-1] = 0.5 * (x[2:] - x[:-2])
    d[data.start] = 0.0
    d[np.flatnonzero(data.start)[1:] - 1] = 0.0
    return d
