"""Constants of a brush tire and of its rig, drawn again for every case."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from tire_pipeline.concealed.brush_rig import brush


@dataclass(frozen=True)
class TireConstants:
    """What :mod:`tire_pipeline.concealed.brush_rig.brush` needs to know, in SI units.

    The order of the fields is that of the positions in ``brush``; ``vector`` makes the array.
    """

    nominal_load: float
    radius: float
    half_length: float
    length_exponent: float
    tread_x: float
    tread_y: float
    carcass_x: float
    carcass_y: float
    carcass_psi: float
    friction: float
    friction_ratio_x: float
    friction_pressure_exponent: float
    slide_drop: float
    slide_slip: float
    profile: float
    profile_skew: float
    nominal_speed: float
    nominal_pressure: float
    reference_temperature: float
    ambient: float
    heat_share: float
    heat_capacity: float
    cooling: float
    cooling_speed: float
    rolling_heat: float
    bulk_exchange: float
    bulk_rate: float
    wear_energy: float
    camber_gain: float
    coupling: float
    temperature_linear: float
    temperature_square: float
    temperature_stiffness: float
    wear_stiffness: float
    pressure_length: float
    pressure_stiffness: float
    plysteer: float
    conicity: float
    runout_angle: float
    runout_load: float
    runout_phase: float
    compliance_fx: float
    surface_time: float
    load_curve: float

    def vector(self) -> np.ndarray:
        """Return the constants as the array that the kernels take, shape (44,)."""
        return np.array([getattr(self, field.name) for field in fields(self)], dtype=float)


def draw_constants(rng: np.random.Generator) -> TireConstants:
    """Draw a passenger-car tire on a rig.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    TireConstants
        ``surface_time`` and ``wear_energy`` are set by the case (they depend on its schedule).
    """
    nominal_load = round(float(rng.uniform(3000.0, 6500.0)), -1)
    half_length = float(rng.uniform(0.05, 0.075)) * (nominal_load / 4500.0) ** 0.3
    cornering = float(rng.uniform(15.0, 26.0)) * nominal_load
    nominal_speed = float(rng.choice([13.889, 16.667, 19.444, 22.222]))
    # What is written first is drawn first: another order draws other tires.
    return TireConstants(
        nominal_load=nominal_load,
        nominal_speed=nominal_speed,
        half_length=half_length,
        **_draw_structure(rng, cornering, cornering / (2.0 * half_length**2)),
        **_draw_friction(rng),
        nominal_pressure=round(float(rng.uniform(1.9e5, 2.6e5)), -4),
        **_draw_heat(rng),
        wear_energy=1e6,
        **_draw_sensitivities(rng),
        **_draw_asymmetries(rng),
        surface_time=np.inf,
        load_curve=float(rng.uniform(0.0, 0.05)),
    )


def _draw_structure(rng: np.random.Generator, cornering: float, tread_y: float) -> dict[str, float]:
    """Radius, contact, tread and carcass, for a cornering stiffness (N/rad)."""
    return {
        "radius": float(rng.uniform(0.29, 0.36)),
        "length_exponent": float(rng.uniform(0.36, 0.48)),
        "tread_x": tread_y * float(rng.uniform(1.1, 1.7)),
        "tread_y": tread_y,
        "carcass_x": float(rng.uniform(4e5, 9e5)),
        "carcass_y": cornering / float(rng.uniform(0.25, 0.6)),
        "carcass_psi": float(rng.uniform(7e3, 1.6e4)),
    }


def _draw_friction(rng: np.random.Generator) -> dict[str, float]:
    """Friction, how it falls with sliding, and the pressure over the contact."""
    return {
        "friction": float(rng.uniform(0.9, 1.25)),
        "friction_ratio_x": float(rng.uniform(0.97, 1.15)),
        "friction_pressure_exponent": float(rng.uniform(0.05, 0.2)),
        "slide_drop": float(rng.uniform(0.08, 0.3)),
        "slide_slip": float(rng.uniform(0.12, 0.35)),
        "profile": float(rng.uniform(2.0, 4.5)),
        "profile_skew": float(rng.uniform(0.0, 0.12)),
    }


def _draw_heat(rng: np.random.Generator) -> dict[str, float]:
    """Temperatures, and how the tread warms and cools."""
    return {
        "reference_temperature": float(rng.uniform(50.0, 70.0)),
        "ambient": float(rng.uniform(20.0, 38.0)),
        "heat_share": float(rng.uniform(0.25, 0.5)),
        "heat_capacity": float(rng.uniform(2.5e3, 6e3)),
        "cooling": float(rng.uniform(30.0, 60.0)),
        "cooling_speed": float(rng.uniform(8.0, 18.0)),
        "rolling_heat": float(rng.uniform(0.002, 0.006)),
        "bulk_exchange": float(rng.uniform(10.0, 40.0)),
        "bulk_rate": float(rng.uniform(0.005, 0.02)),
    }


def _draw_sensitivities(rng: np.random.Generator) -> dict[str, float]:
    """What camber, temperature, wear and inflation pressure do."""
    return {
        "camber_gain": 0.0 if rng.random() < 0.3 else float(rng.uniform(0.3, 0.9)),
        "coupling": 0.0 if rng.random() < 0.3 else float(rng.uniform(0.5, 1.0)),
        "temperature_linear": float(rng.uniform(0.3, 1.0)),
        "temperature_square": float(rng.uniform(0.0, 0.5)),
        "temperature_stiffness": float(rng.uniform(0.0, 0.9)),
        "wear_stiffness": float(rng.uniform(0.2, 1.2)),
        "pressure_length": float(rng.uniform(0.5, 1.0)),
        "pressure_stiffness": float(rng.uniform(0.0, 0.5)),
    }


def _draw_asymmetries(rng: np.random.Generator) -> dict[str, float]:
    """What differs to both sides, comes once a turn, or turns the wheel."""
    return {
        "plysteer": float(rng.choice([-1.0, 1.0])) * float(rng.uniform(0.0, 0.001)),
        "conicity": float(rng.choice([-1.0, 1.0])) * float(rng.uniform(0.02, 0.05)),
        "runout_angle": float(rng.uniform(0.005, 0.01)),
        "runout_load": float(rng.uniform(0.0, 0.05)),
        "runout_phase": float(rng.uniform(0.0, 2.0 * np.pi)),
        "compliance_fx": float(rng.uniform(-0.3, 0.3)),
    }


assert len(fields(TireConstants)) == brush.N_CONSTANTS


def without_cooling(constants: TireConstants, heat_capacity: float) -> TireConstants:
    """Return a tire that keeps its heat, recorded from the temperature on at which its model was measured.

    Its temperature is then what friction and rolling have put into it so far, as its wear is: the two look
    alike by design, not by the luck of a short recording.

    Parameters
    ----------
    constants : TireConstants
    heat_capacity : float
        J/K.
    """
    return replace(
        constants,
        ambient=constants.reference_temperature,
        cooling=0.0,
        cooling_speed=0.0,
        bulk_exchange=0.0,
        heat_capacity=heat_capacity,
    )
