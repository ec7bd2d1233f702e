"""A unit that changes within a recording is named, and a change of friction is none."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.recordings import check_recording
from tire_pipeline.recordings.unit_jumps import UnitJump, each_once, unit_jumps

TIRE = TireModel.from_coefficients({"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2})
ICE = TIRE.replace(PDY1=0.2248, PKY1=-9.5)


def sweeps(after: TireModel = TIRE) -> pd.DataFrame:
    """Twenty sweeps at three loads, the second half with another tire."""
    rng = np.random.default_rng(1)
    angle = np.tile(0.2 * np.sin(np.linspace(0.0, 2.0 * np.pi, 100)), 20)
    load = np.repeat(np.tile([2000.0, 4000.0, 6000.0, 4000.0], 5), 100)
    forces = [m.forces(slip_angle=angle, normal_load=load, limits="ignore").fy for m in (TIRE, after)]
    fy = np.where(np.arange(2000) < 1000, *forces) + 30.0 * rng.standard_normal(2000)
    columns = {"time": 0.01 * np.arange(2000), "slip_angle": angle, "normal_load": load, "fy": fy}
    return pd.DataFrame(columns | {"pressure": 200e3})


def scaled(channel: str, factor: float) -> pd.DataFrame:
    table = sweeps()
    table.loc[1000:, channel] *= factor
    return table


@pytest.mark.parametrize(
    ("channel", "factor", "before", "after"),
    [
        ("fy", 1e-3, "N", "kN"),
        ("fy", 0.2248, "N", "lbf"),
        ("fy", 4.448, "lbf", "N"),
        ("slip_angle", 57.3, "rad", "deg"),
        ("slip_angle", 1 / 57.3, "deg", "rad"),
        ("normal_load", 1e-3, "N", "kN"),
        ("pressure", 1 / 6894.76, "Pa", "psi"),
    ],
)
def test_channel_row_time_and_units_are_named(channel, factor, before, after):
    (jump,) = unit_jumps(scaled(channel, factor))
    assert (jump.channel, jump.before, jump.after) == (channel, before, after)
    assert jump.row == pytest.approx(1000, abs=30)
    assert jump.time == pytest.approx(10.0, abs=0.3)
    (issue,) = [i for i in check_recording(scaled(channel, factor)) if i.name == "unit_changes"]
    assert f"{channel} is in {before}" in issue.where
    assert issue.rows == ((jump.row, jump.row),)


@pytest.mark.parametrize("after", [TIRE, ICE, TIRE.replace(PDY1=0.2248), TIRE.replace(PDY1=0.5)])
def test_friction_is_no_unit(after):
    assert unit_jumps(sweeps(after)) == []


@pytest.mark.parametrize(
    ("unit", "changes"), [("ft-lb", 1.36), ("ft-lb", 1 / 1.36), ("N-m", 1.36), ("N-m", 9.8)]
)
def test_a_moment_that_changes_by_a_small_ratio_is_no_unit(unit, changes):
    """Camber, or the other side of the tire, change Mz by as much as foot-pounds are newton metres."""
    table = sweeps()
    table["mz"] = 0.03 * table["fy"] * np.where(np.arange(len(table)) < 1000, 1.0, changes)
    table.attrs["file_units"] = {"mz": unit}
    assert unit_jumps(table) == []


def test_a_step_of_a_load_in_kilograms_is_no_pound():
    """From 2,500 to 5,500 N is the ratio of the two units; a saturated slip stiffness is the same at both."""
    angle = np.tile(0.05 * np.sin(np.linspace(0.0, 2.0 * np.pi, 500)), 4)
    load = np.repeat([2500.0, 5500.0], 1000)
    fy = TIRE.replace(PKY2=1.0).forces(slip_angle=angle, normal_load=load, limits="ignore").fy
    table = pd.DataFrame({"slip_angle": angle, "normal_load": load, "fy": fy})
    table.attrs["file_units"] = {"normal_load": "kg", "fy": "kg"}
    assert unit_jumps(table) == []


def test_nothing_is_explained_from_a_channel_in_two_units():
    prepared = prepare(TIRE, scaled("fy", 0.2248))
    assert prepared.stopped == "unusable"
    assert "fy is in N up to about row" in prepared.question.why
    assert not prepare(TIRE, sweeps()).stopped


def test_a_slip_ratio_that_says_locked_throughout_was_not_measured():
    table = sweeps()
    table["slip_ratio"] = -1.0 + 1e-3 * np.random.default_rng(0).standard_normal(len(table))
    (issue,) = [i for i in check_recording(table) if i.name == "slip_not_measured"]
    assert "a locked wheel" in issue.where
    assert issue.advice == "taken as not measured, and as 0"
    table["slip_ratio"] = np.linspace(-1.0, 0.0, len(table))
    assert "slip_not_measured" not in {i.name for i in check_recording(table)}


LOAD = 3000.0 * (1.5 + np.sin(np.arange(600.0)))
FY_JUMPS = UnitJump("fy", 300, 3.0, "N", "lbf", 0.2248)
LOAD_JUMPS = UnitJump("normal_load", 302, 3.02, "lbf", "N", 4.448)


def later(fy: float, load: float) -> dict[str, np.ndarray]:
    """Force and load, each by a factor larger from row 300 on."""
    half = np.arange(LOAD.size) >= 300
    return {"fy": 0.8 * LOAD * np.where(half, fy, 1.0), "normal_load": LOAD * np.where(half, load, 1.0)}


@pytest.mark.parametrize(
    ("fy", "load", "named"),
    [
        (0.2248, 1.0, "fy"),
        (0.2248 * 1.3, 1.3, "fy"),
        (1.0, 4.448, "normal_load"),
        (0.8, 0.8 * 4.448, "normal_load"),
    ],
)
def test_of_two_jumps_that_are_one_the_levels_tell_which(fy, load, named):
    (jump,) = each_once([FY_JUMPS, LOAD_JUMPS], later(fy, load))
    assert (jump.channel, jump.instead) == (named, "")


def test_both_are_named_in_one_sentence_where_the_levels_do_not_tell():
    (jump,) = each_once([FY_JUMPS, LOAD_JUMPS], later(0.2248 * 2.1, 2.1))
    assert "fy is in N up to about row 300" in str(jump)
    assert "or normal_load is in lbf before it, and in N after it (the recording does not tell which)" in str(
        jump
    )


def test_jumps_at_other_rows_or_by_other_ratios_are_two():
    far, other = LOAD_JUMPS._replace(row=450), LOAD_JUMPS._replace(ratio=1000.0)
    for two in (far, other):
        assert len(each_once([FY_JUMPS, two], later(0.2248, 1.0))) == 2
