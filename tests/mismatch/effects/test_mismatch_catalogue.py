"""The catalogue: open to effects from outside, and known by name to none of the engine's other files."""

import ast
from importlib.metadata import EntryPoint
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from belt_lift import BeltLift, lifted_sweeps
from weighed import all_but

import tire_pipeline.mismatch
from tire_pipeline.errors import DomainError
from tire_pipeline.mismatch import Explainer, effects
from tire_pipeline.mismatch.effects import State, catalogue, register

FOLDER = Path(tire_pipeline.mismatch.__file__).parent
CONTEXT = FOLDER / "effects" / "context.py"
CHANNELS = {"camber", "turn_slip"}
"""Names of effects that are names of channels, too."""


@pytest.fixture
def belt_lift():
    register(BeltLift())
    yield
    catalogue().pop("belt_lift")


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.long)])
def test_an_effect_from_outside_is_weighed_with_the_others(belt_lift, tire, seed):
    """And tells what it is alone: the lift is found to three of its errors in most draws (``rates``)."""
    few = all_but("belt_lift", "friction_scale", "stiffness_scale", "load_gain", "load_sensitivity")
    answer = Explainer(without=few).weigh(tire, lifted_sweeps(tire, seed)).answer
    assert "belt_lift" in answer.gains
    ((_, found),) = answer.single("belt_lift")
    assert found["lift"] > 0.0


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


def test_an_effect_needs_no_more_than_what_it_asks_of_its_context():
    spin = np.array([0.0, 0.1])
    zero = np.zeros(2)
    state = State(zero, zero, zero, zero, zero, zero, zero, zero)
    data = SimpleNamespace(get={"turn_slip": spin}.get, nominal=SimpleNamespace(radius=0.3))
    catalogue()["turn_slip"].tire(state, data, {"shift": 0.5, "friction_loss": 1.0})
    np.testing.assert_allclose(state.slip_angle, 0.5 * spin)
    np.testing.assert_allclose(state.log_friction, np.log(1.0 - 0.3 * spin))


def test_the_context_has_nothing_that_no_effect_asks_for():
    text = "".join(p.read_text(encoding="utf-8") for p in (FOLDER / "effects").rglob("*.py") if p != CONTEXT)
    members = [
        each.name
        for protocol in ast.parse(CONTEXT.read_text(encoding="utf-8")).body
        if isinstance(protocol, ast.ClassDef)
        for each in protocol.body
        if isinstance(each, ast.FunctionDef)
    ]
    assert len(members) > 30
    assert [name for name in members if f".{name}" not in text] == []


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


def test_folders_have_a_dozen_files_at_most_and_the_method_80_lines():
    counts = {
        str(folder.relative_to(FOLDER)): len(list(folder.glob("*.py")))
        for folder in (FOLDER, *FOLDER.rglob("*"))
        if folder.is_dir()
    }
    assert {name: count for name, count in counts.items() if count > 12} == {}
    assert len((FOLDER / "explain.py").read_text(encoding="utf-8").splitlines()) <= 80
