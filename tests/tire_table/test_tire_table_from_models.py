"""Models to one table, and which rows are one physical tire."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table import SIZE_KEYS, from_models, physical_tire_ids, told_tires
from tire_pipeline.tire_table.from_models import ALWAYS

BASE = {"FNOMIN": 4000.0, "UNLOADED_RADIUS": 0.3162, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20.0, "PKY2": 1.8}
METADATA = {
    "DIMENSION.WIDTH": 0.205,
    "DIMENSION.ASPECT_RATIO": 0.55,
    "DIMENSION.RIM_RADIUS": 0.2032,
    "DIMENSION.RIM_WIDTH": 0.1651,
    "INERTIA.MASS": 9.83,
    "MODEL.TYRESIDE": "LEFT",
}


def model(version: str = "5.2", metadata: dict | None = None, **more: float) -> TireModel:
    return TireModel.from_coefficients({**BASE, **more}, version, METADATA if metadata is None else metadata)


def test_columns_and_rows():
    table = from_models(
        [
            ("B/z.tir", "B", model("6.1", PKY4=1.9, NOMPRES=2.2e5)),
            ("A/y.tir", "A", model(metadata={**METADATA, "date": "2011-01-31"}, PHY1=0.01)),
            ("A/x.tir", "A", model(metadata={"INERTIA.MASS": "heavy"}, XYZ7=3.0)),
        ]
    )
    assert table["file"].tolist() == ["A/x.tir", "A/y.tir", "B/z.tir"]
    assert table["category"].tolist() == ["A", "A", "B"]
    assert table["version"].tolist() == ["5.2", "5.2", "6.1"]
    assert table["date"].tolist() == ["", "2011-01-31", ""]
    assert set(ALWAYS) <= set(table.columns)
    assert "XYZ7" not in table.columns  # no coefficient of any version
    assert np.array_equal(table["PKY4"], [np.nan, np.nan, 1.9], equal_nan=True)
    assert np.array_equal(table["PHY1"], [np.nan, 0.01, np.nan], equal_nan=True)  # not what stands in
    assert np.array_equal(table["MASS"], [np.nan, 9.83, 9.83], equal_nan=True)
    numbers = table.drop(columns=["file", "category", "version", "date", "tire_id"])
    assert (numbers.dtypes == np.float64).all()
    assert table["tire_id"][1] == table["tire_id"][2] != table["tire_id"][0]


def test_dtypes_do_not_depend_on_the_content():
    empty = from_models([])
    full = from_models([("x.tir", "A", model())])
    assert len(empty) == 0
    for name in ("file", "category", "version", "date", "tire_id", *ALWAYS):
        assert empty[name].dtype == full[name].dtype


def test_a_file_twice_is_refused():
    with pytest.raises(DomainError, match=r"x\.tir: a file occurs twice"):
        from_models([("x.tir", "A", model()), ("x.tir", "A", model())])


def test_memory_is_that_of_the_table():
    names = [f"P{a}{b}{i}" for a in "CDEHKV" for b in "XY" for i in range(1, 5)]
    values = {name: 1.0 + i for i, name in enumerate(names)}
    one = model(**values)
    count = 3000
    from_models([("x", "A", one)])
    tracemalloc.start()
    table = from_models((f"{i}.tir", "A", one) for i in range(count))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    numbers = table.select_dtypes("number").to_numpy().nbytes
    assert peak < 4 * numbers + 1000 * count


def test_the_same_metadata_in_other_units_is_one_tire():
    metres = "LENGTH='meter'\nMASS='kg'"
    millimetres = "LENGTH='mm'\nMASS='gram'"
    text = (
        "[UNITS]\nFORCE='newton'\nANGLE='radians'\nTIME='second'\n{units}\n[MODEL]\nFITTYP=52\n"
        "[DIMENSION]\nUNLOADED_RADIUS={r}\nWIDTH={w}\nASPECT_RATIO=0.55\nRIM_RADIUS={rim}\n"
        "[INERTIA]\nMASS={m}\n[VERTICAL]\nFNOMIN={f}\n[LATERAL_COEFFICIENTS]\nPCY1=1.3\nPDY1=1\nPKY1=-20\nPKY2=1.8"
    )
    one = text.format(units=metres, r=0.3162, w=0.205, rim=0.2032, m=9.83, f=4000)
    other = text.format(units=millimetres, r=316.2, w=205, rim=203.2, m=9830, f=5500)
    third = text.format(units=millimetres, r=316.3, w=205, rim=203.2, m=9830, f=5500)
    table = from_models(
        (f"{i}.tir", "A", read_tir(each.encode())) for i, each in enumerate([one, other, third])
    )
    assert table["tire_id"][0] == table["tire_id"][1] != table["tire_id"][2]


def test_ids_do_not_depend_on_names_or_on_the_measurer():
    row = dict.fromkeys(SIZE_KEYS, 0.3) | {"MASS": 9.0}
    rows = [
        {
            **row,
            "file": "a",
            "category": "A",
            "FNOMIN": 4000.0,
            "NOMPRES": 2e5,
            "RIM_WIDTH": 0.16,
            "PCY1": 1.3,
        },
        {
            **row,
            "file": "b",
            "category": "B",
            "FNOMIN": 6000.0,
            "NOMPRES": 3e5,
            "RIM_WIDTH": 0.18,
            "PCY1": 1.5,
        },
    ]
    ids = physical_tire_ids(pd.DataFrame(rows))
    assert ids.nunique() == 1


@pytest.mark.parametrize("key", SIZE_KEYS)
def test_each_size_key_tells_tires_apart(key: str):
    rows = pd.DataFrame([dict.fromkeys(SIZE_KEYS, 0.3)] * 3)
    rows.loc[1, key] += 0.001
    rows.loc[2, key] = np.nan
    assert physical_tire_ids(rows).nunique() == 3


def test_a_file_without_a_mass_may_be_of_any_tire_of_its_size():
    rows = pd.DataFrame([dict.fromkeys(SIZE_KEYS, 0.3)] * 4).assign(file=list("abcd"))
    rows.loc[2:, "MASS"] = np.nan
    rows["tire_id"] = physical_tire_ids(rows)
    assert rows["tire_id"].nunique() == 2
    told = told_tires(rows)
    assert told[0] == told[1]
    assert len(set(told)) == 3
    assert (told_tires(rows.drop(columns="MASS")) == rows["tire_id"]).all()


def test_tires_without_metadata_are_named_by_their_numbers():
    rows = pd.DataFrame([dict.fromkeys(SIZE_KEYS, np.nan)] * 3).assign(
        PCY1=[1.3, 1.3, 1.4], file=["a", "b", "c"]
    )
    ids = physical_tire_ids(rows)
    assert ids[0] == ids[1] != ids[2]
    assert ids.str.startswith("unknown ").all()
