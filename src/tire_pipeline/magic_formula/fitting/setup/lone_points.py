"""Points whose force is unlike that of all points around them: a wrong sign, digit or row of a table."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import scipy

from tire_pipeline.channels import FORCE_OF_SLIP, SLIP_AND_LOAD
from tire_pipeline.numerics.outliers import unlike_neighbours

Array = np.ndarray
_ENOUGH_POINTS = 2000
_ROUGHLY = 0.05
"""What a rough curve leaves of a tire's forces, over the largest: from there a residual counts less."""


def without_lone_points(
    points: Mapping[str, Array], forces: Mapping[str, Array]
) -> tuple[dict[str, Array], list[str]]:
    """Return the forces with NaN at lone points, and what is said of these.

    A fit goes where its squared residual is least: one turned sign among 111 points of a real tire left 1,269
    N at the others, and 63 N without it.

    Parameters
    ----------
    points : mapping of ndarray, shape (n,)
        Slips, camber and load, SI.
    forces : mapping of ndarray, shape (n,)
        N, N m; NaN where nothing was measured.

    Returns
    -------
    forces : dict of ndarray
    remarks : list of str
        Force, value, and row among those that were given, of each.
    """
    out, remarks = dict(forces), []
    for slip, name in FORCE_OF_SLIP.items():
        if name not in forces:
            continue
        rows = np.flatnonzero(np.isfinite(forces[name]))
        here, force = {n: points[n][rows] for n in SLIP_AND_LOAD}, forces[name][rows]
        rest = force - _rough_force(here, force, slip)
        lone = rows[unlike_neighbours(rest, np.column_stack([here[n] for n in SLIP_AND_LOAD]))]
        if lone.size:
            out[name] = forces[name].copy()
            out[name][lone] = np.nan
        remarks += [
            f"{name}: {forces[name][i]:,.0f} N at {_said(points, slip, i)} is unlike the points around it "
            "(left out)"
            for i in lone
        ]
    return out, remarks


def _said(points: Mapping[str, Array], slip: str, row: int) -> str:
    value = np.degrees(points[slip][row]) if slip == "slip_angle" else points[slip][row]
    unit = " deg" if slip == "slip_angle" else ""
    return f"{slip} {value:.3g}{unit}, normal_load {points['normal_load'][row]:,.0f} N, row {row},"


def _rough_force(points: Mapping[str, Array], force: Array, slip: str) -> Array:
    """Return a curve of six numbers through most of the points, N: friction, stiffness, shift, camber, load
    and the other slip."""
    load, camber = points["normal_load"], points["camber"]
    (other,) = (points[n] for n in FORCE_OF_SLIP if n != slip)
    own, usual = points[slip], max(float(np.median(load)), 1e-9)
    largest = max(float(np.quantile(np.abs(force), 0.9)), 1e-9) if force.size else 1.0

    def curve(p: Array, rows: Array | slice) -> Array:
        level = p[0] * (1.0 + p[4] * (load[rows] / usual - 1.0)) * np.tanh(p[1] * own[rows])
        level = level + p[2] + p[3] * camber[rows]
        return np.asarray(load[rows] * level / np.sqrt(1.0 + (p[5] * other[rows]) ** 2))

    some = np.linspace(0, force.size - 1, min(force.size, _ENOUGH_POINTS)).round().astype(int)
    turned = np.sign(np.median(np.sign(own * force))) or 1.0
    found = scipy.optimize.least_squares(
        lambda p: (curve(p, some) - force[some]) / largest,
        (turned, 15.0, 0.0, 0.0, 0.0, 0.0),
        loss="cauchy",
        f_scale=_ROUGHLY,
        max_nfev=100,
    )
    return curve(found.x, slice(None))
