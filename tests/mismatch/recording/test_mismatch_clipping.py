"""Before any explanation: whether forces are cut at a limit of their sensor."""

from itertools import pairwise

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.mismatch.recording.prepare import prepare

DRAWS = [*range(3), *(pytest.param(seed, marks=pytest.mark.long) for seed in range(3, 10))]


def slow_sine(limit=np.inf, digits=5, noise=0.0):
    t = np.arange(0.0, 180.0, 0.01)
    force = 5500.0 * np.sin(2.0 * np.pi * t / 90.0) + noise * np.random.default_rng(0).standard_normal(t.size)
    force = np.clip(force, -limit, limit)
    return t, np.array([float(f"{f:.{digits}g}") for f in force])


@pytest.mark.parametrize(
    "digits", [3, pytest.param(4, marks=pytest.mark.ci), 5, pytest.param(6, marks=pytest.mark.ci), 15]
)
@pytest.mark.parametrize("noise", [0.0, 0.3, 30.0])
def test_the_crest_of_a_slow_sine_in_few_digits_is_not_clipped(tire, digits, noise):
    t, force = slow_sine(digits=digits, noise=noise)
    r = pd.DataFrame({"time": t, "slip_angle": force / 1e5, "normal_load": 4000.0 + t, "fy": force})
    assert [f for f in prepare(tire, r).findings if f.name == "clipping"] == []


@pytest.mark.parametrize("limit", [5490.0, 5300.0, 3000.0])
@pytest.mark.parametrize("digits", [4, 5, 15])
def test_a_limit_is_found_whatever_the_digits(tire, limit, digits):
    t, force = slow_sine(limit, digits)
    r = pd.DataFrame({"time": t, "slip_angle": force / 1e5, "normal_load": 4000.0 + t, "fy": force})
    assert "fy" in [f.channel for f in prepare(tire, r).findings if f.name == "clipping"]


@pytest.mark.parametrize("limit", [1500.0, 2500.0])
def test_a_short_recording_that_is_cut_for_much_of_its_time_is_clipped(tire, limit):
    """Two limits among few values: how often values come back is counted without them."""
    t = np.arange(0.0, 25.0, 0.1)
    noise = 15.0 * np.random.default_rng(0).standard_normal(t.size)
    force = 4000.0 * np.sin(2.0 * np.pi * t / 12.5) + noise
    r = pd.DataFrame({"time": t, "slip_angle": force / 1e5, "normal_load": 4000.0 + t})
    r["fy"] = np.clip(force, -limit, limit)
    (found,) = [f for f in prepare(tire, r).findings if f.name == "clipping"]
    assert found.limits == (-limit, limit)


def _points(count, seed, noise=15.0):
    """Steady points of a made-up force, in the digits of a table."""
    rng = np.random.default_rng(seed)
    slip = rng.uniform(-0.18, 0.18, count)
    load = rng.choice([2000.0, 3500.0, 5000.0], count)
    fy = load * np.tanh(12.0 * slip) + noise * rng.standard_normal(count)
    return pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": np.round(fy, 2)})


def _limits(tire, points):
    return [f for f in prepare(tire, points).findings if f.name == "clipping"]


@pytest.mark.parametrize("seed", DRAWS)
def test_three_of_few_points_at_a_limit_of_either_sign_are_clipped(tire, seed):
    points = _points(30, seed)
    limit = np.sort(np.abs(points["fy"]))[-3] - 1.0
    assert len(_limits(tire, points.assign(fy=points["fy"].clip(-limit, limit)))) == 1
    assert _limits(tire, points) == []


@pytest.mark.parametrize("seed", DRAWS)
def test_points_of_a_tire_that_are_cut_at_one_value_are_clipped_and_nothing_else(tire, seed):
    """Steady points have no time line; four exactly at the end of the range say enough."""
    rng = np.random.default_rng(seed)
    slip = rng.uniform(-0.18, 0.18, 80)
    load = rng.choice([2000.0, 3500.0, 5000.0], 80) + rng.normal(0.0, 5.0, 80)
    fy = tire.forces(slip_angle=slip, normal_load=load).fy + rng.normal(0.0, 15.0, 80)
    points = pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": np.clip(fy, -3000.0, 3000.0)})
    assert [found.name for found in prepare(tire, points).findings] == ["clipping"]


