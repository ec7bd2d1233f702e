"""A tire and recordings of it, and the command ``tire`` called on them."""

from __future__ import annotations

import json
import re

import numpy as np
import pandas as pd
from click.testing import CliRunner

from tire_pipeline.command.cli import tire
from tire_pipeline.magic_formula import TireModel

COEFFICIENTS = {
    "FNOMIN": 4000.0,
    "UNLOADED_RADIUS": 0.32,
    "LONGVL": 16.7,
    "PCY1": 1.35,
    "PDY1": 1.02,
    "PDY2": -0.1,
    "PEY1": -1.2,
    "PKY1": -22.0,
    "PKY2": 2.1,
    "PCX1": 1.6,
    "PDX1": 1.1,
    "PKX1": 22.0,
    "PHY3": 0.01,
}


def record(name: str, *, seed: int = 0, friction: float = 1.0, seconds: float = 80.0) -> None:
    rng = np.random.default_rng(seed)
    time = np.arange(0.0, seconds, 0.02)
    angle = 0.16 * np.sin(2.0 * np.pi * time / 7.0)
    load = np.array([2500.0, 4500.0, 6000.0])[(time // 14.0).astype(int) % 3]
    fy = (
        friction
        * TireModel.from_coefficients(COEFFICIENTS).forces(slip_angle=angle / friction, normal_load=load).fy
    )
    columns = {"time": time, "slip_angle": angle, "normal_load": load}
    noise = 25.0 * rng.standard_normal(time.size)
    pd.DataFrame({**columns, "fy": fy + noise}).to_csv(name, index=False)


def run(*arguments: str, code: int = 0):
    leftovers = dict.fromkeys(("COLUMNS", "FORCE_COLOR", "TTY_COMPATIBLE"))  # of other tests
    each = [str(argument) for argument in arguments]
    result = CliRunner(env=leftovers).invoke(tire, each, catch_exceptions=False)
    assert result.exit_code == code, result.output
    return result


def told(*arguments: str, code: int = 0):
    return json.loads(run(*arguments, "--json", code=code).stdout)


def page(path) -> str:
    text = path.read_text(encoding="utf-8")
    assert not re.search(r"""(src|href)\s*=\s*["'](?!#|data:)""", text.replace("xlink:href", "href"))
    return text
