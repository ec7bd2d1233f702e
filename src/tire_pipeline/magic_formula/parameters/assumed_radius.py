"""The unloaded radius to assume where neither the file nor the user states one."""

from __future__ import annotations

from tire_pipeline.magic_formula.parameters.tire_parameters import TireParameters

ASSUMED_RADIUS = 0.32
"""Unloaded radius, m, where nothing states one: about that of a 205/55 R16 (8 inches + 55% of 205 mm)."""


def assumed_radius(tire: TireParameters | None) -> list[str]:
    """Say which radius stands in for one that a tire model lacks.

    Parameters
    ----------
    tire : TireParameters, optional

    Returns
    -------
    list of str
        One sentence, or none if the model states its radius.
    """
    if tire is None or "UNLOADED_RADIUS" in tire.coefficients:
        return []
    return [f"the tire model states no UNLOADED_RADIUS, and {ASSUMED_RADIUS:g} m is taken for it"]
