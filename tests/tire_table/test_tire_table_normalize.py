"""One nominal load for a whole table: the same forces, and the same as for one model."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import COEFFICIENT_NAMES, TireModel
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table import from_models, normalize_table

SHARED = Path(__file__).resolve().parents[3] / "shared" / "tir"
SHIPPED = Path(__file__).resolve().parents[1] / "magic_formula" / "reference_points"
OUTPUTS = ("fx", "fy", "mz", "mx", "my")


@pytest.fixture(scope="module", params=["shipped", "shared"])
def public(request) -> dict[str, TireModel]:
    """The four tires whose parameters ship with the tests; the 16 public files."""
    return _shipped() if request.param == "shipped" else _shared()


def _shipped() -> dict[str, TireModel]:
    tires = {}
    for path in sorted(SHIPPED.glob("*.json")):
        parameters = json.loads(path.read_text(encoding="utf-8"))
        version = {6: "5.2", 61: "6.1", 62: "6.2"}[int(parameters["FITTYP"])]
        coefficients = {name: parameters[name] for name in COEFFICIENT_NAMES if name in parameters}
        tires[path.name] = TireModel.from_coefficients(coefficients, version)
    assert len(tires) == 4
    return tires


def _shared() -> dict[str, TireModel]:
    if not SHARED.is_dir() and not os.environ.get("CI"):
        pytest.skip(f"{SHARED} is not there")
    paths = sorted(SHARED.glob("*.tir"))
    assert len(paths) == 16
    return {path.name: read_tir(path, unloaded_radius=0.3) for path in paths}  # one states none


def model_of_row(row: pd.Series, like: TireModel) -> TireModel:
    values = {
        k: row[k] for k in row.index if k in {*COEFFICIENT_NAMES, *like.coefficients} and pd.notna(row[k])
    }
    return TireModel(like.version, values)


@pytest.mark.slow
@settings(max_examples=8, deadline=None)
@given(load=st.floats(500, 60_000), seed=st.integers(0, 1000))
def test_forces_stay(public, load: float, seed: int):
    rng = np.random.default_rng(seed)
    table = normalize_table(from_models((name, "X", tire) for name, tire in public.items()), load)
    for _, row in table.iterrows():
        before = public[row["file"]]
        points = {
            "normal_load": rng.uniform(0.1, 2.0, 50) * before.coefficients["FNOMIN"],
            "slip_angle": rng.uniform(-0.4, 0.4, 50),
            "slip_ratio": rng.uniform(-0.4, 0.4, 50),
            "camber": rng.uniform(-0.2, 0.2, 50),
            "speed": rng.uniform(5, 40, 50),
            "limits": "ignore",
        }
        one, other = before.forces(**points), model_of_row(row, before).forces(**points)
        for name in OUTPUTS:
            scale = np.abs(getattr(one, name)).max()
            assert np.abs(getattr(one, name) - getattr(other, name)).max() <= 1e-9 * scale, (
                row["file"],
                name,
            )


@pytest.mark.parametrize("load", [3000.0, 6000.0])
def test_the_same_as_for_one_model(public, load: float):
    table = normalize_table(from_models((name, "X", tire) for name, tire in public.items()), load)
    assert (table["FNOMIN"] == load).all()
    for _, row in table.iterrows():
        wanted = public[row["file"]].nominal_load_changed(load)
        got = {k: row[k] for k in wanted.coefficients if k in row.index}
        assert got == pytest.approx({k: wanted.coefficients[k] for k in got}, rel=1e-15, abs=0)


def test_values_that_a_file_lacks():
    base = {"FNOMIN": 3000.0, "UNLOADED_RADIUS": 0.3, "PCY1": 1.3, "PKY1": -20.0, "PKY2": 1.8}
    models = [
        ("a.tir", "A", TireModel.from_coefficients({**base, "PDY1": 1.0, "PDY2": -0.1})),
        ("b.tir", "A", TireModel.from_coefficients({**base, "PDY2": -0.1})),
        ("c.tir", "A", TireModel.from_coefficients({**base, "PEX2": 0.5})),
    ]
    table = from_models(models)
    result = normalize_table(table, 6000.0)
    assert np.array_equal(result["PDY1"], [0.9, -0.1, np.nan], equal_nan=True)
    assert np.array_equal(result["PDY2"], [-0.2, -0.2, np.nan], equal_nan=True)
    assert np.array_equal(result["PEX1"], [np.nan, np.nan, 0.5], equal_nan=True)  # brought about
    assert result["PCY1"].tolist() == [1.3] * 3
    assert table["FNOMIN"].tolist() == [3000.0] * 3  # the given table is not changed
    assert result["tire_id"].equals(table["tire_id"])


def test_there_and_back(public):
    table = from_models((name, "X", tire) for name, tire in public.items()).assign(FNOMIN=4000.0)
    back = normalize_table(normalize_table(table, 6000.0), 4000.0)
    for name in table.columns[table.dtypes == np.float64]:
        assert np.allclose(back[name], table[name], rtol=1e-9, atol=1e-12, equal_nan=True), name


def test_loads_that_make_no_sense(public):
    table = from_models((name, "X", tire) for name, tire in public.items())
    for load in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(DomainError, match="a nominal load of"):
            normalize_table(table, load)
    with pytest.raises(DomainError, match=rf"{table['file'].iloc[0]}.*FNOMIN is not positive"):
        normalize_table(table.assign(FNOMIN=[0.0, *table["FNOMIN"][1:]]), 6000.0)
    with pytest.raises(DomainError, match="PKX"):
        normalize_table(table.assign(PKX3=3000.0), 60_000.0)
