"""Fits to a dozen subsets of real sweeps beside the least that 30 random starts reach.

`benchmarks/drawn_subsets.py` draws the subsets; `fit_subsets.py` has found the least of a hundred of them.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from tire_pipeline.magic_formula.fitting import fit_magic_formula

pytestmark = pytest.mark.slow

BENCHMARKS = Path(__file__).resolve().parents[2] / "benchmarks"


@pytest.fixture(scope="module")
def subsets():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(BENCHMARKS))
        import drawn_subsets
        import fit_subsets as module
    if not (drawn_subsets.SHARED / "recordings" / "calspan").is_dir() and not os.environ.get("CI"):
        pytest.skip(f"no recordings in {drawn_subsets.SHARED}")
    return module


def kept(part, forces):
    """The inputs and some of the outputs."""
    inputs = [
        n
        for n in ("slip_angle", "slip_ratio", "camber", "normal_load", "speed", "pressure")
        if n in part.rows
    ]
    return part.rows[[*inputs, *forces]]


def over(problem, fit, best) -> float:
    """RMS of the fit over that of other values."""
    return problem.misfit(np.array([fit.model.value(n) for n in problem.names])) / problem.misfit(best)


def searched(module, part, fit, forces) -> dict[str, float]:
    """RMS of the fit over the least of random starts made now, by force."""
    problems = {f: module.problem_of(fit.model, f, part.rows) for f in forces}
    return {f: over(p, fit, module.least(p, np.random.default_rng(part.seed))) for f, p in problems.items()}


def ratios(module, part, fit, forces) -> dict[str, float]:
    """RMS of the fit over the least that the benchmark has kept, by force; for moments searched now."""
    problems = {f: module.problem_of(fit.model, f, part.rows) for f in forces}
    rng = np.random.default_rng(part.seed)
    return {f: over(p, fit, module.stored_least(p, part, rng)) for f, p in problems.items()}


@pytest.mark.parametrize(
    ("number", "forces"),
    [
        (2, ("fy", "mz")),
        (3, ("fx", "fy")),
        (4, ("fy",)),  # 45 points are few for the 24 coefficients of Mz, and are not fitted to the least
        (5, ("fy",)),
        (9, ("fy",)),  # 56 points for the 24 coefficients of Mz: a known miss, 1.11 in fit_subsets.csv
        (12, ("fy",)),
        pytest.param(18, ("fx", "fy"), marks=pytest.mark.long),
        (21, ("fy",)),
        (27, ("fy",)),
    ],
)
def test_no_random_start_leaves_clearly_less(subsets, number, forces):
    part = subsets.subset(number)
    fit = fit_magic_formula(kept(part, forces))
    found = ratios(subsets, part, fit, forces)
    assert max(found.values()) <= 1.05, (part.what, found)


def test_the_rate_of_a_recording_does_not_decide_how_well_it_is_fitted(subsets):
    """At 50 Hz one minimum came out four times before a better one, and 9% more was left."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(BENCHMARKS))
        import flat_belt_hidden
    shares = []
    for rate in (100, 50, 20, 10):
        table = flat_belt_hidden.sweeps(rate)
        plain = table[~table["low"] & ~table["leaning"]]
        shares.append(fit_magic_formula(plain[["slip_angle", "normal_load", "fy"]]).relative_rms["fy"])
    assert max(shares) <= 1.05 * min(shares)


@pytest.mark.long
@pytest.mark.parametrize(("number", "forces"), [(2, ("fy", "mz")), (3, ("fx", "fy")), (5, ("fy",))])
def test_random_starts_made_now_leave_no_less_than_the_stored_ones(subsets, number, forces):
    part = subsets.subset(number)
    fit = fit_magic_formula(kept(part, forces))
    stored, now = (of(subsets, part, fit, forces) for of in (ratios, searched))
    assert now == pytest.approx(stored, rel=0.01)


MISSED = pytest.mark.xfail(
    strict=True, reason="known miss: 1.5 to 3.6 times as far as the least of the starts"
)


@pytest.mark.parametrize(
    ("number", "version"),
    [
        (0, "5.2"),
        (1, "5.2"),
        (6, "6.1"),
        pytest.param(20, "5.2", marks=MISSED),
        pytest.param(30, "6.1", marks=pytest.mark.long),
        pytest.param(56, "6.1", marks=pytest.mark.long),
        pytest.param(61, "5.2", marks=[MISSED, pytest.mark.long]),
    ],
)
def test_loads_left_out_are_met_as_well_as_by_the_best_of_random_starts(subsets, number, version):
    part = subsets.subset(number)
    fit = fit_magic_formula(kept(part, ("fy",)), version)
    here, there = (subsets.problem_of(fit.model, "fy", rows) for rows in (part.rows, part.left_out))
    best = subsets.stored_least(here, part, np.random.default_rng(number))
    assert over(there, fit, best) <= 1.2


@pytest.mark.parametrize("number", [1, *(pytest.param(each, marks=pytest.mark.long) for each in (10, 22))])
def test_a_richer_formula_leaves_no_more(subsets, number):
    part = subsets.subset(number)
    rows = kept(part, ("fy",))
    simple, rich = (fit_magic_formula(rows, version) for version in ("5.2", "6.1"))
    assert rich.relative_rms["fy"] <= 1.02 * simple.relative_rms["fy"]
    assert ratios(subsets, part, rich, ("fy",))["fy"] <= 1.05


@pytest.mark.parametrize("which", [0, 2, 4])
def test_one_set_pressure_says_nothing_of_another(subsets, which):
    """With coefficients freed by a ripple of 3%, 6.1 left up to three times as much as 5.2 there.

    Over all sweeps at one pressure the ripple is worth more than ``SLACK``, and frees them.
    """
    table = subsets.calspan()
    inputs = ["slip_angle", "camber", "normal_load", "speed", "pressure", "fy"]
    own = table[~table["low"] & ~table["leaning"] & (table["sweep"] == which)]
    other = table.loc[table["low"] & ~table["leaning"], inputs].iloc[::20]
    fits = [fit_magic_formula(own[inputs].iloc[::20], version, starts=8) for version in ("5.2", "6.1")]
    left = []
    for fit in fits:
        there = subsets.problem_of(fit.model, "fy", other)
        left.append(there.misfit(np.array([fit.model.value(n) for n in there.names])))
    assert left[1] <= 1.1 * left[0]
    assert fits[1].relative_rms["fy"] <= 1.02 * fits[0].relative_rms["fy"]


@pytest.mark.parametrize("number", [16, 27, 32, 35])
def test_one_load_gives_a_cornering_stiffness_of_a_tire_around_it(subsets, number):
    part = subsets.subset(number)
    assert part.one_load
    found = subsets.stiffness(fit_magic_formula(kept(part, ("fy",))), part)
    assert 0.6 < found["stiffness_low"] <= found["stiffness_high"] < 1.5
