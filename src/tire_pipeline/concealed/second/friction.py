"""Friction of rubber: one master curve over sliding speed, shifted by temperature."""

import numpy as np
from numba import njit

from tire_pipeline.concealed.second import places as at

WLF_1 = 8.86
WLF_2 = 101.5  # K
DECADE = 2.302585092994046
MEAN_PRESSURE = 3.0e5  # Pa, at which `friction_peak` holds


@njit(cache=True, error_model="numpy")
def shift(tire: np.ndarray, temperature: float) -> float:
    """Decades by which a temperature (degC) moves the speed: log10 a_T of Williams, Landel and Ferry.

    -8.86 (T - Ts) / (101.5 + T - Ts): J. Am. Chem. Soc. 77 (1955) 3701. Grosch found that friction of rubber
    follows it: The relation between the friction and visco-elastic properties of rubber, Proc. R. Soc. A 274
    (1963) 21. Below Ts - 60 degC, where it has a pole, the value there holds.
    """
    above = max(temperature - tire[at.GLASS_SHIFT], -60.0)
    return -WLF_1 * above / (WLF_2 + above)


@njit(cache=True, error_model="numpy")
def from_hump(tire: np.ndarray, speed_scale: float) -> float:
    """Logarithm of the factor on a sliding speed (m/s), before `shift`, that counts it from the hump."""
    decades = shift(tire, tire[at.FRICTION_TEMPERATURE])
    return np.log(speed_scale / tire[at.FRICTION_SPEED]) - DECADE * decades


@njit(cache=True, error_model="numpy", inline="always")
def friction(over: float, peak: float, floor: float, width: float) -> float:
    """Coefficient of friction at a shifted sliding speed, at mean pressure.

    mu = mu_0 + (mu_m - mu_0) exp(-h^2 ln^2(v a_T / v_m)): Savkoor, Some aspects of friction and wear of tyres
    arising from deformations, slip and stresses at the ground contact, Wear 9 (1966) 66.

    Parameters
    ----------
    over
        ln(v a_T / v_m).
    peak, floor, width
        mu_m; mu_0 over mu_m; h.
    """
    return peak * (floor + (1.0 - floor) * np.exp(-((width * over) ** 2)))


@njit(cache=True, error_model="numpy")
def pressure_factor(tire: np.ndarray, pressure: float) -> float:
    """Factor on friction at a mean contact pressure (Pa): a falling power.

    Schallamach, The load dependence of rubber friction, Proc. Phys. Soc. B 65 (1952) 657; the power there is
    1/3 for smooth rubber, less for tires.
    """
    bottom = 0.02
    relative = max(pressure / MEAN_PRESSURE, bottom)
    return relative ** -(tire[at.FRICTION_PRESSURE] + tire[at.LOAD_GAIN])


@njit(cache=True, error_model="numpy")
def modulus_factor(tire: np.ndarray, bulk: float) -> float:
    """Factor on the tread's shear modulus at its bulk temperature (degC): about 0.5% softer a degree.

    Angrick, van Putten and Prokop, Influence of tire core and surface temperature on lateral tire
    characteristics, SAE Int. J. Passeng. Cars 7(2) (2014), 2014-01-0074: cornering stiffness falls by about a
    tenth over 20 degrees.
    """
    return np.exp(-0.005 * tire[at.TEMPERATURE_GAIN] * (bulk - tire[at.FRICTION_TEMPERATURE]))
