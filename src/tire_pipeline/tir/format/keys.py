"""Names of the sections and keys of a ``.tir`` file, and the dimension of each key."""

from __future__ import annotations

import re

from tire_pipeline.magic_formula.parameters.coefficients import INDEX

SECTION_ALIASES = {
    "UNIT": "UNITS",
    "MDI": "MDI_HEADER",
    "HEADER": "MDI_HEADER",
    "DIMENSIONS": "DIMENSION",
    "TIRE_CONDITIONS": "OPERATING_CONDITIONS",
    "TYRE_CONDITIONS": "OPERATING_CONDITIONS",
    "INERTIAL": "INERTIA",
    "CONTACTPATCH": "CONTACT_PATCH",
    "TIRE_PRESSURE_RANGE": "INFLATION_PRESSURE_RANGE",
    "TYRE_PRESSURE_RANGE": "INFLATION_PRESSURE_RANGE",
    "PRESSURE_RANGE": "INFLATION_PRESSURE_RANGE",
    "INCLINATION_SLIP_RANGE": "INCLINATION_ANGLE_RANGE",
    "CAMBER_ANGLE_RANGE": "INCLINATION_ANGLE_RANGE",
    "LONGITUDINAL_SLIP_RANGE": "LONG_SLIP_RANGE",
    "SCALING": "SCALING_COEFFICIENTS",
    "SCALING_FACTORS": "SCALING_COEFFICIENTS",
    "LONGITUDINAL": "LONGITUDINAL_COEFFICIENTS",
    "LATERAL": "LATERAL_COEFFICIENTS",
    "OVERTURNING": "OVERTURNING_COEFFICIENTS",
    "ROLLING": "ROLLING_COEFFICIENTS",
    "ROLLING_RESISTANCE": "ROLLING_COEFFICIENTS",
    "ALIGNING": "ALIGNING_COEFFICIENTS",
    "TURNSLIP": "TURNSLIP_COEFFICIENTS",
    "TURN_SLIP": "TURNSLIP_COEFFICIENTS",
}
"""Section names that files use beside the standard one."""

KEY_ALIASES = {
    "NORMPRES": "NOMPRES",
    "IP_NOM": "NOMPRES",
    "IP": "INFLPRES",
    "LFZ0": "LFZO",
    "QV1": "Q_V1",
    "QV2": "Q_V2",
    "QFZ1": "Q_FZ1",
    "QFZ2": "Q_FZ2",
    "QFZ3": "Q_FZ3",
    "QFCX": "Q_FCX",
    "QFCY": "Q_FCY",
    "QFCG": "Q_FCG",
}
"""Keys that mean the same as a standard one, wherever they stand among the coefficients."""

FORCE_SECTIONS = frozenset(
    [
        "SCALING_COEFFICIENTS",
        "LONGITUDINAL_COEFFICIENTS",
        "LATERAL_COEFFICIENTS",
        "OVERTURNING_COEFFICIENTS",
        "ROLLING_COEFFICIENTS",
        "ALIGNING_COEFFICIENTS",
        "TURNSLIP_COEFFICIENTS",
        "LOADED_RADIUS_COEFFICIENTS",
    ]
)
"""Here every value that an equation reads has to be a number."""

COEFFICIENT_SECTIONS = FORCE_SECTIONS | frozenset(
    [
        "OPERATING_CONDITIONS",
        "VERTICAL",
        "STRUCTURAL",
        "CONTACT_PATCH",
        "INFLATION_PRESSURE_RANGE",
        "VERTICAL_FORCE_RANGE",
        "LONG_SLIP_RANGE",
        "SLIP_ANGLE_RANGE",
        "INCLINATION_ANGLE_RANGE",
    ]
)
"""Numbers in these sections are coefficients; the keys of all others are metadata."""

NEVER_COEFFICIENTS = frozenset(["UNITS", "MDI_HEADER", "MFSIMPLE"])
"""No key of these sections is a coefficient, whatever it is called."""

FREE_KEYS = frozenset(["UNLOADED_RADIUS", "LONGVL", "FNOMIN", "NOMPRES", "INFLPRES"])
"""Coefficients outside of the coefficient sections (``[DIMENSION]``, ``[MODEL]``, ``[WHEEL]``...)."""

_DIMENSIONS = {
    "length": "UNLOADED_RADIUS WIDTH RIM_RADIUS RIM_WIDTH BOTTOMING_RADIUS BOTTOM_OFFST "
    "ROAD_INCREMENT ELLIPS_MAX_STEP TYRE_RADIUS_MOD",
    "speed": "LONGVL VXLOW",
    "force": "FNOMIN FZMIN FZMAX",
    "stiffness": "VERTICAL_STIFFNESS BOTTOM_STIFF LONGITUDINAL_STIFFNESS LATERAL_STIFFNESS",
    "damping": "VERTICAL_DAMPING",
    "yaw stiffness": "YAW_STIFFNESS",
    "pressure": "INFLPRES NOMPRES PRESMIN PRESMAX",
    "angle": "ALPMIN ALPMAX CAMMIN CAMMAX",
    "mass": "MASS BELT_MASS MBELT TIRE_MASS",
    "inertia": "IXX IYY BELT_IXX BELT_IYY",
    "acceleration": "GRAVITY",
    "time": "HMAX_LOCAL TIME_SWITCH_INTEG",
}
DIMENSION: dict[str, str] = {key: name for name, keys in _DIMENSIONS.items() for key in keys.split()}
"""Key -> dimension; keys that are not here are pure numbers."""

TABLE_SECTIONS = frozenset(["SHAPE", "DEFLECTION_LOAD_CURVE", "BOTTOMING_CURVE"])
"""Sections that hold rows of numbers."""

_NAME_OF_FORCE_COEFFICIENT = re.compile(r"[PQRS][A-Z]+\d+").fullmatch


def names_force_coefficient(key: str) -> bool:
    """Whether a key looks like a p, q, r or s coefficient: letters and a number."""
    return _NAME_OF_FORCE_COEFFICIENT(key) is not None


def is_in_equations(key: str) -> bool:
    """Whether some version's equations may read a key: its value must be a number.

    Examples
    --------
    >>> is_in_equations("PKY1"), is_in_equations("LMUY"), is_in_equations("CONTACT_MODEL")
    (True, True, False)
    """
    return names_force_coefficient(key) or key in INDEX


def names_coefficient(section: str, key: str) -> bool:
    """Whether a key of a section (both in capitals, the section's standard name) is a coefficient.

    Examples
    --------
    >>> names_coefficient("INERTIA", "MASS"), names_coefficient("WHEEL", "FNOMIN")
    (False, True)
    """
    if section in COEFFICIENT_SECTIONS:
        return True
    if section in NEVER_COEFFICIENTS:
        return False
    key = KEY_ALIASES.get(key, key)
    if key in FREE_KEYS:
        return True
    return section == "" and (names_force_coefficient(key) or key in DIMENSION)


def section_name(raw: str) -> str:
    """Return a section's standard name: capitals, underscores, aliases resolved, no unprintable characters.

    Examples
    --------
    >>> section_name(" TurnSlip ")
    'TURNSLIP_COEFFICIENTS'
    """
    name = "_".join(raw.upper().split())
    if not name.isprintable():
        name = "".join(each if each.isprintable() else "?" for each in name)
    return SECTION_ALIASES.get(name, name)
