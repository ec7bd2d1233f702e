"""The side force of a leaning wheel, which tells in which axes a recording is."""

from __future__ import annotations

import numpy as np

Array = np.ndarray
_SMALL_SLIPS = 0.2
"""Slip angles up to this part of the largest: there the force is nearly straight in the slip angle."""
_LEANS = float(np.radians(0.8))
"""Range of camber, rad, from which its force shows."""
_GOES_WITH = 0.5
"""Correlation of camber and slip angle from which the two cannot be told apart: a car that rolls."""
LEAST_THRUST = 0.3
"""Change of Fy over the load per rad. Passenger and racing tires have 0.5 to 3; truck tires about 0.1, of
either sign."""
_STANDARD_ERRORS = 6.0
"""Standard errors: of the neighbouring rows of a rig several are alike."""
_ROWS_USED, _ROWS_NEEDED = 1000, 20


def camber_thrust(slip_angle: Array, camber: Array, normal_load: Array, fy: Array) -> float:
    """Return the change of the side force over the load with camber, 1/rad, at small slip angles.

    A wheel is pushed to the side to which it leans (Pacejka 2012, ch. 1). In ISO W axes the number is
    negative, in SAE axes positive: they have the same camber, and y to the other side. In both the force
    falls with the slip angle; where it rises (adapted SAE axes), nothing is said.

    Parameters
    ----------
    slip_angle, camber : ndarray, shape (n,)
        rad.
    normal_load, fy : ndarray, shape (n,)
        In one unit; the sign of the load does not matter.

    Returns
    -------
    float
        0 where the recording does not show it for sure: one camber only, a camber that goes with the slip
        angle, too small a thrust, or a force that rises with the slip angle.

    Examples
    --------
    >>> slip = np.tile(np.linspace(-0.1, 0.1, 101), 2)
    >>> camber = np.repeat([0.0, 0.05], 101)
    >>> round(camber_thrust(slip, camber, np.full(202, 4000.0), -4000.0 * np.tanh(10.0 * slip + camber)), 1)
    -1.0
    """
    load = np.abs(normal_load)
    good = np.isfinite(slip_angle) & np.isfinite(camber) & np.isfinite(fy) & (load > 0.0)
    if not good.any():
        return 0.0
    good &= np.abs(slip_angle) <= _SMALL_SLIPS * np.quantile(np.abs(slip_angle[good]), 0.99)
    rows = np.flatnonzero(good)
    rows = rows[:: max(1, rows.size // _ROWS_USED)]
    slip, lean, share = slip_angle[rows], camber[rows], fy[rows] / load[rows]
    if rows.size < _ROWS_NEEDED or np.ptp(np.quantile(lean, [0.02, 0.98])) < _LEANS or np.ptp(slip) == 0.0:
        return 0.0
    if abs(np.corrcoef(slip, lean)[0, 1]) > _GOES_WITH:
        return 0.0
    part = load[rows] / np.median(load[rows])
    columns = np.column_stack([lean, np.ones(rows.size), part, slip, slip * part, slip**3])
    scaled = columns / np.sqrt(np.mean(columns**2, axis=0))
    found, _, _, _ = np.linalg.lstsq(scaled, share, rcond=None)
    left = share - scaled @ found
    variance = float(left @ left) / (rows.size - columns.shape[1]) * np.linalg.pinv(scaled.T @ scaled)[0, 0]
    if np.polyfit(slip, share, 1)[0] >= 0.0:
        return 0.0
    thrust = float(found[0]) / float(np.sqrt(np.mean(lean**2)))
    sure = abs(found[0]) > _STANDARD_ERRORS * np.sqrt(variance) and abs(thrust) > LEAST_THRUST
    return thrust if sure else 0.0
