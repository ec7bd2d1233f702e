"""What check_recording says of a brake or drive test: which slip ratio, and signs and sizes beside it."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.recordings import check_recording, read_recording

DEFINITIONS = {
    "wheel_speed x loaded_radius / speed - 1": lambda free, loaded: loaded - 1.0,
    "1 - wheel_speed x effective_radius / speed": lambda free, loaded: 1.0 - free,
    "wheel_speed x effective_radius / speed,": lambda free, loaded: free,
    "1 - 1 / (wheel_speed x effective_radius / speed)": lambda free, loaded: 1.0 - 1.0 / free,
}


def braked(seed=0, noise=0.0005, low=-0.25, high=0.25):
    """Brake and drive sweeps at three loads; the radii fall with load, and slip counts from free rolling."""
    rng = np.random.default_rng(seed)
    slip = np.interp(np.tile(np.linspace(0.0, 4.0, 600), 3), [0, 1, 3, 4], [0.0, high, low, 0.0])
    load = np.repeat([400.0, 700.0, 1000.0], 600)
    effective, loaded = 0.201 - load / 4e5, 0.200 - load / 1e5
    speed = 11.0 + 0.02 * rng.standard_normal(slip.size)
    return pd.DataFrame(
        {
            "time": np.arange(slip.size) * 0.02,
            "slip_angle": 0.001 * rng.standard_normal(slip.size),
            "slip_ratio": slip + noise * rng.standard_normal(slip.size),
            "normal_load": load,
            "speed": speed,
            "wheel_speed": (1.0 + slip) * speed / effective,
            "effective_radius": effective,
            "loaded_radius": loaded,
            "fx": load
            * (2.3 * np.sin(1.6 * np.arctan(22.0 * slip)) - 0.014 + 0.01 * rng.standard_normal(slip.size)),
        }
    )


def names(frame):
    return {issue.name for issue in check_recording(frame)}


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("without", [[], ["loaded_radius"], ["effective_radius"], ["wheel_speed"]])
def test_a_slip_ratio_from_free_rolling_is_not_reported(seed, without):
    assert check_recording(braked(seed).drop(columns=without)) == []


@pytest.mark.parametrize(("low", "high"), [(-0.25, 0.0), (0.0, 0.25), (-0.99, 0.0)])
def test_nor_is_one_of_braking_or_driving_alone(low, high):
    assert check_recording(braked(low=low, high=high)) == []
    assert check_recording(braked(low=low, high=high).drop(columns="wheel_speed")) == []


@pytest.mark.parametrize("said", DEFINITIONS)
@pytest.mark.parametrize("without", [[], ["effective_radius"]])
def test_another_definition_is_named(said, without):
    frame = braked()
    ratios = [frame["wheel_speed"] * frame[f"{r}_radius"] / frame["speed"] for r in ("effective", "loaded")]
    frame["slip_ratio"] = DEFINITIONS[said](*ratios)
    found = [
        i for i in check_recording(frame.drop(columns=without)) if i.name == "slip_ratio_defined_otherwise"
    ]
    assert len(found) == 1
    assert without or said in found[0].where + ","


def test_a_slip_ratio_by_the_loaded_radius_shows_in_the_force_without_the_speeds():
    frame = braked()
    frame["slip_ratio"] = frame["wheel_speed"] * frame["loaded_radius"] / frame["speed"] - 1.0
    assert names(frame.drop(columns=["wheel_speed", "effective_radius"])) == {"force_at_no_slip"}


def test_a_force_against_the_slip_is_reported():
    assert names(braked().assign(fx=lambda f: -f["fx"])) == {"fx_of_other_sign"}


@pytest.mark.parametrize(("unit", "found"), [(1.0, set()), (1000.0, {"implausible_moment"})])
def test_a_moment_with_an_arm_longer_than_the_wheel_is_reported(unit, found):
    frame = braked()
    assert names(frame.assign(mz=0.01 * unit * frame["fx"])) == found


def test_a_file_with_speeds_and_the_rolling_radius_has_a_slip_ratio(tmp_path):
    """Its brake ramps were fitted as if the wheel rolled freely: 19% of Mz was left, and no Fx was fitted."""
    frame = braked()
    names = {
        "wheel_speed": "n [rad/s]",
        "effective_radius": "rolling radius [m]",
        "slip_angle": "alpha [rad]",
    }
    frame.drop(columns=["slip_ratio", "loaded_radius"]).rename(columns=names).to_csv(tmp_path / "a.csv")
    read = read_recording(tmp_path / "a.csv")
    assert read["slip_ratio"].to_numpy() == pytest.approx(frame["slip_ratio"].to_numpy(), abs=3e-3)
    assert any(
        "computed as wheel_speed x effective_radius / speed - 1" in note for note in read.attrs["notes"]
    )
    assert list(read)[:4] == ["time", "slip_angle", "slip_ratio", "normal_load"]


@pytest.mark.parametrize("factor", [60.0 / (2.0 * np.pi), 2750.0])
def test_speeds_that_no_wheel_has_give_none(tmp_path, factor):
    """Revolutions per minute without their unit; the flat belt's radius, which is up to 3,755 m."""
    frame = braked().drop(columns="slip_ratio").eval(f"effective_radius = {factor} * effective_radius")
    frame.to_csv(tmp_path / "a.csv", index=False)
    assert "slip_ratio" not in read_recording(tmp_path / "a.csv")


@pytest.mark.parametrize("at", [None, 0.0])
def test_braking_without_a_slip_ratio_is_said(at):
    frame = braked().drop(columns=["slip_ratio", "wheel_speed"])
    frame = frame if at is None else frame.assign(slip_ratio=at)
    (issue,) = check_recording(frame)
    assert issue.name == "braked_at_no_slip"
    assert "no slip ratio was measured, but fx changes, up to 2.3" in issue.where
    rolling = frame.assign(
        fx=-0.014 * frame["normal_load"] - 0.3 * frame["normal_load"] * frame["slip_angle"]
    )
    assert check_recording(rolling) == []
