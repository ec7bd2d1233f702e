"""Physical sanity of the brush tire: what must emerge, and what must not be there."""

from collections.abc import Iterable

import numpy as np
import pytest
from scipy.stats import binomtest

from tire_pipeline.concealed.brush_rig import brush
from tire_pipeline.concealed.brush_rig.constants import TireConstants, draw_constants

DT = 0.02


def tire(seed: int = 0) -> TireConstants:
    return draw_constants(np.random.default_rng(seed))


def rows(constants: TireConstants, n: int, **values: float | np.ndarray) -> np.ndarray:
    table = np.zeros((n, 7))
    table[:, brush.FZ] = constants.nominal_load
    table[:, brush.SPEED] = constants.nominal_speed
    table[:, brush.PRESSURE] = constants.nominal_pressure
    for name, value in values.items():
        table[:, getattr(brush, name)] = value
    return table


def rolled(constants: TireConstants, table: np.ndarray, n_bristles: int = 24, **effects: float) -> np.ndarray:
    strengths = np.zeros(brush.N_EFFECTS)
    for name, value in effects.items():
        strengths[getattr(brush, name)] = value
    roll = brush.roll_transient if "E_RELAXATION" in effects else brush.roll_steady
    return roll(constants.vector(), strengths, table, DT, 0.0, n_bristles)


def surely_at_least(held: Iterable[bool]) -> float:
    """Lower end of the rate's 95% interval (Wilson)."""
    each = list(held)
    return float(binomtest(sum(map(bool, each)), len(each)).proportion_ci(0.95, "wilson").low)


def step_distance(constants: TireConstants, speed: float, spring: float = 1.0) -> float:
    """Distance rolled until fy is at 63% of its end value after a step of 0.5 deg, m."""
    angle = np.where(np.arange(600) < 50, 0.0, np.deg2rad(0.5))
    table = rows(constants, 600, ALPHA=angle, SPEED=speed)
    dt = 0.02 / speed  # 2 cm a sample
    strengths = np.zeros(brush.N_EFFECTS)
    strengths[brush.E_RELAXATION] = spring
    fy = brush.roll_transient(constants.vector(), strengths, table, dt, 0.0, 24)[:, 1]
    share = fy[50:] / fy[-1]
    return float(0.02 * np.argmax(share > 1.0 - np.exp(-1.0)))


def test_relaxation_is_a_distance_and_not_a_time():
    constants = tire()
    distances = [step_distance(constants, speed) for speed in (3.0, 10.0, 40.0)]
    assert max(distances) - min(distances) <= 0.04 + 1e-9


def test_relaxation_emerges_from_carcass_spring_and_contact_length():
    """In nine of ten drawn tires within a fifth of C / k + a, surely; and always shorter."""
    shares = []
    for seed in range(200):
        constants = tire(seed)
        slope = rolled(constants, rows(constants, 1, ALPHA=1e-3))[0, 1] / 1e-3
        expected = slope / constants.carcass_y + constants.half_length
        shares.append(step_distance(constants, 10.0) / expected)
    assert max(shares) < 1.0
    assert surely_at_least(share > 0.8 for share in shares) > 0.9


def test_a_softer_carcass_relaxes_over_a_longer_distance():
    constants = tire()
    assert step_distance(constants, 10.0, 2.0) > 1.4 * step_distance(constants, 10.0, 1.0)
    rigid = step_distance(constants, 10.0, 0.01)
    assert 0.3 * constants.half_length < rigid < 2.0 * constants.half_length


def test_a_slow_sweep_of_the_rolling_tire_is_the_steady_tire():
    constants = tire()
    angle = 0.15 * np.sin(2.0 * np.pi * np.arange(3000) / 3000)
    steady = rolled(constants, rows(constants, 3000, ALPHA=angle))[:, 1]
    rolling = rolled(constants, rows(constants, 3000, ALPHA=angle), E_RELAXATION=0.01)[:, 1]
    assert np.abs(steady - rolling)[100:].max() < 0.02 * np.abs(steady).max()


def test_force_stays_within_the_friction_limit():
    constants = tire(1)
    rng = np.random.default_rng(0)
    load = rng.uniform(0.2, 1.8, 2000) * constants.nominal_load
    table = rows(
        constants,
        2000,
        ALPHA=rng.uniform(-0.5, 0.5, 2000),
        KAPPA=rng.uniform(-0.5, 0.5, 2000),
        FZ=load,
    )
    from dataclasses import replace

    constants = replace(constants, coupling=1.0, friction_ratio_x=1.0)
    out = rolled(constants, table)
    ratio = np.hypot(out[:, 0], out[:, 1]) / load
    light = 0.2 ** -(constants.friction_pressure_exponent + constants.load_curve)
    assert ratio.max() <= constants.friction * light * 1.01
    far = np.hypot(table[:, 0], table[:, 1]) > 0.45
    assert ratio[far].min() > 0.5 * constants.friction


