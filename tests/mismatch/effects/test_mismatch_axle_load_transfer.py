"""The mean wheel of an axle beside the file of one tire: load transfer is no lower friction."""

import numpy as np
import pandas as pd
import pytest
import small_rig

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch import explain_mismatch

COEFFICIENTS = {
    **small_rig.COEFFICIENTS,
    "PDY2": -0.25,
    "PEY1": -1.0,
    "PEY2": 0.0,
    "PKY1": -20.0,
    "PKY2": 1.6,
}


def axle(friction: float = 1.0, share: float = 1.1) -> pd.DataFrame:
    """Turns of growing size with the mean force of two wheels, on an axle that takes over load."""
    rng = np.random.default_rng(3)
    tire = TireModel.from_coefficients(COEFFICIENTS, version="5.2")
    tire = tire.replace(PDY1=friction * COEFFICIENTS["PDY1"])
    t = np.arange(0.0, 120.0, 0.1)
    angle = np.radians(6.0) * np.sin(2.0 * np.pi * t / 7.0) * (0.3 + 0.7 * np.sin(np.pi * t / 120.0) ** 2)
    load = 3600.0 + 500.0 * np.sin(2.0 * np.pi * t / 23.0)
    alone = np.asarray(tire.forces(slip_angle=angle, normal_load=load).fy)
    transfer = 0.6 * np.abs(alone)
    wheels = [tire.forces(slip_angle=angle, normal_load=load + s * share * transfer).fy for s in (1.0, -1.0)]
    return pd.DataFrame(
        {
            "time": t,
            "slip_angle": angle,
            "normal_load": load,
            "speed": 16.7 + 0.5 * np.sin(t / 9.0),
            "load_transfer": transfer,
            "fy": np.mean(wheels, axis=0) + 15.0 * rng.standard_normal(t.size),
        }
    )


@pytest.fixture(scope="module")
def tire():
    return TireModel.from_coefficients(COEFFICIENTS, version="5.2")


def test_it_is_named_where_nothing_else_is_missing(tire):
    report = explain_mismatch(tire, axle())
    assert [names[0] for names, _ in report.sets] == ["axle_load_transfer"]
    share, error, _ = report.effects[0].parameters["share"]
    assert abs(share - 1.1) < 3.0 * error + 0.05
    assert report.fit["fy"].rms_after < 0.5 * report.fit["fy"].rms_before


def test_another_friction_is_named_beside_it(tire):
    report = explain_mismatch(tire, axle(friction=0.85))
    assert {names[0] for names, _ in report.sets} == {"friction_scale", "axle_load_transfer"}
    friction, error, _ = next(e for e in report.effects if e.name == "friction_scale").parameters["friction"]
    assert abs(friction + 0.15) < 3.0 * error
    assert report.fit["fy"].rms_after < 0.5 * report.fit["fy"].rms_before


def test_without_the_channel_it_cannot_be_tested(tire):
    report = explain_mismatch(tire, axle(share=0.0).drop(columns="load_transfer"))
    assert report.sets == []
    assert "load transfer between the wheels of the axle – only an axle of a vehicle has it" in " ".join(
        report.notes
    )
