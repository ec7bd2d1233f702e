"""What a fit refuses, in words that name the channel or the argument, and what it does without."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import DomainError, RecordingError, TirValueError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.magic_formula.fitting.setup.arguments import FIT_LOSSES
from tire_pipeline.tir import read_tir

TIRE = TireModel.from_coefficients(
    {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2, "UNLOADED_RADIUS": 0.3}
)
ROWS = 60


class _Fitted:
    """Something that holds a model, as a FitResult does."""

    model = TIRE


def points() -> pd.DataFrame:
    slip, load = np.tile(np.linspace(-0.2, 0.2, 20), 3), np.repeat([2000.0, 4000.0, 6000.0], 20)
    fy = TIRE.forces(slip_angle=slip, normal_load=load).fy
    return pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": fy})


def part(value: float = 0.1, *, known: int = 5) -> np.ndarray:
    """A column with few numbers."""
    return np.where(np.arange(ROWS) < ROWS - known, np.nan, value)


@pytest.mark.parametrize("recording", [None, [1.0], "run.csv"])
def test_only_a_table_is_fitted(recording):
    with pytest.raises(RecordingError, match="no DataFrame -> read it with read_recording"):
        fit_magic_formula(recording)


@pytest.mark.parametrize("name", ["fy", "slip_angle", "normal_load", "camber"])
def test_text_in_a_column_is_named_with_its_row(name):
    table = points().assign(camber=0.0).astype(object)
    table.loc[7, name] = "err"
    with pytest.raises(
        RecordingError, match=f"{name}: 1 of 60 values are no numbers, the first in row 7: 'err'"
    ):
        fit_magic_formula(table)


def test_dates_are_no_forces():
    with pytest.raises(RecordingError, match="fy: 60 of 60 values are no numbers"):
        fit_magic_formula(points().assign(fy=pd.Timestamp("2026-11-29")))


def test_two_columns_of_one_name_are_refused():
    table = points()
    with pytest.raises(RecordingError, match="several columns of the name fy -> keep one of each"):
        fit_magic_formula(pd.concat([table, table[["fy"]]], axis=1))


@pytest.mark.parametrize(
    ("argument", "said"),
    [
        ({"loss": "foo"}, "loss: there is no loss 'foo' -> use one of soft_l1, "),
        ({"loss": "hubert"}, "did you mean 'huber'?"),
        ({"start": "x.tir"}, r"start: a str is no tire model -> read the file: start=read_tir\('x.tir'\)"),
        ({"start": Path("x.tir")}, r"start=read_tir\('x.tir'\)"),
        ({"start": _Fitted()}, "start: a _Fitted is no tire model -> pass its model"),
        ({"starts": 1.5}, "starts: 1.5 is no whole number from 1 on"),
        ({"starts": 0}, "starts: 0 is no whole number from 1 on"),
        ({"starts": True}, "starts: True is no whole number"),
        ({"seed": -1}, "seed: -1 is no whole number from 0 on"),
        ({"nominal_load": np.nan}, "nominal_load: nan is no load"),
        ({"nominal_load": -4000.0}, "nominal_load: -4000.0 is no load"),
    ],
)
def test_an_argument_that_cannot_be_used_is_named(argument, said):
    with pytest.raises(DomainError, match=said):
        fit_magic_formula(points(), **argument)


@pytest.mark.slow
@pytest.mark.parametrize("loss", FIT_LOSSES)
def test_each_loss_that_is_known_is_minimised(loss):
    assert fit_magic_formula(points(), starts=1, loss=loss).relative_rms["fy"] < 1e-3


@pytest.mark.parametrize(
    ("radius", "said"),
    [
        (320, r"unloaded_radius = 320 m is no tire's -> state it in metres: 0\.32, if this is in mm"),
        (np.nan, "unloaded_radius = nan is not a finite number -> state it in metres"),
        (0.0, "unloaded_radius = 0 must be positive"),
        (-0.3, "unloaded_radius = -0.3 must be positive"),
        ("wide", "unloaded_radius = 'wide' is not a finite number"),
    ],
)
def test_a_radius_that_no_tire_has_is_refused_by_the_name_of_the_argument(radius, said, tmp_path):
    with pytest.raises(TirValueError, match=said):
        fit_magic_formula(points(), unloaded_radius=radius)
    path = tmp_path / "x.tir"
    path.write_text("[MODEL]\nFITTYP = 6\n[VERTICAL]\nFNOMIN = 4000\n[LATERAL_COEFFICIENTS]\nPCY1 = 1.3\n")
    with pytest.raises(TirValueError, match=said) as refused:
        read_tir(path, unloaded_radius=radius)
    assert "x.tir" not in str(refused.value)


@pytest.mark.slow
@pytest.mark.parametrize("version", ["5.2", "6.1"])
@pytest.mark.parametrize("name", ["camber", "pressure", "slip_ratio", "speed"])
def test_a_channel_without_a_number_counts_as_not_recorded(name, version):
    plain = fit_magic_formula(points(), version, starts=1)
    fit = fit_magic_formula(points().assign(**{name: np.nan}), version, starts=1)
    assert f"{name} holds no number: taken as not recorded" in fit.notes
    assert fit.model.coefficients == plain.model.coefficients


@pytest.mark.slow
def test_what_the_version_does_not_use_costs_no_row():
    table = points().assign(pressure=part(2e5), speed=part(20.0))
    fit = fit_magic_formula(table, starts=1)
    assert len(fit.measured) == ROWS
    assert fit.measured["pressure"].eq(2e5).all()
    text = fit_magic_formula(points().assign(pressure="2 bar"), starts=1)
    assert len(text.measured) == ROWS


def test_what_is_used_is_named_where_it_costs_the_rows():
    said = "only 5 points can be used; pressure has no number in 55 rows of 60 -> look at pressure, or leave"
    with pytest.raises(RecordingError, match=said):
        fit_magic_formula(points().assign(pressure=part(2e5)), "6.1")
    with pytest.raises(RecordingError, match="speed has no number in 55 rows of 60"):
        fit_magic_formula(points().assign(speed=part(20.0), my=-30.0))


@pytest.mark.parametrize("name", ["camber", "slip_angle", "slip_ratio", "normal_load"])
def test_the_channel_that_makes_rows_unusable_is_named(name):
    table = points().assign(**{name: part(0.1)})
    with pytest.raises(
        RecordingError, match=f"only 5 points can be used; {name} has no number in 55 rows of 60"
    ):
        fit_magic_formula(table)


def test_all_channels_that_cost_rows_are_named_the_worst_first():
    load = np.where(np.arange(ROWS) < 52, 0.0, 4000.0)
    table = points().assign(normal_load=load, camber=np.where(np.arange(ROWS) > 57, np.nan, 0.0))
    said = "only 6 points can be used; normal_load has no positive value in 52 rows of 60; camber has no"
    with pytest.raises(RecordingError, match=said):
        fit_magic_formula(table)


def test_a_negative_load_is_refused_with_what_to_do():
    said = "normal_load: is negative in 60 of 60 rows; compression is positive here -> turn its sign"
    with pytest.raises(RecordingError, match=said):
        fit_magic_formula(points().assign(normal_load=lambda t: -t["normal_load"]))
    mostly = points().assign(normal_load=lambda t: np.where(t.index < 45, -1.0, 1.0) * t["normal_load"])
    with pytest.raises(RecordingError, match="is negative in 45 of 60 rows"):
        fit_magic_formula(mostly)


def test_a_load_without_a_number_and_an_empty_table_are_refused():
    with pytest.raises(RecordingError, match="normal_load: holds no number -> record the load"):
        fit_magic_formula(points().assign(normal_load=np.nan))
    with pytest.raises(RecordingError, match="only 0 points -> use at least 10"):
        fit_magic_formula(points().iloc[:0])
