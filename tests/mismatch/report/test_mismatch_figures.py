"""What the figures of a report draw, and what their captions promise."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from tire_pipeline.mismatch.proof.measured import Remainder
from tire_pipeline.mismatch.report.figures import drawings, time_line
from tire_pipeline.mismatch.report.headline.sentences import head


def report(changes: list[str], *, gap: float) -> SimpleNamespace:
    """Just what the figures read: 20 s at 50 Hz with a gap in the middle."""
    time = np.arange(0.0, 20.0, 0.02)
    time[500:] += gap
    wave = np.sin(time)
    series = {
        "time": time,
        "slip_angle": 0.1 * wave,
        "slip_ratio": 0.0 * wave,
        "normal_load": 4e3 + 1e3 * wave,
    }
    series |= {"before_fy": 100.0 * wave, "after_fy": 10.0 * wave, "floor_fy": 5.0}
    fit = {"fy": SimpleNamespace(rms_before=70.0, noise_floor=5.0)}
    corrected = SimpleNamespace(changes=changes, factors={"fy": 1.0})
    return SimpleNamespace(series=series, effects=[], fit=fit, corrected=corrected)


@pytest.mark.parametrize("gap", [0.0, 3.0])
def test_no_line_runs_over_a_gap(gap):
    figure = time_line(report(["camber"], gap=gap), "fy")
    for line in figure.axes[0].lines:
        x = np.asarray(line.get_xdata(), float)
        assert np.isnan(x).sum() == (1 if gap else 0)
        assert np.nanmax(np.diff(x)) < 0.03
        assert len(x) == 1000 + np.isnan(x).sum()


def test_captions_speak_of_what_is_drawn():
    with_after, without = (drawings(report(changes, gap=3.0)) for changes in (["camber"], []))
    assert "from before to after" in with_after[0]["caption"]
    assert "after" not in without[0]["caption"]
    assert "Lines break where nothing was recorded" in without[1]["caption"]
    assert "Lines break" not in drawings(report([], gap=0.0))[1]["caption"]


def test_captions_say_that_a_wrong_unit_is_set_right_in_the_figures():
    one = report(["camber"], gap=0.0)
    assert not any("set right" in each["caption"] for each in drawings(one))
    one.corrected.factors = {"fy": 1.0, "slip_angle": 0.01745}
    assert all("unit or sign of slip_angle set right" in each["caption"] for each in drawings(one))


def test_no_residual_of_nothing_is_told():
    """A noise as large as what is left ended in "Fy 0 N RMS above noise"."""
    left = Remainder(size={"fy": 0.0, "fx": 30.0}, located=[], significant=True)
    told = head("unexplained", [], {}, [], left, "").text
    assert "difference (Fx 30 N RMS above noise)." in told
    none = head("unexplained", [], {}, [], replace(left, size={"fy": 0.0}), "").text
    assert none == "I can't tell: no effect of the catalogue explains the difference."
