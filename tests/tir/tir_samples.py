"""Texts and paths that the tests of this folder share."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

SHARED = Path(__file__).resolve().parents[3] / "shared"
PUBLIC = sorted((SHARED / "tir").glob("*.tir"))
TESTS = Path(__file__).resolve().parents[1]
SHIPPED = [
    TESTS.parent / "examples" / "tire.tir",
    *sorted((TESTS / "data_of_0_1" / "07_model_output" / "translated").rglob("*.tir")),
]
"""Whole files that come with the project: one that it fitted, and two in a laboratory's own style."""
WHOLE_FILES = [*SHIPPED, *PUBLIC]


def need_shared() -> None:
    if not PUBLIC and not os.environ.get("CI"):
        pytest.skip(f"the public data is not at {SHARED}")


LATERAL = {
    "PCY1": 1.3,
    "PDY1": 1.0,
    "PDY2": -0.1,
    "PEY1": -0.8,
    "PKY1": -20.0,
    "PKY2": 1.8,
    "PHY1": 0.002,
}


def tir_text(
    *,
    units: str = "LENGTH = 'meter'\nFORCE = 'newton'\nANGLE = 'radians'\nMASS = 'kg'\nTIME = 'second'",
    model: str = "PROPERTY_FILE_FORMAT = 'MF-TYRE'\nFITTYP = 52\nTYRESIDE = 'LEFT'\nLONGVL = 16.7",
    vertical: str = "FNOMIN = 4000",
    lateral: str | None = None,
    more: str = "",
) -> str:
    """A small file; each argument is the body of a section."""
    if lateral is None:
        lateral = "\n".join(f"{key} = {value}" for key, value in LATERAL.items())
    return (
        f"[MDI_HEADER]\nFILE_TYPE = 'tir'\n[UNITS]\n{units}\n[MODEL]\n{model}\n"
        f"[DIMENSION]\nUNLOADED_RADIUS = 0.32\n[VERTICAL]\n{vertical}\n"
        f"[LATERAL_COEFFICIENTS]\n{lateral}\n{more}"
    )
