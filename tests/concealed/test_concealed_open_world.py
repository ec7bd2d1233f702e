"""Mechanisms in no catalogue: sizes, closed forms, causality, and the seal."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy

import tire_pipeline.concealed.open_world as open_world
from tire_pipeline.concealed.open_world import sealed, tuning
from tire_pipeline.concealed.open_world.mechanism import Mechanism, put_in, strength_of
from tire_pipeline.concealed.open_world.memory import asymmetric, bouc_wen, play
from tire_pipeline.concealed.open_world.on_second import draw_world
from tire_pipeline.concealed.open_world.world import FORCES, SYMBOLS, World
from tire_pipeline.concealed.second import content_hash
from tire_pipeline.mismatch.unnamed_physics.language.symbols import CHANNEL

ALL = (*tuning.MECHANISMS, *sealed.MECHANISMS)
WRITTEN = [mechanism for mechanism in ALL if mechanism.expressions]
by_name = pytest.mark.parametrize("mechanism", ALL, ids=lambda mechanism: mechanism.name)
by_form = pytest.mark.parametrize("mechanism", WRITTEN, ids=lambda mechanism: mechanism.name)


@pytest.fixture(scope="module")
def run() -> tuple[World, np.ndarray]:
    world, noise = draw_world(np.random.default_rng(29), rows=2400)
    return world, np.hypot(noise, 0.02 * np.sqrt(np.mean(world.forces**2, axis=0)))


def parsed(text: str) -> sympy.Expr:
    return sympy.sympify(text, locals={name: sympy.Symbol(name) for name in SYMBOLS})


def test_twelve_to_tune_on_and_twelve_others() -> None:
    assert len(tuning.MECHANISMS) == len(sealed.MECHANISMS) == 12
    assert len({mechanism.name for mechanism in ALL}) == 24
    for dozen in (tuning.MECHANISMS, sealed.MECHANISMS):
        assert sum(bool(mechanism.expressions) for mechanism in dozen) == 6


@by_name
def test_a_mechanism_has_the_strength_asked_for(mechanism: Mechanism, run) -> None:
    world, unit = run
    for wanted in (0.5, 6.0):
        added = put_in(mechanism, world, unit, np.random.default_rng(3), wanted)
        assert added.change.shape == world.forces.shape
        assert np.all(np.isfinite(added.change))
        assert strength_of(added.change, unit) == pytest.approx(wanted, rel=0.01)


@by_name
def test_size_nought_changes_nothing(mechanism: Mechanism, run) -> None:
    world, _ = run
    shape = mechanism.shape(np.random.default_rng(3))
    np.testing.assert_allclose(mechanism.change(world, 0.0, shape), 0.0, atol=1e-9)


@by_name
def test_what_comes_later_changes_nothing_before(mechanism: Mechanism, run) -> None:
    world, _ = run
    shape = mechanism.shape(np.random.default_rng(3))
    first = slice(0, 1200)
    short = replace(world, channels=world.channels.iloc[first], forces=world.forces[first])
    short = replace(short, tire=lambda channels: world.tire(padded(world, channels))[first])
    whole = mechanism.change(world, mechanism.begin, shape)[first]
    np.testing.assert_allclose(mechanism.change(short, mechanism.begin, shape), whole, rtol=1e-6, atol=1e-6)


def padded(world: World, channels):
    """The short run's channels on top of the whole run's."""
    whole = world.channels.copy()
    whole.iloc[: len(channels)] = channels.to_numpy()
    return whole


@by_form
def test_the_closed_form_is_what_is_done(mechanism: Mechanism, run) -> None:
    world, _ = run
    rows = np.random.default_rng(0).choice(len(world.channels), 200, replace=False)
    change = mechanism.change(world, 0.3, {})
    values = {name: x[rows] for name, x in world.groups().items()} | {"c": 0.3}
    for index, force in enumerate(FORCES):
        if force not in mechanism.expressions:
            assert not np.any(change[:, index])
            continue
        form = parsed(mechanism.expressions[force])
        names = sorted(symbol.name for symbol in form.free_symbols)
        found = sympy.lambdify(names, form, "numpy")(*(values[name] for name in names))
        np.testing.assert_allclose(change[rows, index], found, rtol=1e-9, atol=1e-9)


@by_form
def test_the_closed_form_has_at_most_twelve_nodes_and_its_drivers(mechanism: Mechanism) -> None:
    for text in mechanism.expressions.values():
        form = parsed(text)
        assert sum(1 for _ in sympy.preorder_traversal(form)) <= 12
        names = {symbol.name for symbol in form.free_symbols}
        assert names <= set(SYMBOLS)
        assert {CHANNEL[name] for name in names & set(CHANNEL) - {"t"}} <= set(mechanism.drivers)


def test_strengths_are_drawn_between_half_and_six(run) -> None:
    world, unit = run
    mechanism = tuning.MECHANISMS[0]
    drawn = [put_in(mechanism, world, unit, np.random.default_rng(seed)).strength for seed in range(40)]
    assert min(drawn) > 0.49
    assert max(drawn) < 6.1
    assert max(drawn) > 3.0 * min(drawn)


def test_a_run_that_cannot_show_it_is_told(run) -> None:
    world, unit = run
    still = replace(world, channels=world.channels.assign(camber=0.0))
    lift = next(mechanism for mechanism in ALL if mechanism.name == "edge lift")
    with pytest.raises(ValueError, match=r"edge lift: no size .* excite camber"):
        put_in(lift, still, unit, np.random.default_rng(0), 1.0)


def test_operators_with_a_memory() -> None:
    there_and_back = np.concatenate([np.linspace(0.0, 1.0, 50), np.linspace(1.0, 0.0, 50)])
    played = play(there_and_back, 0.4)
    assert played[49] == pytest.approx(0.8)
    assert played[-1] == pytest.approx(0.2)
    looped = bouc_wen(there_and_back, 0.1)
    assert looped[49] > 0.9
    assert looped[-1] < -0.9
    kept = asymmetric(np.repeat([1.0, 0.0], 100), 0.01, 0.05, 5.0)
    assert kept[99] > 0.99
    assert kept[-1] > 0.7


def test_the_committed_content_is_the_stated_one() -> None:
    page = (Path(__file__).parents[2] / "docs" / "decisions" / "simulators.md").read_text(encoding="utf-8")
    assert content_hash(Path(open_world.__file__).parent) in page
