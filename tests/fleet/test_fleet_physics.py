"""The true tire and the rig behave as tires and rigs do."""

from dataclasses import replace

import numpy as np
import pandas as pd

from tire_pipeline.fleet.rig.regimes import COMMON, MANUFACTURER_FIELDS, REGIMES, regime_of
from tire_pipeline.fleet.rig.sweeps import Session, measure_lateral
from tire_pipeline.fleet.rig.true_forces import Contact, in_contact, lateral, longitudinal
from tire_pipeline.fleet.tire_population import COMPOUNDS, draw_tires, thermal_parameters

COUNT = 40


def _tires() -> pd.DataFrame:
    return thermal_parameters(draw_tires(COUNT, np.random.default_rng(5)), 1.0)


def _contact(load: float, **changes: float) -> Contact:
    values = dict(pressure=1.0, wear=0.0, adhesion=1.0, hysteresis=1.0, curvature=0.0, conditioning=1.0)
    values.update(changes)
    grids = {name: np.full((COUNT, 1), value) for name, value in values.items()}
    return Contact(normal_load=np.full((COUNT, 1), load), camber=np.full((COUNT, 1), 0.0), **grids)


def _fy(tires: pd.DataFrame, slip: float, temperature: float = 60.0, load: float = 5000.0, **changes):
    true = in_contact(tires, _contact(load, **changes))
    at = np.full((COUNT, 1), slip)
    return lateral(true, at, 16.7, np.full((COUNT, 1), temperature))[0][:, 0]


def test_signs_and_bounds_of_the_true_tire() -> None:
    tires = _tires()
    assert (_fy(tires, 0.1) < 0).all()
    assert (_fy(tires, -0.1) > 0).all()
    friction = np.abs(_fy(tires, 0.2)) / 5000.0
    assert (friction > 0.5).all()
    assert (friction < 1.6).all()
    true = in_contact(tires, _contact(5000.0))
    warm = np.full((COUNT, 1), 60.0)
    assert (longitudinal(true, np.full((COUNT, 1), 0.05), 16.7, warm) > 0).all()
    torque = lateral(true, np.full((COUNT, 1), 0.05), 16.7, warm)[1]
    assert (torque > 0).all(), "the aligning torque turns the wheel back"


def test_friction_falls_with_load_and_stiffness_is_degressive() -> None:
    tires = _tires()
    light = np.abs(_fy(tires, 0.2, load=3000.0)) / 3000.0
    heavy = np.abs(_fy(tires, 0.2, load=7000.0)) / 7000.0
    assert (light > heavy).all()
    slope = [np.abs(_fy(tires, 0.002, load=f) - _fy(tires, -0.002, load=f)) for f in (3e3, 6e3)]
    assert (slope[1] < 2.0 * slope[0]).all()


def test_surface_temperature_drum_and_run_in_act_where_they_should() -> None:
    tires = _tires()
    base, small = np.abs(_fy(tires, 0.2)), np.abs(_fy(tires, 0.005))
    assert (np.abs(_fy(tires, 0.2, adhesion=0.9, hysteresis=0.9)) < 0.92 * base).all()
    rough = np.abs(_fy(tires, 0.2, hysteresis=1.1)) / base
    by_compound = pd.Series(rough).groupby(tires["compound"].to_numpy()).mean()
    assert by_compound["winter"] > by_compound["sport"] + 0.01
    assert (np.abs(_fy(tires, 0.005, curvature=0.2)) < small).all()
    assert (np.abs(_fy(tires, 0.005, temperature=30.0)) > small).all()
    assert (np.abs(_fy(tires, 0.005, conditioning=0.0)) > small).all()
    hot, cold = np.abs(_fy(tires, 0.2, temperature=90.0)), np.abs(_fy(tires, 0.2, temperature=25.0))
    prefers_heat = pd.Series(hot / cold).groupby(tires["compound"].to_numpy()).mean()
    assert prefers_heat["sport"] > 1.0 > prefers_heat["winter"]


def _quiet(count: int) -> Session:
    one, zero = np.ones((count, 1)), np.zeros((count, 1))
    return Session(one, one, one, zero, zero, zero)


def _curve(regime) -> np.ndarray:
    tires = _tires()
    condition = pd.DataFrame({"pressure": 1.0, "wear": 0.0}, index=tires.index)
    return measure_lateral(tires, condition, regime, _quiet(COUNT), np.random.default_rng(1)).force


def test_lag_shifts_a_one_way_sweep_and_cancels_in_both_directions() -> None:
    steady = replace(
        COMMON,
        heating=0.0,
        preheat=60.0,
        ambient=60.0,
        rig_compliance=0.0,
        symmetrise=0.0,
        filter_time=0.001,
    )
    slow = _curve(replace(steady, sweep_rate=0.002, both_directions=0.0))
    fast = replace(steady, sweep_rate=0.12)

    def apart(both_directions: float) -> float:
        curve = _curve(replace(fast, both_directions=both_directions))
        return float(np.abs((curve - slow).mean(axis=0)).mean())  # over tires first: against noise

    one_way, both = apart(0.0), apart(1.0)
    assert one_way > 3.0 * both


def test_soft_rig_lowers_the_measured_stiffness() -> None:
    stiff = replace(COMMON, rig_compliance=0.0)
    soft = replace(COMMON, rig_compliance=4e-7)
    centre = slice(10, 14)  # the samples around zero slip at the lowest load
    slope = [np.abs(np.diff(_curve(r)[:, centre], axis=1)).mean() for r in (stiff, soft)]
    assert slope[1] < 0.99 * slope[0]


def test_regime_moves_from_common_to_own() -> None:
    for name, own in REGIMES.items():
        assert regime_of(name, "old", 0.0) == COMMON
        full = regime_of(name, "old", 1.0)
        half = regime_of(name, "old", 0.5)
        for field in MANUFACTURER_FIELDS:
            a, b, c = (getattr(r, field) for r in (COMMON, half, full))
            np.testing.assert_allclose(c, getattr(own, field), rtol=1e-12, err_msg=field)
            np.testing.assert_allclose(b, 0.5 * (a + c), rtol=1e-12, err_msg=field)
        assert own != COMMON


def test_metadata_is_unique_and_every_compound_occurs() -> None:
    tires = draw_tires(900, np.random.default_rng(0))
    keys = ["UNLOADED_RADIUS", "WIDTH", "ASPECT_RATIO", "RIM_RADIUS", "MASS"]
    assert not tires.duplicated(keys).any()
    assert set(tires["compound"]) == set(COMPOUNDS)
    assert (tires.select_dtypes("number").drop(columns=["ply_steer"]).notna()).all(axis=None)


def test_metadata_say_nothing_of_the_compound_beyond_the_size() -> None:
    tires = draw_tires(4000, np.random.default_rng(8))
    code = tires["compound"].map({name: float(i) for i, name in enumerate(COMPOUNDS)})
    sizes = tires.groupby(["WIDTH", "ASPECT_RATIO", "RIM_RADIUS"]).ngroup()
    within = code - code.groupby(sizes).transform("mean")
    assert within.var() > 0.5 * code.var(), "the size alone does not give it away"
    for name in ("NOMPRES", "MASS", "UNLOADED_RADIUS", "RIM_WIDTH"):
        column = tires[name] - tires[name].groupby(sizes).transform("mean")
        spread = float(column.std())
        correlation = float(np.mean(column * within)) / (spread * within.std()) if spread > 1e-9 else 0.0
        assert abs(correlation) < 4.0 / np.sqrt(len(tires)), name
