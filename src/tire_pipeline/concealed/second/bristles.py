"""Bristles of the tread: LuGre friction in each element of the contact, carried along by rolling."""

import numpy as np
from numba import njit

from tire_pipeline.concealed.second import places as at
from tire_pipeline.concealed.second.friction import DECADE, friction, from_hump, shift

SLOWEST = 1e-4  # m/s, so that the logarithm ends
SKIN_SHARE = 0.5  # of friction heat that enters the rubber


@njit(cache=True, error_model="numpy")
def sweep_strip(
    tire: np.ndarray,
    stress: np.ndarray,
    flash: np.ndarray,
    slip_x: float,
    slip_y: np.ndarray,
    bound: np.ndarray,
    stiffness: float,
    rolling: float,
    length: float,
    speed_scale: float,
    bulk: float,
    step: float,
) -> float:
    """One time step of one strip, from its front to its rear; returns the friction power per width, W/m.

    d tau/dt + V_r d tau/ds = k v - k |v| tau / (mu p), for both directions with one |v|: the distributed
    LuGre model (Canudas-de-Wit and Tsiotras, Dynamic tire friction models for vehicle traction control, CDC
    1999; in two directions Velenis, Tsiotras, Canudas-de-Wit and Sorine, Dynamic tyre friction models for
    combined longitudinal and lateral vehicle motion, Vehicle System Dynamics 43 (2005) 3), written in stress,
    so that the tread's stiffness k does not depend on pressure and the bound mu p does (Deur, Asgari and
    Hrovat, A 3D brush-type dynamic tire friction model, Vehicle System Dynamics 42 (2004) 133). Implicit in
    time and upwind in space: no step is too long.

    The flash temperature of the rubber's skin gathers along the way what friction heats: Persson, Rubber
    friction: role of the flash temperature, J. Phys.: Condens. Matter 18 (2006) 7789; in a tire Mavros, A
    thermo-frictional tyre model including the effect of flash temperature, Vehicle System Dynamics 57 (2019).

    Parameters
    ----------
    stress, flash
        States, (elements, 2) in Pa and (elements,) in K; changed in place.
    slip_x, slip_y
        Speed of the belt over the road, m/s.
    bound
        Pressure times the factor of `pressure_factor`, Pa, (elements,).
    stiffness, rolling, length
        Pa/m; m/s; m.
    speed_scale
        Speed at which friction is evaluated, over the sliding speed.
    bulk
        Bulk temperature that friction sees, degC.
    step
        s.
    """
    n = bound.size
    ds = length / n
    carry = rolling / ds
    peak = tire[at.FRICTION_SCALE] * tire[at.FRICTION_PEAK]
    floor, width = tire[at.FRICTION_FLOOR], tire[at.FRICTION_WIDTH]
    offset = from_hump(tire, speed_scale)
    capacity = tire[at.SKIN_CAPACITY]
    power = 0.0
    before_x = 0.0
    before_y = 0.0
    before_flash = 0.0
    for i in range(n):
        speed = np.sqrt(slip_x * slip_x + slip_y[i] * slip_y[i])
        over = np.log(speed + SLOWEST) + offset + DECADE * shift(tire, bulk + flash[i])
        mu = friction(over, peak, floor, width)
        limit = mu * bound[i] + 1.0
        leave = stiffness * speed / limit
        divisor = 1.0 / step + carry + leave
        tau_x = (stress[i, 0] / step + carry * before_x + stiffness * slip_x) / divisor
        tau_y = (stress[i, 1] / step + carry * before_y + stiffness * slip_y[i]) / divisor
        stress[i, 0] = tau_x
        stress[i, 1] = tau_y
        lost = speed * (tau_x * tau_x + tau_y * tau_y) / limit
        power += lost * ds
        heated = 0.5 * lost / capacity
        flash[i] = (flash[i] / step + carry * before_flash + heated) / (1.0 / step + carry)
        before_x, before_y, before_flash = tau_x, tau_y, flash[i]
    return power
