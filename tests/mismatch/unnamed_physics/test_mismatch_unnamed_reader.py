"""The example reader: the same force as ours without our code, and what it refuses."""

import csv
import json
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from unnamed_problem import NOMINAL, physics, table

READER = Path(__file__).parents[3] / "examples" / "read_unnamed.py"
EQUATIONS = (
    "0.012*fy*v^2/L",
    "(-3.1)*fy*(g^2)*(L) + 0.2*F0*L*(L^2)",
    "0.4*fy*(lag(v*(abs(s*fy) + abs(k*fx))/F0, 7.4))",
    "0.1*fy_slip*(play(fy/(F0*L), 0.15) - fy/(F0*L))",
    "0.05*fx*sin(way/0.85) - 0.01*fx*cos(way/0.85)",
    "fy*highest(abs(s))*exp(-tanh(L))*sqrt(p) + lagway(s, 0.4)*2e2 - -h^3",
)


def as_read(entry, folder, without=()):
    """What the example reader says of an entry; its exit code is not 0 where it refuses."""
    columns, channels, time = table()
    sidecar, symbols = folder / "tire.tir.sidecar.json", folder / "symbols.csv"
    sidecar.write_text(json.dumps({"effects": {"unnamed": entry}}))
    names = {n: columns.columns[n] for n in columns.columns if n not in {*asdict(NOMINAL), "way"}}
    rows = pd.DataFrame({**names, "time": time, "speed": channels["speed"]})
    rows.drop(columns=list(without)).to_csv(symbols, index=False)
    command = [sys.executable, "-I", str(READER), str(sidecar), str(symbols)]
    return subprocess.run(command, check=False, capture_output=True, text=True)


TOGETHER = "sqrt((0.003*fy*(v) + (-0.002)*fy)^2 + (0.0007*fy)^2)"


@pytest.mark.parametrize(
    ("text", "ranges"),
    [*((text, None) for text in EQUATIONS), (EQUATIONS[0], {"v": (0.7, 1.3), TOGETHER: (0.0, 4.0)})],
)
def test_a_reader_without_our_code_gives_the_same_force(text, ranges, tmp_path):
    found = physics(text, ranges)
    said = as_read(found.to_sidecar(), tmp_path).stdout
    read = np.array([float(row["fy"]) for row in csv.DictReader(said.splitlines())])
    own = found.change(table()[0])["fy"]
    assert np.max(np.abs(own)) > 1.0
    np.testing.assert_allclose(read, own, rtol=1e-9, atol=1e-9 * np.max(np.abs(own)))


@pytest.mark.parametrize(
    "change",
    [
        {"equation": {"fy": text}}
        for text in (
            "fy*v) + 1",
            "fy 5",
            "2^9^9",
            "open(fy)",
            "*(fy)",
            "abs(fy, 3)",
            "play(fy)",
            "lag(fy, inf)",
            "1e999*fy",
            "1e99^9*fy - 1e99^9*fy",
            "fy/(v - v)",
            "(" * 900 + "fy" + ")" * 900,
            "+".join(["fy"] * 2000),
        )
    ]
    + [
        {"equation": {"mx": "fy"}},
        {"format": "other"},
        {"format": "unnamed physics 3", "equation": {"fy": "fy*sin(way)"}},
        {"range": {"v": [float("nan"), 1.0]}},
    ],
)
def test_the_reader_refuses_what_is_not_of_the_grammar_or_not_finite(change, tmp_path):
    found = as_read({**physics("0.1*fy*v").to_sidecar(), **change}, tmp_path)
    assert found.returncode != 0
    assert not found.stdout


def test_the_reader_is_short_and_evaluates_nothing():
    lines = READER.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 80
    assert not any(word in "\n".join(lines) for word in ("eval(", "exec(", "__import__"))


def test_steady_points_need_no_time_where_an_equation_remembers_nothing(tmp_path):
    found = physics("0.1*fy*v")
    said = as_read(found.to_sidecar(), tmp_path, without=("time", "t", "speed")).stdout
    read = np.array([float(row["fy"]) for row in csv.DictReader(said.splitlines())])
    np.testing.assert_allclose(read, found.change(table()[0])["fy"], rtol=1e-9)


@pytest.mark.parametrize("text", ["fy*lag(s, 1)", "fy*play(s, 0.01)", "fy*highest(s)", "fy*sin(way)", "fy*t"])
def test_an_equation_of_the_clock_or_of_what_was_is_refused_without_time(text, tmp_path):
    found = as_read(physics(text).to_sidecar(), tmp_path, without=("time", "t"))
    assert found.returncode != 0
    assert not found.stdout


@pytest.mark.parametrize("text", ["fy*lagway(s, 1)", "fy*sin(way)"])
def test_an_equation_of_the_way_rolled_is_refused_without_speed(text, tmp_path):
    found = as_read(physics(text).to_sidecar(), tmp_path, without=("speed",))
    assert found.returncode != 0
    assert not found.stdout
