"""Heat and wear: an energy balance of tread and carcass, and the tread that friction rubs off."""

import numpy as np
from numba import njit

from tire_pipeline.concealed.second import places as at

AIR = 25.0  # degC, of air and road
TREAD_SHARE = 0.55  # of the friction power that goes into the tread; the road takes the rest
ROLLING_LOSS = 0.010  # of load times speed, heated in the carcass
CONDUCTED = 45.0  # W/K from tread to carcass
ROAD = 20.0  # W/K from tread to road
COOLED = 4.0  # W/K per (m/s)^0.8, from tread to air
SIDEWALL = 1.3  # W/K per (m/s)^0.8, from carcass to air


@njit(cache=True, error_model="numpy")
def warm(tire: np.ndarray, heat: np.ndarray, power: float, load: float, speed: float, step: float) -> None:
    """One time step of tread and carcass temperature, (2,) in degC, in place.

    C dT/dt = heat in - conducted - cooled, for each: a two-node cut of Farroni, Giordano, Russo and Timpone,
    TRT: thermo racing tyre, a physical model to predict the tyre temperature distribution, Meccanica 49
    (2014) 707, and of Sorniotti, Tire thermal model for enhanced vehicle dynamics simulation, SAE
    2009-01-0441. Convection grows with the 0.8th power of speed (turbulent).

    Parameters
    ----------
    power, load, speed, step
        Friction power in W, N, m/s, s.
    """
    wind = max(speed, 0.1) ** 0.8
    between = CONDUCTED * (heat[0] - heat[1])
    tread = TREAD_SHARE * power - between - (ROAD + COOLED * wind) * (heat[0] - AIR)
    carcass = ROLLING_LOSS * load * speed + between - SIDEWALL * wind * (heat[1] - AIR)
    heat[0] += step * tread / tire[at.TREAD_CAPACITY]
    heat[1] += step * carcass / tire[at.CARCASS_CAPACITY]


@njit(cache=True, error_model="numpy")
def depth_left(tire: np.ndarray, work: float) -> float:
    """Tread depth (m) after a friction work per tread area (J/m2): abrasion is proportional to the work.

    Schallamach and Turner, The wear of slipping wheels, Wear 3 (1960) 1. At least a fifth of the tread stays.
    """
    return max(tire[at.TREAD_DEPTH] - tire[at.WEAR_RATE] * work, 0.2 * tire[at.TREAD_DEPTH])
