"""Combined slip that the file lacks: looked for in brake sweeps, also where the slip angle stands still."""

import pytest
from brake_rig import brake_sweeps, weighted
from weighed import beside, named

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.recording.prepare import prepare


@pytest.mark.parametrize("missing", [[], ["tread_temperature"], ["fx"], ["fy"]], ids=str)
@pytest.mark.parametrize("angles", [(4.0,), (0.0, 4.0), (-3.0, 5.0)])
def test_combined_slip_is_looked_for_in_brake_sweeps(braked, angles, missing):
    """It was not where the slip angle stands still: a gain and crosstalk were named. Shares: ``rates``."""
    data = prepare(braked, brake_sweeps(weighted(braked), angles).drop(columns=missing)).data
    assert catalogue()["combined_slip"].absent(data) is None


BY_FILE = {
    "friction_scale": ("friction", ("LMUX", "LMUY")),
    "stiffness_scale": ("stiffness", ("LKX", "LKY")),
}


@pytest.mark.parametrize(
    ("name", "factor"),
    [
        ("friction_scale", 0.8),
        pytest.param("friction_scale", 1.25, marks=pytest.mark.long),
        ("stiffness_scale", 0.88),
        pytest.param("stiffness_scale", 1.15, marks=pytest.mark.long),
    ],
)
@beside("friction_scale", "stiffness_scale", "load_gain", "force_gain", "combined_slip", "load_sensitivity")
def test_a_change_by_the_files_own_factors_has_its_name_at_combined_slip(braked, name, factor, without):
    """Other programs change these factors, and keep the weights of combined slip.

    Less friction was called a stiffness, and less stiffness a friction level with a gain of the load.
    """
    parameter, factors = BY_FILE[name]
    file = weighted(braked)
    changed = file.replace(**dict.fromkeys(factors, factor))
    report = explain_mismatch(file, brake_sweeps(changed, (-3.0, 0.0, 5.0)), without=without)
    assert [effect.name for effect in report.effects] == [name]
    assert report.effects[0].parameters[parameter][0] == pytest.approx(factor - 1.0, abs=0.02)


@pytest.mark.parametrize("drift", [150.0, pytest.param(-150.0, marks=pytest.mark.long)])
@beside("sensor_drift", "force_offset", "temperature", "force_gain", "load_gain")
def test_a_small_drift_of_brake_sweeps_is_found(braked, drift, without):
    """1% of the largest force, far above noise: it counted as one long error, and all agreed."""
    file = weighted(braked)
    run = brake_sweeps(file, (-3.0, 0.0, 5.0))
    run["fy"] += drift * run["time"] / run["time"].max()
    assert named(file, run, without) == ["sensor_drift"]


@pytest.mark.parametrize("rate", [-0.3, pytest.param(-0.2, marks=pytest.mark.long)])
@beside("load_sensitivity", "load_gain", "load_offset", "force_gain", "friction_scale")
def test_friction_that_falls_with_a_power_of_the_load_has_its_name(braked, rate, without):
    """A gain and an offset of the load were named: the effect knew only what is linear in the load."""
    file = weighted(braked)
    run = brake_sweeps(file, (-3.0, 0.0, 5.0))
    data = prepare(file, run).data
    by_power = {"rate": rate, "stiffness": 0.0, "lateral_stiffness": 0.0, "power": 1.0}
    forces, base = simulate(data, [("load_sensitivity", by_power)]), data.simulation.base
    assert len(run) == data.size
    run = run.assign(**{o: run[o] + forces[o] - base[o] for o in forces})
    found = explain_mismatch(file, run, without=without)
    assert [effect.name for effect in found.effects] == ["load_sensitivity"]
    assert found.effects[0].parameters["rate"][0] == pytest.approx(rate, abs=0.03)
