"""What of a file is not read, or is read though it contradicts itself, is told."""

from __future__ import annotations

import pytest
from tir_samples import LATERAL, tir_text

from tire_pipeline.tir import read_tir


def test_coefficients_in_a_section_of_no_known_name_are_told():
    """They counted as absent, without a word: a misspelt header took a whole force away."""
    text = tir_text().replace("[LATERAL_COEFFICIENTS]", "[LATTERAL_COEFICIENTS]")
    assert "LATTERAL" in text
    whole = text + "\n[LONGITUDINAL_COEFFICIENTS]\nPCX1 = 1.6\nPDX1 = 1\nPKX1 = 20\n"
    warnings = read_tir(whole.encode()).metadata["warnings"]
    (said,) = [each for each in warnings if "LATTERAL" in each]
    assert "is no section that is known" in said
    assert f"{sum(key[0] in 'PR' for key in LATERAL)} coefficients in it are not read" in said
    plain = read_tir(tir_text().encode()).metadata["warnings"]
    assert not any("no section that is known" in each for each in plain)


def test_two_texts_of_one_key_are_told():
    """The side of a tire may be stated twice: the last one holds."""
    text = tir_text() + "\n[MODEL]\nTYRESIDE = 'LEFT'\n[MODEL]\nTYRESIDE = 'RIGHT'\n"
    model = read_tir(text.encode())
    assert model.metadata["MODEL.TYRESIDE"] == "RIGHT"
    assert any(
        "MODEL.TYRESIDE is" in each and "the last is taken" in each for each in model.metadata["warnings"]
    )


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ("PKY1 = -2000", "PKY1 = -2000 is implausible: no tire is so stiff for its load"),
        ("PDY1 = -11", "PDY1 = -11 is implausible: no tire has such a friction"),
        ("PKX1 = 2000", "PKX1 = 2000 is implausible: no tire is so stiff for its load"),
    ],
)
def test_a_coefficient_beyond_any_tire_is_told_whatever_its_sign(more: str, told: str):
    assert told in read_tir(tir_text(more=more).encode()).metadata["warnings"]


@pytest.mark.parametrize(
    ("more", "turned"),
    [
        ("", False),
        ("PKY1 = 20", True),
        ("PKY2 = -1.8", True),
        ("PKY1 = 20\nPKY2 = -1.8", False),
        ("[SCALING_COEFFICIENTS]\nLKY = -1", True),
        ("PKY1 = 20\n[SCALING_COEFFICIENTS]\nLKY = -1", False),
    ],
)
def test_a_side_force_of_the_other_sign_is_told(more: str, turned: bool):
    """The cornering stiffness is a product: two of its factors may have the other sign."""
    tire = read_tir(tir_text(more=more).encode())
    told = any("Fy has the other sign than in ISO W" in each for each in tire.metadata["warnings"])
    assert told == turned
    assert (tire.forces(normal_load=4000.0, slip_angle=0.05).fy > 0.0) == turned
