"""Every key with a unit is scaled by it, and every unit has the size that the field gives it."""

from __future__ import annotations

import math

import pytest
from tir_samples import tir_text

from tire_pipeline.tir import read_tir

OTHER_UNITS = "LENGTH = mm\nFORCE = kN\nANGLE = deg\nMASS = gram\nTIME = ms\nPRESSURE = bar"
SHORT, LARGE, BIT = 1e-3, 1e3, math.radians(1.0)  # mm, g and ms; kN; a degree


@pytest.mark.parametrize(
    ("section", "key", "si"),
    [
        ("SLIP_ANGLE_RANGE", "ALPMIN", BIT),
        ("INCLINATION_ANGLE_RANGE", "CAMMIN", BIT),
        ("INCLINATION_ANGLE_RANGE", "CAMMAX", BIT),
        ("VERTICAL_FORCE_RANGE", "FZMIN", LARGE),
        ("OPERATING_CONDITIONS", "INFLPRES", 1e5),
        ("INFLATION_PRESSURE_RANGE", "PRESMAX", 1e5),
        ("VERTICAL", "BOTTOM_OFFST", SHORT),
        ("VERTICAL", "BOTTOM_STIFF", LARGE / SHORT),
        ("STRUCTURAL", "LONGITUDINAL_STIFFNESS", LARGE / SHORT),
        ("STRUCTURAL", "LATERAL_STIFFNESS", LARGE / SHORT),
        ("MODEL", "MODEL.VXLOW", SHORT / SHORT),
        ("DIMENSION", "DIMENSION.RIM_RADIUS", SHORT),
        ("DIMENSION", "DIMENSION.RIM_WIDTH", SHORT),
        ("INERTIA", "INERTIA.BELT_MASS", SHORT),
        ("INERTIA", "INERTIA.IYY", SHORT**3),
        ("INERTIA", "INERTIA.BELT_IYY", SHORT**3),
        ("INERTIA", "INERTIA.GRAVITY", SHORT / SHORT**2),
    ],
)
def test_a_key_is_scaled_by_the_units_of_the_file(section: str, key: str, si: float):
    more = f"[{section}]\n{key.rpartition('.')[2]} = 7"
    tire = read_tir(tir_text(units=OTHER_UNITS, model="FITTYP = 61", more=more).encode())
    found = {**tire.metadata, **tire.coefficients}
    assert found[key] == pytest.approx(7.0 * si, rel=1e-13)


def test_a_speed_follows_length_and_time_unless_it_is_stated():
    model = "FITTYP = 61\nLONGVL = 60\nVXLOW = 3.6"
    units = "LENGTH = mm\nTIME = s"
    assert read_tir(tir_text(units=units, model=model).encode()).coefficients["LONGVL"] == 0.06
    tire = read_tir(tir_text(units=f"{units}\nSPEED = km/h", model=model).encode())
    assert tire.coefficients["LONGVL"] == pytest.approx(60 / 3.6, rel=1e-13)
    assert tire.metadata["MODEL.VXLOW"] == pytest.approx(1.0, rel=1e-13)


KEYS = {
    "LENGTH": ("DIMENSION", "WIDTH"),
    "FORCE": ("VERTICAL", "FNOMIN"),
    "ANGLE": ("SLIP_ANGLE_RANGE", "ALPMAX"),
    "MASS": ("INERTIA", "MASS"),
    "TIME": ("MODEL", "HMAX_LOCAL"),
    "PRESSURE": ("OPERATING_CONDITIONS", "NOMPRES"),
    "SPEED": ("MODEL", "LONGVL"),
}


@pytest.mark.parametrize(
    ("quantity", "name", "si"),
    [
        ("LENGTH", "km", 1000.0),
        ("LENGTH", "mile", 1609.344),
        ("FORCE", "kgf", 9.80665),
        ("FORCE", "kip", 4448.2216152605),
        ("FORCE", "ounce_force", 0.27801385095378),
        ("FORCE", "dyne", 1e-5),
        ("FORCE", "meganewton", 1e6),
        ("ANGLE", "degrees", 0.017453292519943),
        ("MASS", "tonne", 1000.0),
        ("MASS", "ounce_mass", 0.028349523125),
        ("MASS", "klbm", 453.59237),
        ("MASS", "slinch", 175.12683524648),
        ("TIME", "minute", 60.0),
        ("TIME", "hour", 3600.0),
        ("PRESSURE", "mbar", 100.0),
        ("PRESSURE", "N/mm^2", 1e6),
        ("PRESSURE", "ksi", 6894757.293168),
        ("SPEED", "mm/s", 0.001),
        ("SPEED", "kph", 0.27777777777778),
        ("SPEED", "mph", 0.44704),
        ("SPEED", "ft/s", 0.3048),
    ],
)
def test_the_size_of_a_unit(quantity: str, name: str, si: float):
    section, key = KEYS[quantity]
    text = tir_text(units=f"{quantity} = '{name}'", model="FITTYP = 61", more=f"[{section}]\n{key} = 3")
    tire = read_tir(text.encode())
    value = tire.coefficients[key] if key in tire.coefficients else tire.metadata[f"{section}.{key}"]
    assert value == pytest.approx(3.0 * si, rel=1e-12)
