"""Files that say odd things stop no translator from learning from the others."""

import re

import numpy as np
import pytest
from small_fleet import table_of

from tire_pipeline.files.state_files import pack_state
from tire_pipeline.tire_table import normalize_table
from tire_pipeline.translation.translator import MixedModel

pytestmark = pytest.mark.slow
HEAD = """[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
[MODEL]
FITTYP = 6
[DIMENSION]
UNLOADED_RADIUS = {radius}
WIDTH = 0.2
ASPECT_RATIO = 0.55
RIM_RADIUS = 0.2032
[VERTICAL]
FNOMIN = 4000
[LATERAL_COEFFICIENTS]
"""
LATERAL = {"PCY1": 1.3, "PDY1": 0.95, "PDY2": -0.2, "PEY1": -0.7, "PKY1": -20.0, "PKY2": 2.0}
SAME_IN_ALL = "PCX1 = 1.6\nPDX1 = 1.1\nPKX1 = 22.0\nQBZ1 = 10.0\nQCZ1 = 1.1\nQDZ1 = 0.1\n"


def _files(repeats):
    """Some files of each tire and category; only lateral coefficients were measured each time."""
    files = {}
    for tire in range(15):
        for category, bias in {"A": 1.1, "B": 0.9, "D": 1.0}.items():
            for k in range(repeats):
                draws = np.random.default_rng([tire, k]).normal(1.0, 0.02, len(LATERAL))
                values = LATERAL | {"PDY1": bias * LATERAL["PDY1"], "PKY1": bias * LATERAL["PKY1"]}
                values = zip(values, draws * np.array(list(values.values())), strict=True)
                text = HEAD.format(radius=0.3 + 0.001 * tire) + "".join(f"{n} = {v:.9g}\n" for n, v in values)
                text += SAME_IN_ALL
                files[f"tir/{category}/T{tire}_{k}.tir"] = text
    return files


def _learnt(files):
    return MixedModel(pairs=False).fit(normalize_table(table_of(files), 4000.0), target="D")


def test_coefficients_that_were_copied_into_all_files_of_a_tire_stop_nothing():
    """They spread by nothing within a tire's files, and say nothing of how far suppliers are apart.

    Half of the bias of the side force stayed: they were counted, too.
    """
    files = _files(4)
    table = normalize_table(table_of({n: t for n, t in files.items() if "/A/" in n}), 4000.0)
    found = _learnt(files).translation(table)
    assert set(found.report["verdict"]) == {"translated"}
    assert (found.table["PDY1"] / table["PDY1"]).median() == pytest.approx(1.0 / 1.1, rel=0.01)


def test_a_file_whose_curves_overflow_is_named_and_changes_nothing(caplog):
    files = _files(1)
    text = re.sub(r"PKY2 = \S+", "PKY2 = 1e-320", files["tir/A/T3_0.tir"])
    with_it = _learnt(files | {"tir/A/odd.tir": text})
    assert "tir/A/odd.tir is not learned from: its curves overflow" in caplog.text
    assert pack_state(with_it.to_state()) == pack_state(_learnt(files).to_state())
