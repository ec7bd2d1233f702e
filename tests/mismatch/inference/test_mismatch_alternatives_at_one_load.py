"""What a recording cannot tell apart is named together."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared
from weighed import named_sets

from tire_pipeline.magic_formula import fit_magic_formula
from tire_pipeline.magic_formula.fitting.report.valid_ranges import with_measured_ranges
from tire_pipeline.recordings import read_recording


@pytest.fixture(scope="module")
def one_load():
    """Flat-belt sweeps at one load, one pressure and no camber, and a file fitted to them."""
    table = read_recording(shared("recordings/calspan/cornering_part.mat"), axes="ISO").iloc[::10]
    load = np.abs(table["normal_load"] - table["normal_load"].median()) < 250.0
    upright = np.degrees(table["camber"].abs()) < 0.5
    rows = table[load & upright & (table["pressure"] < 76_000.0)]
    return fit_magic_formula(rows[["slip_angle", "normal_load", "fy"]]).model, rows


@pytest.mark.parametrize("factor", [*(pytest.param(f, marks=pytest.mark.long) for f in (0.75, 0.8)), 1.25])
def test_a_stiffness_at_one_load_is_named_with_the_compliance_it_looks_like(one_load, factor):
    tire, rows = one_load
    names = ["time", "normal_load", "fy", "speed"]
    softer = pd.DataFrame({**{n: rows[n] for n in names}, "slip_angle": rows["slip_angle"] / factor})
    sets = named_sets(tire, softer)
    assert any({"stiffness_scale", "compliance"} <= names for names in sets), sets


@pytest.mark.parametrize("late", [0.08, 0.12])
def test_a_late_force_at_one_speed_is_named_with_the_lags_it_looks_like(one_load, late):
    tire, rows = one_load
    late_force = np.interp(rows["time"] - late, rows["time"], rows["fy"])
    recording = rows[["time", "normal_load", "slip_angle", "speed"]].assign(fy=late_force)
    sets = named_sets(tire, recording)
    assert any({"relaxation_length", "low_pass", "time_delay"} <= names for names in sets), sets


@pytest.mark.parametrize("lost", [0.15, 0.2])
def test_a_friction_that_fades_with_friction_work_is_wear_or_heat_that_nobody_measured(one_load, lost):
    tire, rows = one_load
    power = np.abs(rows["fy"] * np.sin(rows["slip_angle"])) * rows["speed"]
    worked = np.cumsum(power) / np.sum(power)
    recording = rows[["time", "normal_load", "slip_angle", "speed"]].assign(
        fy=rows["fy"] * (1.0 - lost * worked)
    )
    sets = named_sets(tire, recording)
    assert any({"wear", "temperature"} <= names for names in sets), sets


def test_a_load_that_the_file_does_not_know_is_no_fault_of_the_recording_alone():
    """A file fitted from 1 to 2.9 kN leaves 16% of the force at 0.5 kN: it was a wrong gain, 0.93."""
    table = read_recording(shared("recordings/calspan/cornering_part.mat"), axes="ISO").iloc[::10]
    rows = table[(np.degrees(table["camber"].abs()) < 0.5) & (table["pressure"] > 76_000.0)]
    small = rows["normal_load"] < 800.0
    result = fit_magic_formula(rows.loc[~small, ["slip_angle", "normal_load", "fy"]], starts=6)
    tire = with_measured_ranges(result.model, result.measured)
    sets = named_sets(tire, rows.loc[small, ["time", "slip_angle", "normal_load", "speed", "fy"]])
    assert any({"load_sensitivity", "force_gain"} <= names for names in sets), sets
