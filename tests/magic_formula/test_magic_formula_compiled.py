"""Compiled code against the NumPy form, and derivatives against differences."""

import json
import os
import subprocess
import sys
from contextlib import contextmanager
from functools import partial

import numpy as np
import pytest
from magic_formula_tires import tire_52, tire_61

from tire_pipeline.errors import TirValueError
from tire_pipeline.magic_formula.compiled import engine
from tire_pipeline.magic_formula.derivatives.gradients import gradients_of
from tire_pipeline.magic_formula.equations import numpy_form
from tire_pipeline.magic_formula.equations.jit import HAVE_NUMBA, compiled
from tire_pipeline.magic_formula.equations.numpy_form import OUTPUTS

pytestmark = pytest.mark.slow

TIRES = {"5.2": tire_52(), "6.1": tire_61()}
RNG = np.random.default_rng(1)
COUNT = 1500
POINTS = {
    "slip_angle": RNG.uniform(-1.5, 1.5, COUNT),
    "slip_ratio": RNG.uniform(-1.0, 3.0, COUNT),
    "camber": RNG.uniform(-0.4, 0.4, COUNT),
    "normal_load": RNG.uniform(-500, 15000, COUNT),
    "speed": RNG.uniform(-10, 60, COUNT),
    "pressure": RNG.uniform(1.5e5, 3e5, COUNT),
}
each_tire = pytest.mark.parametrize("tire", TIRES.values(), ids=TIRES.keys())
needs_numba = pytest.mark.skipif(not HAVE_NUMBA, reason="numba is switched off or missing")


def by_numpy(tire):
    return numpy_form.evaluate(tire.packed, tire.family, *POINTS.values())


@needs_numba
@each_tire
@pytest.mark.parametrize("outputs", [("fy", "fx"), ("fx", "fy", "mz"), OUTPUTS])
def test_compiled_is_numpy_to_12_digits(tire, outputs):
    forces = tire.forces(**POINTS, outputs=outputs, limits="ignore")
    for name, value in zip(OUTPUTS, by_numpy(tire), strict=True):
        if name in outputs:
            largest = np.abs(value).max()
            np.testing.assert_allclose(getattr(forces, name), value, rtol=1e-12, atol=1e-12 * largest)


@needs_numba
@each_tire
def test_one_point_is_as_many_points(tire):
    forces = tire.forces(**POINTS, limits="ignore")
    for i in range(0, COUNT, 97):
        one = tire.forces(**{name: float(x[i]) for name, x in POINTS.items()})
        for name in OUTPUTS:
            many = getattr(forces, name)
            assert getattr(one, name) == pytest.approx(many[i], rel=1e-12, abs=1e-12 * np.abs(many).max())


@needs_numba
@each_tire
def test_threads_change_nothing(tire, monkeypatch):
    large = {name: np.tile(x, 30) for name, x in POINTS.items()}
    monkeypatch.setenv("NUMBA_NUM_THREADS", "1")
    assert engine.thread_count() == 1
    one = tire.forces(**large, limits="ignore")
    monkeypatch.setenv("NUMBA_NUM_THREADS", "3")
    three = tire.forces(**large, limits="ignore")
    for name in OUTPUTS:
        largest = np.abs(getattr(one, name)).max()
        np.testing.assert_allclose(getattr(three, name), getattr(one, name), rtol=1e-12, atol=1e-12 * largest)


@pytest.mark.filterwarnings("ignore::tire_pipeline.magic_formula.DegreesWarning")
def test_very_large_angles_and_shapes_go_to_numpy():
    tire = TIRES["5.2"]
    far = tire.forces(slip_angle=[1e8 + 0.3, 0.1], normal_load=3000.0, limits="ignore")
    wanted = numpy_form.evaluate(
        tire.packed, 5, np.array([1e8 + 0.3, 0.1]), 0.0, 0.0, np.full(2, 3000.0), np.full(2, 16.7), 0.0
    )
    np.testing.assert_array_equal(far.mz, wanted[4])
    assert not engine.compiles(tire.replace(RCY1=1e5).packed[None, :]).any()


@needs_numba
def test_a_tire_that_goes_to_numpy_leaves_those_beside_it_as_they_are():
    tire = TIRES["5.2"]
    several = np.stack([tire.packed, tire.replace(RCY1=1e5).packed, tire.packed])
    points = [
        np.tile(x, (3, 1))
        for x in np.array([[0.1, 0.05], [0.0, 0.02], [0, 0], [3e3] * 2, [16.7] * 2, [0, 0]])
    ]
    run = partial(engine.run, family=5, signs=engine.NO_SIGNS, wanted=["fx", "fy"], largest_angle=0.1)
    together = run(several, points=points)
    for row in range(3):
        alone = run(several[[row]], points=[x[[row]] for x in points])
        np.testing.assert_array_equal(together[row], alone[0])