@pytest.mark.parametrize("seed", DRAWS)
def test_points_that_coincide_for_another_reason_are_not_clipped(tire, seed):
    """Coarse digits where the tire slides, a table with each row four times, a curve with a symmetry."""
    points = _points(60, seed, noise=0.0)
    sliding = points.assign(fy=np.round(points["fy"] / 100.0))
    repeated = pd.concat([points] * 4).sample(frac=1.0, random_state=seed).assign(row=range(240))
    mirrored = pd.concat([points, points.assign(slip_angle=-points["slip_angle"], fy=-points["fy"])])
    for table in (sliding, repeated, mirrored):
        assert _limits(tire, table) == []


def test_no_limit_is_named_where_no_sample_stands_at_one(tire, record, draws):
    """A load sensitivity was taken for clipping twice: the largest forces are the ones that lack."""
    for seed in draws:
        r = record(seed)
        low = 1.0 - 0.25 * np.clip((r["normal_load"] - 3000.0) / 3000.0, 0.0, None)
        assert _limits(tire, r.assign(fy=r["fy"] * low)) == []


@pytest.mark.parametrize("limit", [500.0, 1000.0])
def test_a_force_that_is_cut_for_most_of_its_time_is_clipped(tire, limit):
    t = np.arange(0.0, 50.0, 0.1)
    noise = 15.0 * np.random.default_rng(0).standard_normal(t.size)
    force = 2000.0 + 2500.0 * np.sin(2.0 * np.pi * t / 12.5) + noise
    r = pd.DataFrame({"time": t, "slip_angle": force / 1e5, "normal_load": 4000.0 + t})
    r["fy"] = np.minimum(force, limit)
    (found,) = _limits(tire, r)
    assert found.bad.mean() > 0.6
    assert found.limits[1] == limit


@pytest.mark.parametrize("rest", [0.0, 1500.0])
def test_a_force_that_rests_while_nothing_moves_is_not_clipped(tire, rest):
    """A log that stands for most of its time: the force is held there, and not at a limit."""
    t = np.arange(0.0, 50.0, 0.1)
    moves = np.maximum(t - 40.0, 0.0)
    force = rest - 100.0 * moves
    r = pd.DataFrame({"time": t, "slip_angle": force / 1e5, "normal_load": 4000.0 + moves, "fy": force})
    assert _limits(tire, r) == []


def test_a_limit_is_found_beside_the_zero_at_which_a_force_rests(tire):
    """Each end is judged by itself: the zero is no limit, and does not hide the other end."""
    t = np.arange(0.0, 100.0, 0.1)
    pulse = np.maximum(t - 65.0, 0.0)
    moves = np.random.default_rng(0).standard_normal(t.size)
    force = np.maximum(-200.0 * pulse + 15.0 * moves * (pulse > 0.0), -4000.0)
    force = np.where(pulse > 0.0, np.minimum(force, -1.0), 0.0)
    r = pd.DataFrame({"time": t, "slip_angle": force / 1e5 + 1e-4 * moves, "normal_load": 4000.0 + t})
    r["fy"] = force
    (found,) = _limits(tire, r)
    assert found.limits == (-4000.0, np.inf)
    assert found.bad.mean() < 0.2


