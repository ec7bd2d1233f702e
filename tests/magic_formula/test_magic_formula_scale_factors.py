"""Each scale factor scales what its name says, and nothing that it should not."""

from __future__ import annotations

import numpy as np
import pytest
from magic_formula_tires import tire_52, tire_61

from tire_pipeline.magic_formula import TireModel

CARCASS = {"LATERAL_STIFFNESS": 0.0, "LONGITUDINAL_STIFFNESS": 0.0}  # relaxation lengths by PTX and PTY
TIRES = {"5.2": tire_52(), "6.1": tire_61().replace(**CARCASS)}
each_tire = pytest.mark.parametrize("tire", TIRES.values(), ids=TIRES.keys())
POINT = {"slip_angle": [0.05, -0.08], "slip_ratio": [-0.04, 0.06], "camber": [0.06, 0.04]}
POINT |= {"normal_load": [3000.0, 5500.0], "limits": "ignore"}

FORCES = ("fx", "fy", "mx", "my", "mz")
BOTH = {name: "fx" for name in ("LCX", "LMUX", "LEX", "LKX", "LHX", "LVX", "LXAL")}
BOTH |= {name: "fy" for name in ("LCY", "LMUY", "LEY", "LKY", "LHY", "LVY", "LYKA", "LVYKA")}
BOTH |= {"LTR": "mz", "LRES": "mz", "LS": "mz", "LVMX": "mx", "LMX": "mx", "LMY": "my"}
ACTS_ON = {
    "5.2": BOTH | {"LGAX": "fx", "LGAY": "fy", "LGAZ": "mz"},
    "6.1": BOTH | {"LKYC": "fy", "LKZC": "mz"},
}


def scaled(tire: TireModel, name: str, factor: float) -> TireModel:
    return tire.replace(**{name: factor * tire.value(name)})


@pytest.mark.parametrize(("version", "name"), [(v, name) for v, names in ACTS_ON.items() for name in names])
def test_each_acts_on_its_force_and_those_of_a_moment_on_no_force(version: str, name: str):
    before, after = (t.forces(**POINT) for t in (TIRES[version], scaled(TIRES[version], name, 0.5)))
    changed = {f for f in FORCES if not np.allclose(getattr(before, f), getattr(after, f), rtol=1e-5)}
    own = ACTS_ON[version][name]
    assert own in changed
    if own.startswith("m"):
        assert changed == {own}


@each_tire
@pytest.mark.parametrize(
    ("name", "output"),
    [
        ("LMUX", "friction_x"),
        ("LMUY", "friction_y"),
        ("LKX", "slip_stiffness"),
        ("LKY", "cornering_stiffness"),
        ("LTR", "trail"),
        ("LMY", "my"),
        ("LSGAL", "relaxation_lateral"),
        ("LSGKP", "relaxation_longitudinal"),
    ],
)
def test_what_is_proportional_to_a_factor(tire: TireModel, name: str, output: str):
    before, after = (getattr(t.forces(**POINT), output) for t in (tire, scaled(tire, name, 0.7)))
    assert np.abs(before).min() > 0.0
    np.testing.assert_allclose(after, 0.7 * before, rtol=1e-12)


def test_nothing_depends_on_the_camber_where_its_factors_are_zero():
    """What is left of it in 5.2 has no factor: the arm of Fx, the side force of slip ratio, and Mx."""
    without_factor = dict.fromkeys(("LGAX", "LGAY", "LGAZ", "SSZ3", "SSZ4", "RVY3", "QSX2"), 0.0)
    tire = TIRES["5.2"].replace(**without_factor)
    leaning, upright = tire.forces(**POINT), tire.forces(**POINT | {"camber": 0.0})
    for name in FORCES:
        np.testing.assert_allclose(getattr(leaning, name), getattr(upright, name), rtol=1e-12, err_msg=name)
