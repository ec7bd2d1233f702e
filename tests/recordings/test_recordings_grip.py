"""A force that is too small beside the load, or beside the other force, at large slip is asked about."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.recordings import check_recording, read_recording

ROOT = Path(__file__).resolve().parents[2]
SHARED = ROOT.parent / "shared" / "recordings"
POUND = 4.448


def _asked(recording: pd.DataFrame) -> list[str]:
    return [f"{i.where} -> {i.advice}" for i in check_recording(recording) if i.name == "grip_of_no_tire"]


def _sweeps(fx: float = 1.0, fy: float = 1.1) -> pd.DataFrame:
    """A sweep of the slip angle, then one of the slip ratio, on a tire of this grip."""
    slip, still = 0.2 * np.sin(np.linspace(0.0, 12.0, 300)), np.zeros(300)
    force = 4000.0 * np.tanh(12.0 * slip)
    return pd.DataFrame(
        {
            "time": np.arange(600) / 50.0,
            "slip_angle": np.concatenate([slip, still]),
            "slip_ratio": np.concatenate([still, slip]),
            "normal_load": np.full(600, 4000.0) + np.tile([0.0, 5.0, -5.0], 200),
            "fx": np.concatenate([still, fx * force]),
            "fy": np.concatenate([-fy * force, still]),
        }
    )


@pytest.mark.parametrize(("fx", "fy"), [(1.0, 1.1), (0.7, 1.2), (1.6, 1.7), (0.45, 0.5)])
def test_the_grip_of_tires_is_no_question(fx, fy):
    assert _asked(_sweeps(fx, fy)) == []


def test_a_force_in_pounds_called_newtons_is_asked_about():
    (asked,) = _asked(_sweeps(fx=1.0 / POUND))
    assert asked.startswith("fx, 0.2")
    assert ", fy 1.0" in asked
    assert "of the load at large slip" in asked
    assert "is that so?" in asked
    assert "--unit fx=lbf" in asked
    (asked,) = _asked(_sweeps(fy=1.1 / POUND))
    assert "--unit fy=lbf" in asked
    assert len(_asked(_sweeps(fx=1.5 / POUND, fy=1.6))) == 1  # a racing tire: above 0.3, a fifth of the other


def test_small_slip_tells_nothing():
    assert _asked(_sweeps(fx=1.0 / POUND).assign(slip_ratio=0.01)) == []


def test_the_example_is_asked_about_where_its_force_is_in_pounds():
    recording = read_recording(ROOT / "examples" / "rig_run.csv", axes="ISO")
    assert _asked(recording) == []
    (asked,) = _asked(recording.assign(fy=recording["fy"] / POUND))
    assert "--unit FY=lbf" in asked


@pytest.mark.skipif(not SHARED.exists(), reason="the shared recordings are not here")
def test_no_real_recording_is_asked_about():
    files = [*SHARED.glob("calspan/*.mat"), *SHARED.glob("tydex/*.tdx")]
    assert len(files) == 2
    assert [_asked(read_recording(file)) for file in files] == [[], []]