def one_sided_drive(tire, side):
    """Time, slip, load and a force of one sign."""
    t = np.arange(0.0, 60.0, 0.04)
    rng = np.random.default_rng(0)
    r = pd.DataFrame({"time": t, "slip_angle": 0.05 + 0.04 * np.sin(0.5 * t)})
    r["normal_load"] = 4000.0 + 10.0 * rng.standard_normal(t.size)
    force = tire.forces(slip_angle=r["slip_angle"], normal_load=r["normal_load"]).fy
    turn = side * float(np.sign(np.median(force)))
    r["slip_angle"] *= turn
    r["fy"] = turn * force + 20.0 * rng.standard_normal(t.size)
    return r


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_force_that_falls_to_the_far_end_of_its_range_is_not_clipped(tire, side):
    """A line that was off for two seconds, in a drive to one side: 0 is the far end of the range.

    It was called clipped with 0.98, and all predicted forces were cut at 0: in a real drive the error rose
    from 0.8 to 3.9 N.
    """
    r = one_sided_drive(tire, side)
    strong = r["fy"].abs().rolling(50, center=True).min().idxmax()
    r.loc[strong - 25 : strong + 24, "fy"] = np.repeat([0.0, 1e-9 * side], 25)
    assert [f for f in prepare(tire, r).findings if f.name == "clipping"] == []


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_limit_of_a_drive_to_one_side_is_at_its_own_end(tire, side):
    """Where it stands in the range says which end a limit is at, not its sign."""
    r = one_sided_drive(tire, side)
    size = r["fy"].abs()
    most, least = size.quantile(0.6), size.quantile(0.2)
    for limit, force in ((most, np.minimum(size, most)), (least, np.maximum(size, least))):
        (found,) = [f for f in prepare(tire, r.assign(fy=side * force)).findings if f.name == "clipping"]
        assert found.limits == (
            (-np.inf, side * limit) if side * limit > _middle(side * force) else (side * limit, np.inf)
        )


def _middle(x):
    return 0.5 * (x.min() + x.max())


def _run(tire, slip_angle, normal_load):
    """A run of a tire whose inputs are recorded as they are."""
    time = 0.02 * np.arange(slip_angle.size)
    fy = tire.forces(slip_angle=slip_angle, normal_load=normal_load).fy
    fy = fy + 20.0 * np.random.default_rng(0).standard_normal(time.size)
    return pd.DataFrame({"time": time, "slip_angle": slip_angle, "normal_load": normal_load, "fy": fy})


def _levels(*levels, held=600, ramp=40):
    """Each level held, with a ramp to the next one."""
    stands = [np.full(held, level) for level in levels]
    ramps = [np.linspace(a, b, ramp + 2)[1:-1] for a, b in pairwise(levels)]
    return np.concatenate([part for pair in zip(stands, [*ramps, []], strict=True) for part in pair])


@pytest.mark.parametrize("loads", [(2050.0, 5750.0), (2000.0, 5000.0, 3500.0)])
def test_a_load_that_is_set_to_levels_is_not_clipped(tire, loads):
    """A commanded load was called clipped with 0.98: its largest and smallest level are held exactly."""
    load = _levels(*loads)
    slip = 0.2 * np.sin(2.0 * np.pi * np.arange(load.size) / 250.0)
    assert _limits(tire, _run(tire, slip, load)) == []


@pytest.mark.parametrize("seed", DRAWS)
def test_a_slip_angle_that_waits_at_the_ends_of_a_sweep_is_not_clipped(tire, seed):
    wait = 10 + 5 * (seed % 3)
    slip = np.tile(_levels(-0.2, 0.2, -0.2, held=wait, ramp=100)[:-wait], 9)
    load = 4000.0 + 15.0 * np.random.default_rng(seed).standard_normal(slip.size)
    assert _limits(tire, _run(tire, slip, load)) == []


def test_an_input_that_is_cut_is_clipped(tire):
    """The true input leaves its channel, and the forces with it."""
    turn = 2.0 * np.pi * np.arange(2000)
    slip, load = 0.06 * np.sin(turn / 250.0), 4000.0 + 2000.0 * np.sin(turn / 850.0)
    cut = {"slip_angle": np.clip(slip, -0.045, 0.045), "normal_load": np.minimum(load, 5200.0)}
    limits = {"slip_angle": (-0.045, 0.045), "normal_load": (-np.inf, 5200.0)}
    for name, recorded in cut.items():
        (found,) = _limits(tire, _run(tire, slip, load).assign(**{name: recorded}))
        assert (found.channel, found.limits) == (name, limits[name])
