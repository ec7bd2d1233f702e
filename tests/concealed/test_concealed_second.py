"""The second simulator: its physics, its causes at the size asked for, the same case from the same seed."""

import numpy as np
import pytest

from tire_pipeline.concealed.second import CAUSES, NOTHING, content_hash, draw_case, places
from tire_pipeline.concealed.second.roll import Course, Rolled, roll
from tire_pipeline.concealed.second.tire import Tire, draw_tire

TIRE = Tire()


def rolled(tire: Tire = TIRE, samples: int = 200, start=None, **channels) -> Rolled:
    """A tire on constant or given channels, at 100 Hz."""
    held = {
        "slip_angle": 0.0,
        "slip_ratio": 0.0,
        "camber": 0.0,
        "normal_load": 4000.0,
        "speed": 18.0,
        "pressure": 2.3e5,
        "turn_slip": 0.0,
        "surface": 1.0,
    } | channels
    filled = {name: np.broadcast_to(value, samples).astype(float) for name, value in held.items()}
    return roll(tire, Course(np.arange(samples) / 100.0, **filled), start)


def steady(name: str, tire: Tire = TIRE, **channels) -> float:
    return float(getattr(rolled(tire, **channels), name)[-1])


def stiffness(tire: Tire, load: float) -> float:
    """Cornering stiffness, N/deg, by half a degree."""
    change = steady("fy", tire, slip_angle=np.radians(0.5), normal_load=load)
    return -2.0 * (change - steady("fy", tire, normal_load=load))


def relaxation_length(load: float) -> float:
    """Way (m) that a step of half a degree needs: the area above the response."""
    angle = np.where(np.arange(300) < 100, 0.0, np.radians(0.5))
    fy = rolled(TIRE._replace(lag=1.0), 300, slip_angle=angle, normal_load=load).fy
    return float(np.sum(1.0 - (fy[100:] - fy[99]) / (fy[-1] - fy[99])) * 0.01 * 18.0)


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.long) for seed in range(1, 6))])
def test_a_drawn_tire_is_a_passenger_cars(seed: int) -> None:
    tire = draw_tire(np.random.default_rng(seed))
    assert 500.0 < stiffness(tire, 4000.0) < 2500.0
    grip = -steady("fy", tire, slip_angle=np.radians(11.0)) / 4000.0
    assert 0.8 < grip < 1.3
    assert 0.8 < steady("fx", tire, slip_ratio=0.15) / 4000.0 < 1.3


def test_stiffness_bends_over_load() -> None:
    over = [stiffness(TIRE, load) / load for load in (2000.0, 4000.0, 6000.0, 8000.0)]
    assert np.all(np.diff(over) < 0.0)


def test_trail_is_positive_and_falls_with_slip() -> None:
    trails = []
    for degrees in (1.0, 3.0, 5.0, 8.0):
        run = rolled(TIRE._replace(ply_steer=0.0, conicity=0.0), slip_angle=np.radians(degrees))
        trails.append(-run.mz[-1] / run.fy[-1])
    assert min(trails) > 0.0
    assert np.all(np.diff(trails) < 0.0)


def test_friction_falls_with_load() -> None:
    grips = [
        -steady("fy", slip_angle=np.radians(12.0), normal_load=load) / load
        for load in (2000.0, 4000.0, 7000.0)
    ]
    flat = TIRE._replace(load_gain=-TIRE.friction_pressure)
    kept = [
        -steady("fy", flat, slip_angle=np.radians(12.0), normal_load=load) / load for load in (2000.0, 7000.0)
    ]
    assert np.all(np.diff(grips) < 0.0)
    assert grips[0] / grips[-1] > kept[0] / kept[-1]


def test_relaxation_is_a_part_of_the_circumference_and_grows_with_load() -> None:
    lengths = [relaxation_length(load) for load in (2000.0, 4000.0, 7000.0)]
    assert np.all(np.diff(lengths) > 0.0)
    assert 0.5 * TIRE.radius < lengths[1] < 2.5 * TIRE.radius


def test_warm_rubber_grips_as_grosch_found() -> None:
    """Above the speed of the hump, warming raises friction up to a temperature, and lowers it beyond."""
    hot = TIRE._replace(temperature_gain=1.0, skin_capacity=1e9)
    grips = [
        -rolled(hot, 30, np.array([degrees, degrees]), slip_angle=np.radians(15.0)).fy[15]
        for degrees in (10.0, 45.0, 70.0, 110.0, 160.0)
    ]
    best = int(np.argmax(grips))
    assert 0 < best < len(grips) - 1
    assert np.all(np.diff(grips[: best + 1]) > 0.0)
    assert np.all(np.diff(grips[best:]) < 0.0)


def test_sliding_heats_and_standing_still_in_slip_cools() -> None:
    sliding = rolled(samples=1000, slip_angle=0.2, start=np.array([45.0, 45.0])).tread_temperature
    free = rolled(samples=1000, start=np.array([45.0, 45.0])).tread_temperature
    assert sliding[-1] > 46.0
    assert free[-1] < 45.0


