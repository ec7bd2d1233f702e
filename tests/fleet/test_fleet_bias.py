"""The bias is there at size 1, grows with its size, and is noise at size 0."""

from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.evaluation import floor_evaluation
from tire_pipeline.fleet import FleetSettings, make_fleet, write_fleet
from tire_pipeline.tir import read_tir

pytestmark = pytest.mark.slow

TARGET = "D"
SOURCES = ("A", "B", "C", "E", "F")
METRICS = ["forces", "cornering_stiffness", "peak_friction"]
TIRES = 16


def _table(folder: Path) -> pd.DataFrame:
    files = sorted(folder.glob("*.tir"))
    return pd.DataFrame([dict(read_tir(path).coefficients) for path in files], index=[p.stem for p in files])


@lru_cache
def _fleet(kind: str, size: float):
    fleet = make_fleet(
        FleetSettings(seed=3, files=330, hidden_tires=TIRES, tuning_tires=1, kind=kind, bias_size=size)
    )
    with TemporaryDirectory() as folder:
        truth = write_fleet(fleet, folder)["truth"]
        first = {name: _table(truth / "first/hidden" / name) for name in (*SOURCES, TARGET)}
        second = _table(truth / "second/hidden" / TARGET)
    return fleet, first, second


def _floor(kind: str, size: float):
    _, first, second = _fleet(kind, size)
    count = len(SOURCES)
    source = pd.concat([first[name] for name in SOURCES])
    return floor_evaluation(
        pd.concat([second] * count), source, pd.concat([first[TARGET]] * count), lateral_only=True
    )


def test_without_bias_another_actor_is_as_good_as_a_second_measurement() -> None:
    """Ratio floor / untranslated would be 1 if only noise differed; fit habits take a share."""
    summary = _floor("additive", 0.0).summary
    assert (summary.loc[METRICS, "ratio"] > 0.4).all()


def test_with_bias_a_second_measurement_is_far_better() -> None:
    summary = _floor("additive", 1.0).summary
    assert (summary.loc[METRICS, "ratio"] < 0.1).all()
    assert (summary.loc[METRICS, "improved"] > 0.85).all()


@pytest.mark.parametrize("sizes", [(0.0, 1.0), pytest.param((0.0, 0.3, 0.6, 1.0), marks=pytest.mark.long)])
def test_bias_grows_with_its_size(sizes: tuple[float, ...]) -> None:
    errors = [_floor("additive", s).per_file[[f"{m}_untranslated" for m in METRICS]].mean() for s in sizes]
    assert (pd.DataFrame(errors).diff().dropna() > 0).all(axis=None)


def _peak_shift(kind: str) -> pd.Series:
    """Relative difference of PDY1 between B and the target, by tire."""
    _, first, _ = _fleet(kind, 1.0)
    return np.log(first["B"]["PDY1"] / first[TARGET]["PDY1"])


def test_interacting_bias_depends_on_the_compound_and_additive_does_not() -> None:
    def share(kind: str) -> float:
        fleet, _, _ = _fleet(kind, 1.0)
        shift = _peak_shift(kind)
        compound = fleet.truth.tires.loc[shift.index, "compound"]
        warm = compound.isin(["sport", "touring"])
        return float(abs(shift[warm].mean() - shift[~warm].mean()))

    assert share("interacting") > 3.0 * share("additive")
    assert share("interacting") > 0.03


def test_drifting_mixes_two_protocols_in_training_and_evaluation() -> None:
    fleet, _, _ = _fleet("drifting", 1.0)
    assert set(fleet.truth.regimes) >= {"E/old", "E/new"}
    assert fleet.truth.regimes["E/old"] != fleet.truth.regimes["E/new"]
    used = fleet.truth.files.groupby("category")["protocol"].agg(set)
    assert used["E"] == {"old", "new"}
    assert all(used[name] == {"old"} for name in used.index if name != "E")
    protocols = fleet.truth.evaluation.query("set == 'hidden' and category == 'E'")["protocol"]
    assert 0.2 < (protocols == "new").mean() < 0.8


@pytest.mark.parametrize("kind", ["additive", "interacting"])
def test_no_drift_elsewhere(kind: str) -> None:
    fleet, _, _ = _fleet(kind, 1.0)
    assert set(fleet.truth.files["protocol"]) == {"old"}
