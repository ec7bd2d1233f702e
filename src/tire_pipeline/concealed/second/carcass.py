"""The carcass between rim and tread: a few modes that bend under the contact forces."""

import numpy as np
from numba import njit

from tire_pipeline.concealed.second import places as at

SIDE, YAW, BEND, LENGTH = 0, 1, 2, 3
MODES = 4


@njit(cache=True, error_model="numpy")
def stiffnesses(tire: np.ndarray, inflation: float, stiffness: np.ndarray) -> None:
    """Stiffness of each mode at an inflation pressure (Pa), into `stiffness`, (4,): N/m, N m/rad, N/m, N/m.

    To the side, about z, a parabola along the contact, along x. A part of each comes from the inflated
    membrane (Pacejka 2012, ch. 5, the stretched string). A viscoelastic carcass under bristles: Mavros,
    Rahnejat and King, Transient analysis of tyre friction generation using a brush model with interconnected
    viscoelastic bristles, Proc. IMechE K 219 (2005) 275; here it bends in modes.
    """
    inflated = (
        1.0 - tire[at.CARCASS_PRESSURE] + tire[at.CARCASS_PRESSURE] * inflation / tire[at.NOMINAL_PRESSURE]
    )
    scale = tire[at.CARCASS_SCALE] * inflated
    stiffness[SIDE] = tire[at.LATERAL_STIFFNESS] * scale
    stiffness[YAW] = tire[at.YAW_STIFFNESS] * scale
    stiffness[BEND] = tire[at.BENDING_STIFFNESS] * scale
    stiffness[LENGTH] = tire[at.LONGITUDINAL_STIFFNESS] * scale


@njit(cache=True, error_model="numpy")
def bend(
    tire: np.ndarray,
    modes: np.ndarray,
    rates: np.ndarray,
    stiffness: np.ndarray,
    pushed: np.ndarray,
    held: np.ndarray,
    step: float,
) -> None:
    """One time step of the modes: c dq/dt + k q = Q, into `modes` and `rates`.

    Q are the contact forces of the last step; how much they will change while q does (`held`, the bristles'
    own stiffness in that mode) is counted in, so that the stiff tread cannot make the step unstable.

    Parameters
    ----------
    modes, rates, stiffness, pushed, held
        (4,) in the units of each mode.
    step
        s.
    """
    for m in range(modes.size):
        damping = tire[at.CARCASS_TIME] * stiffness[m]
        divisor = damping + step * (stiffness[m] + tire[at.LAG] * held[m])
        rates[m] = (pushed[m] - stiffness[m] * modes[m]) / divisor
        modes[m] += step * rates[m]