def test_no_slip_gives_no_force_and_the_tire_is_symmetric():
    constants = tire(2)
    angles = np.linspace(0.0, 0.25, 26)
    right = rolled(constants, rows(constants, 26, ALPHA=angles))
    left = rolled(constants, rows(constants, 26, ALPHA=-angles))
    assert right[0, 1] == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_allclose(right[:, 1], -left[:, 1], rtol=1e-3, atol=1.0)
    assert right[5, 1] > 0.0 > right[5, 2], "the aligning moment turns the wheel back"


def test_the_number_of_bristles_is_enough():
    """With 24 bristles half of the tires are within 1%, nearly all within half a bristle's share, 1 / 48."""
    angles = np.linspace(-0.25, 0.25, 101)
    off: dict[int, list[float]] = {24: [], 48: []}
    for seed in range(200):
        constants = tire(seed)
        table = rows(constants, 101, ALPHA=angles)
        many = rolled(constants, table, 240)[:, 1]
        for n, errors in off.items():
            errors.append(np.abs(rolled(constants, table, n)[:, 1] - many).max() / np.abs(many).max())
    assert np.median(off[24]) < 0.01
    assert surely_at_least(error < 0.5 / 24 for error in off[24]) > 0.95
    assert np.median(off[48]) < 0.6 * np.median(off[24])


@pytest.mark.parametrize(
    ("column", "low", "high", "effect"),
    [
        ("PRESSURE", 1.6e5, 2.8e5, {"E_PRESSURE": 1.0}),
        ("SPEED", 5.0, 40.0, {"E_SPEED": 0.1}),
        ("TURN", 0.0, 0.2, {"E_TURN": 1.0}),
        ("GAMMA", 0.0, 0.08, {"E_CAMBER": 1.0}),
    ],
)
def test_an_effect_is_absent_until_it_is_put_in(column, low, high, effect):
    from dataclasses import replace

    constants = replace(tire(4), camber_gain=0.0)
    angles = np.linspace(-0.2, 0.2, 21)
    force = {
        (level, on): rolled(
            constants, rows(constants, 21, ALPHA=angles, **{column: level}), **(effect if on else {})
        )[:, 1]
        for level in (low, high)
        for on in (False, True)
    }
    largest = np.abs(force[low, False]).max()
    # the iteration starts from the previous point and stops within half a newton
    assert np.abs(force[low, False] - force[high, False]).max() < 1e-3 * largest
    assert np.abs(force[low, True] - force[high, True]).max() > 0.005 * largest


def test_a_hot_tire_and_a_worn_tire_grip_less_only_if_told_so():
    constants = tire(5)
    n = 6000
    table = rows(constants, n, ALPHA=0.2 * np.sign(np.sin(np.arange(n) * DT)))
    cold = rolled(constants, table)
    hot = rolled(constants, table, E_TEMPERATURE=0.5)
    worn = rolled(constants, table, E_WEAR=0.005)
    assert cold[-1, 3] > cold[0, 3] + 10.0, "sliding heats the tread"
    assert np.all(np.diff(cold[:, 4]) >= 0.0), "wear never heals"
    first, last = np.abs(cold[10, 1]), np.abs(cold[-1, 1])
    assert last == pytest.approx(first, rel=1e-3)
    assert np.ptp(np.abs(hot[10:, 1])) > 0.02 * first
    assert np.abs(worn[-1, 1]) < np.abs(worn[10, 1])


def test_camber_alone_pushes_and_longer_contact_is_stiffer():
    from dataclasses import replace

    constants = replace(tire(6), camber_gain=0.8)
    thrust = rolled(constants, rows(constants, 1, GAMMA=0.05))[0, 1]
    assert 0.0 < thrust < 0.2 * constants.nominal_load
    soft = rows(constants, 1, ALPHA=0.005, PRESSURE=0.8 * constants.nominal_pressure)
    hard = rows(constants, 1, ALPHA=0.005, PRESSURE=1.2 * constants.nominal_pressure)
    only_length = replace(constants, pressure_stiffness=0.0)
    forces = [rolled(only_length, t, E_PRESSURE=1.0)[0, 1] for t in (soft, hard)]
    assert forces[0] > 1.05 * forces[1]


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("spring", [0.05, 0.3, 1.5])
def test_a_braked_sliding_tire_on_springs_does_not_chatter(seed, spring):
    """It once jumped between two states when all bristles slid: the springs saw no stiffness."""
    constants = tire(seed)
    ramp = -0.2 * np.sin(np.pi * np.arange(500) / 500)
    table = rows(constants, 500, ALPHA=0.05, KAPPA=ramp)
    steady = rolled(constants, table)[50:, :2]
    rolling = rolled(constants, table, E_RELAXATION=spring)[50:, :2]
    # no further from the steady tire than the distance that the springs take to stretch
    slope = rolled(constants, rows(constants, 1, KAPPA=-1e-3))[0, 0] / -1e-3
    seconds = (spring * slope / constants.carcass_x + 0.2) / constants.nominal_speed
    lag = seconds * np.abs(np.diff(steady, axis=0)).max() / DT
    assert np.abs(rolling - steady).max() < lag + 0.02 * np.abs(steady).max()
    # no jumping back and forth from sample to sample
    assert np.abs(np.diff(rolling, n=2, axis=0)).max() < 0.02 * np.abs(steady).max()
