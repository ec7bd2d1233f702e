"""Where the tire touches: length of the contact, and how its pressure is spread along and across it."""

import numpy as np
from numba import njit

from tire_pipeline.concealed.second import places as at

STRIPS = 3
ELEMENTS = 20


@njit(cache=True, error_model="numpy")
def half_length(tire: np.ndarray, load: float, inflation: float) -> float:
    """Half the length of the contact, m: of the chord that the deflection cuts off, times a constant share.

    Deflection is load over vertical stiffness, of which half comes from inflation (Pacejka, Tire and Vehicle
    Dynamics, 3rd ed. 2012, ch. 9.3.1). On a drum the curvatures of tire and drum add up (ch. 9.2).

    Parameters
    ----------
    tire, load, inflation
        Load in N, inflation pressure in Pa.
    """
    stiffness = tire[at.VERTICAL_STIFFNESS] * (0.5 + 0.5 * inflation / tire[at.NOMINAL_PRESSURE])
    deflection = max(load, 50.0) / stiffness
    radius = 1.0 / (1.0 / tire[at.RADIUS] + tire[at.DRUM_CURVATURE])
    return tire[at.CONTACT_SHARE] * np.sqrt(2.0 * radius * deflection)


@njit(cache=True, error_model="numpy")
def strip_shares(tire: np.ndarray, camber: float, inflation: float, shares: np.ndarray) -> None:
    """Each strip's share of the load, into `shares` (right, middle, left), which sum to one.

    Inflation rounds the crown and unloads the shoulders; positive camber leans to the right and loads the
    right shoulder (Deur et al., Extensions of the LuGre tyre friction model related to variable slip speed
    along the contact patch length, Vehicle System Dynamics 43 suppl., 2005).
    """
    middle = 1.0 / 3.0 + tire[at.SHOULDER_SHIFT] * (inflation / tire[at.NOMINAL_PRESSURE] - 1.0)
    middle = min(max(middle, 0.15), 0.7)
    tilt = min(max(tire[at.CAMBER_SHIFT] * camber, -0.25), 0.25)
    side = 0.5 * (1.0 - middle)
    shares[0] = side * (1.0 + tilt)
    shares[1] = middle
    shares[2] = side * (1.0 - tilt)


@njit(cache=True, error_model="numpy")
def pressure_profile(tire: np.ndarray, profile: np.ndarray) -> None:
    """Pressure along the contact over its mean, into `profile`, from the front to the rear.

    p ~ (1 - |u|^n)(1 + B u), u = 1 at the front: Guo and Ren, A unified semi-empirical tire model with higher
    accuracy and less parameters, SAE 1999-01-0785.
    """
    n = profile.size
    total = 0.0
    for i in range(n):
        u = 1.0 - (2.0 * i + 1.0) / n
        profile[i] = (1.0 - abs(u) ** tire[at.PRESSURE_EXPONENT]) * (1.0 + tire[at.PRESSURE_FORWARD] * u)
        total += profile[i]
    for i in range(n):
        profile[i] *= n / total
