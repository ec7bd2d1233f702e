"""The catalogue: open to effects from outside, and known by name to none of the engine's other files."""

import ast
from importlib.metadata import EntryPoint
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import tire_pipeline.mismatch
from tire_pipeline.errors import DomainError
from tire_pipeline.mismatch import effects, explain_mismatch
from tire_pipeline.mismatch.effects import Effect, Parameter, catalogue, register

FOLDER = Path(tire_pipeline.mismatch.__file__).parent
CHANNELS = {"camber", "turn_slip"}
"""Names of effects that are names of channels, too."""


class BeltLift(Effect):
    """The belt takes some of the load away, with the square of the speed: made up, in a stranger's file."""

    name = "belt_lift"
    title = "a belt that lifts with speed"
    equation = "normal load *= 1 - lift (v / 20 m/s)^2"
    source = "made up for this test"
    channels = ("speed",)
    family = "speed"
    parameters = (Parameter("lift", "1", -0.5, 0.5, 0.01, prior=0.1),)
    order = 20

    def inputs(self, state, data, p):
        """Take some of the load away."""
        state.normal_load = state.normal_load * (1.0 - p["lift"] * (data.get("speed") / 20.0) ** 2)


@pytest.fixture
def belt_lift():
    register(BeltLift())
    yield
    catalogue().pop("belt_lift")


@pytest.fixture
def sweep_at_speeds():
    """Sweeps of the slip angle at four loads and three speeds."""
    t = np.arange(0.0, 180.0, 0.05)
    sweep = (t // 15.0).astype(int)
    slip_angle = 0.18 * np.sin(2.0 * np.pi * t / 7.5)
    load = np.array([3000.0, 5500.0, 1800.0, 4200.0])[sweep % 4]
    speed = np.array([8.0, 16.0, 28.0])[sweep // 4]
    return pd.DataFrame({"time": t, "slip_angle": slip_angle, "normal_load": load, "speed": speed})


def test_an_effect_from_outside_is_found_in_a_recording(belt_lift, tire, sweep_at_speeds):
    recording = sweep_at_speeds
    lifted = recording["normal_load"] * (1.0 - 0.12 * (recording["speed"] / 20.0) ** 2)
    fy = tire.forces(slip_angle=recording["slip_angle"].to_numpy(), normal_load=lifted.to_numpy()).fy
    noise = np.random.default_rng(5).normal(0.0, 15.0, len(recording))
    report = explain_mismatch(tire, recording.assign(fy=fy + noise))
    assert report.sets[0][0][0] == "belt_lift"
    (found,) = report.effects
    value, error, _ = found.parameters["lift"]
    assert abs(value - 0.12) < 3.0 * error
    assert report.fit["fy"].rms_after < 0.5 * report.fit["fy"].rms_before


def test_a_name_is_given_once():
    with pytest.raises(DomainError, match="already"):
        register(catalogue()["temperature"])


@pytest.mark.parametrize("lacking", ["name", "title", "equation", "source"])
def test_an_effect_states_what_it_is(lacking):
    nameless = type("Nameless", (BeltLift,), {lacking: ""})
    with pytest.raises(DomainError, match=f"no {lacking}"):
        register(nameless())


def test_an_installed_package_offers_its_effects(monkeypatch):
    entry = EntryPoint("belt_lift", f"{__name__}:BeltLift", effects.GROUP)
    monkeypatch.setattr(EntryPoint, "load", lambda self: BeltLift)
    monkeypatch.setattr(effects, "entry_points", lambda group: [entry] if group == effects.GROUP else [])
    catalogue.cache_clear()
    try:
        assert isinstance(catalogue()["belt_lift"], BeltLift)
    finally:
        catalogue.cache_clear()


def test_no_name_of_an_effect_outside_of_their_folder():
    names = set(catalogue()) - CHANNELS
    said = []
    for path in sorted(FOLDER.rglob("*.py")):
        if "effects" in path.relative_to(FOLDER).parts:
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and node.value in names:
                said.append(f"{path.relative_to(FOLDER)}:{node.lineno} {node.value}")
    assert not said