def test_the_contact_takes_energy_and_gives_none() -> None:
    time = np.arange(1500) / 100.0
    run = rolled(
        TIRE._replace(lag=1.0),
        1500,
        slip_angle=0.2 * np.sin(5.0 * time),
        slip_ratio=0.1 * np.sin(3.0 * time),
        camber=0.05 * np.sin(time),
    )
    assert np.min(run.friction_power) >= 0.0
    assert np.sum(run.sliding_power) > 0.0
    assert np.sum(run.friction_power) == pytest.approx(np.sum(run.sliding_power), rel=0.15)


def test_mirrored_course_gives_mirrored_forces() -> None:
    tire = TIRE._replace(ply_steer=0.0, conicity=0.0)
    left = rolled(tire, slip_angle=0.06, camber=0.03, slip_ratio=0.02, turn_slip=0.01)
    right = rolled(tire, slip_angle=-0.06, camber=-0.03, slip_ratio=0.02, turn_slip=-0.01)
    np.testing.assert_allclose(left.fy, -right.fy, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(left.mz, -right.mz, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(left.fx, right.fx, rtol=1e-9, atol=1e-6)


def test_a_drum_and_a_curved_path_act_as_in_the_books() -> None:
    drum = TIRE._replace(drum_curvature=1.2)
    assert stiffness(drum, 4000.0) < stiffness(TIRE, 4000.0)
    straight = steady("fy")
    assert steady("fy", turn_slip=0.05) < straight
    assert steady("fy", camber=0.05) < straight


def test_places_are_those_of_the_tire() -> None:
    assert [getattr(places, name.upper()) for name in Tire._fields] == list(range(len(Tire._fields)))


NOT_BRAKED, BRAKED = 9, pytest.param(41, marks=pytest.mark.ci)


@pytest.mark.parametrize("seed", [NOT_BRAKED, BRAKED])
@pytest.mark.parametrize("name", CAUSES)
def test_a_cause_changes_the_forces_by_the_size_asked_for(name: str, seed: int) -> None:
    """With no longitudinal force none leaks into the lateral one, and the truth says so."""
    truth = draw_case(np.random.default_rng(seed), name, 2.0, rows=1200).truth
    change = np.concatenate(
        [truth.recording_with - truth.recording_without, truth.held_with - truth.held_without]
    )
    found = np.max(np.sqrt(np.mean(change**2, axis=0)) / truth.unit)
    assert found == pytest.approx(truth.strengths[0], rel=1e-6)
    braked = np.sqrt(np.mean(truth.recording_without[:, 0] ** 2)) > truth.unit[0]
    if name == "crosstalk" and truth.parameters[0]["channel"] == "fy" and not braked:
        assert found < 1.0
    elif not CAUSES[name].fixed:
        assert found == pytest.approx(2.0, rel=0.05)
    assert truth.causes == (name,)


@pytest.mark.long
def test_a_cause_falls_short_only_where_physics_ends() -> None:
    short = 0
    sized = [(name, cause.most) for name, cause in CAUSES.items() if not cause.fixed]
    for name, most in sized:
        for seed in range(20):
            truth = draw_case(np.random.default_rng(seed), name, 2.0, rows=1200).truth
            if truth.strengths[0] < 1.9:
                short += 1
                assert truth.parameters[0]["size"] == most
    assert 0 < short < 0.02 * 20 * len(sized)


def test_nothing_changes_nothing_and_noise_is_all_that_is_left() -> None:
    case = draw_case(np.random.default_rng(5), NOTHING, rows=1200)
    truth = case.truth
    np.testing.assert_array_equal(truth.recording_with, truth.recording_without)
    left = case.recording[["fx", "fy", "mz"]].to_numpy() - truth.recording_without
    assert np.all(np.std(left, axis=0) < 1.6 * truth.unit)
    assert truth.causes == ()


def test_two_causes_and_the_same_seed() -> None:
    names = ("surface friction", "drift")
    one = draw_case(np.random.default_rng(9), names, (1.0, 3.0), rows=1200)
    two = draw_case(np.random.default_rng(9), names, (1.0, 3.0), rows=1200)
    assert one.recording.equals(two.recording)
    assert all(a.equals(b) for a, b in zip(one.references, two.references, strict=True))
    assert one.truth.parameters == two.truth.parameters
    assert one.truth.strengths == pytest.approx((1.0, 3.0), rel=0.05)
    assert not one.recording.equals(draw_case(np.random.default_rng(10), names, rows=1200).recording)


def test_what_gives_a_cause_away_is_not_recorded() -> None:
    case = draw_case(np.random.default_rng(2), "unknown camber", 4.0, rows=1200)
    without = draw_case(np.random.default_rng(2), "unknown camber", 0.5, rows=1200)
    np.testing.assert_allclose(case.recording.camber, without.recording.camber, atol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"cause": "magic"}, "no cause 'magic'"),
        ({"cause": "drift", "rows": 20_000}, "rows is 20000"),
        ({"cause": ("drift", "delay"), "strength": (1.0,)}, "1 strengths for 2 causes"),
    ],
)
def test_a_wrong_call_is_told(arguments: dict, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        draw_case(np.random.default_rng(0), **arguments)


def test_the_committed_content_is_the_stated_one() -> None:
    from pathlib import Path

    page = Path(__file__).parents[2] / "docs" / "decisions" / "simulators.md"
    assert content_hash() in page.read_text(encoding="utf-8")
