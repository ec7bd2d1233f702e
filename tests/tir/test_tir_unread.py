"""What of a file is not read, or is read though it contradicts itself, is told."""

from __future__ import annotations

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
