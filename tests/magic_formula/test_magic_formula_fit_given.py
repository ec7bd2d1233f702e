"""What a fit says of recordings that hold no measurement, or hardly vary."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula

TIRE = TireModel.from_coefficients(
    {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2, "UNLOADED_RADIUS": 0.3}
)


def sweep() -> pd.DataFrame:
    slip, load = np.tile(np.linspace(-0.2, 0.2, 40), 3), np.repeat([2000.0, 4000.0, 6000.0], 40)
    fy = TIRE.forces(slip_angle=slip, normal_load=load).fy
    return pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": fy})


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"fy": np.nan}, "no force or moment was measured: fy holds no number"),
        ({"fy": 1e300}, "no force or moment was measured: fy holds no number"),
        ({"fy": 5.0}, "no force or moment was measured: fy is 5 N throughout"),
        ({"fy": 0.0}, "no force or moment was measured"),
        ({"slip_angle": np.inf}, "only 0 points"),
    ],
)
def test_what_was_not_measured_is_no_fit(change, said):
    with pytest.raises(RecordingError, match=said):
        fit_magic_formula(sweep().assign(**change))


def test_a_force_without_any_slip_is_no_fit():
    with pytest.raises(RecordingError, match="neither slip_angle nor slip_ratio is recorded"):
        fit_magic_formula(sweep().drop(columns="slip_angle"))


def test_a_force_that_was_not_measured_does_not_keep_another_from_being_fitted():
    fit = fit_magic_formula(sweep().assign(fx=-3.0))
    assert "fx is -3 N throughout: not fitted" in fit.notes
    assert fit.relative_rms["fy"] < 1e-3


def test_infinite_values_are_left_out_as_missing_ones_are():
    table = sweep()
    table.loc[::7, "fy"] = np.inf
    assert fit_magic_formula(table).relative_rms["fy"] < 1e-3


def test_a_slip_ratio_that_says_locked_throughout_was_not_measured():
    """Rigs write -1 where they roll freely."""
    fit = fit_magic_formula(sweep().assign(slip_ratio=-1.0))
    assert fit.relative_rms["fy"] < 1e-3
    assert any("locked wheel" in note for note in fit.notes)


@pytest.mark.parametrize("by_pressure", [0.0, 3.0])
def test_what_the_rows_demand_of_a_pressure_that_hardly_varied_is_said_to_hold_there_only(by_pressure):
    """A pressure that drifts along with friction made a model that is far off at another pressure."""
    rng = np.random.default_rng(0)
    slip, load = np.tile(np.linspace(-0.2, 0.2, 60), 5), np.repeat(np.linspace(0.4, 1.6, 5), 60) * 4000.0
    drift = rng.uniform(-0.011, 0.011, slip.size)
    table = pd.DataFrame({"slip_angle": slip, "normal_load": load, "pressure": 220e3 * (1.0 + drift)})
    table["fy"] = TIRE.forces(slip_angle=slip, normal_load=load).fy * (1.0 + by_pressure * drift)
    table["fy"] += rng.normal(0.0, 15.0, slip.size)
    said = [text for text in fit_magic_formula(table, "6.1").undetermined if "one pressure only" in text]
    assert len(said) == 1
    assert ("PPY3 = " in said[0] and "the model holds only at" in said[0]) == bool(by_pressure)