def test_without_numba_the_results_are_the_same():
    code = (
        "import json; from magic_formula_tires import tire_52, tire_61; "
        "from tire_pipeline.magic_formula.equations.jit import HAVE_NUMBA; assert not HAVE_NUMBA\n"
        "for t in (tire_52(), tire_61()):\n"
        "    f = t.forces(slip_angle=[0.05, -0.1], slip_ratio=[0.1, 0.0], camber=0.02, normal_load=3000.0)\n"
        "    j = t.jacobian(['PKY1'], slip_angle=0.05, normal_load=3000.0)['fy']\n"
        "    print(json.dumps([f.fx.tolist(), f.fy.tolist(), f.mz.tolist(), j.tolist()]))\n"
    )
    environment = {**os.environ, "TIRE_PIPELINE_NO_NUMBA": "1", "PYTHONPATH": os.path.dirname(__file__)}
    lines = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    ).stdout.splitlines()
    for tire, line in zip(TIRES.values(), lines, strict=True):
        f = tire.forces(slip_angle=[0.05, -0.1], slip_ratio=[0.1, 0.0], camber=0.02, normal_load=3000.0)
        j = tire.jacobian(["PKY1"], slip_angle=0.05, normal_load=3000.0)["fy"]
        for ours, theirs in zip((f.fx, f.fy, f.mz, j), json.loads(line), strict=True):
            np.testing.assert_allclose(ours, theirs, rtol=1e-12)


@each_tire
@pytest.mark.parametrize("output", ["fx", "fy", "mx", "my", "mz"])
def test_derivatives_are_the_slopes(tire, output):
    points = {name: x[:200] for name, x in POINTS.items()}
    points["slip_angle"] = points["slip_angle"] / 5
    points["normal_load"] = np.abs(points["normal_load"]) + 500
    names = gradients_of(tire.family).OVER[output]
    found = tire.jacobian(names, **points, outputs=(output,))[output]
    assert found.shape == (200, len(names))
    for column, name in enumerate(names):
        value = tire.value(name)
        step = 1e-5 * max(abs(value), 1e-2)
        high, low = (
            getattr(tire.replace(**{name: value + s}).forces(**points, limits="ignore"), output)
            for s in (step, -step)
        )
        slope = (high - low) / (2 * step)
        # points next to a kink (a curvature factor at its bound) have another slope on the other side
        off = np.abs(found[:, column] - slope) > 1e-5 * np.abs(slope).max() + 1e-9 * np.abs(high).max() / step
        assert off.sum() <= 2, name


def test_a_converted_model_has_the_derivatives_of_the_first():
    tire = TIRES["5.2"].replace(LGAX=1.0, LGAY=1.0, LGAZ=1.0)
    names = ["PDY1", "PKY1", "PHY3", "PVY1", "PDX1", "QDZ1"]
    points = {"slip_angle": [0.05, -0.1], "slip_ratio": 0.03, "camber": 0.06, "normal_load": 3000.0}
    before = tire.jacobian(names, **points)
    after = tire.to_version("6.1").jacobian(names, **points)
    for output in ("fx", "fy", "mz"):
        np.testing.assert_allclose(after[output], before[output], rtol=1e-8, atol=1e-9)


def test_derivatives_know_their_names():
    tire = TIRES["5.2"]
    found = tire.jacobian(["PKY1", "PCX1"], slip_angle=[[0.1, 0.2]], normal_load=3000.0, outputs=("fy",))
    assert found["fy"].shape == (1, 2, 2)
    assert (found["fy"][..., 1] == 0).all()
    assert (tire.jacobian(["PKY1"], slip_angle=0.1, normal_load=-5.0)["fy"] == 0).all()
    with pytest.raises(TirValueError, match="NOSUCH"):
        tire.jacobian(["NOSUCH"], normal_load=3000.0)
    with pytest.raises(TirValueError, match="trail"):
        tire.jacobian(["PKY1"], normal_load=3000.0, outputs=("trail",))


@needs_numba
def test_compiling_says_that_it_is_under_way(monkeypatch):
    said = []

    @contextmanager
    def watched(what):
        said.append(what)
        yield

    monkeypatch.setattr("tire_pipeline.progress.under_way", watched)
    assert compiled(lambda x: 2.0 * x, "float64(float64)")(1.5) == 3.0
    assert said == ["compiling the equations (first use only)"]
