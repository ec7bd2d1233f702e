"""What a part of is confirmed is added in part: hidden camber on the flat belt."""

from pathlib import Path

import pytest
from mismatch_shared import shared

BENCHMARKS = Path(__file__).resolve().parents[3] / "benchmarks"


def test_hidden_camber_is_corrected_as_far_as_it_is_confirmed(monkeypatch):
    """All of the change leaves slightly more than nothing does, a third of it less."""
    shared("recordings/calspan/cornering_part.mat")
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    import flat_belt_hidden

    row = flat_belt_hidden.judge("camber", 20, True)
    assert row.names == ("camber",)
    assert row.after < 0.97 * row.before
    assert row.before == pytest.approx(77.0, abs=1.0)
