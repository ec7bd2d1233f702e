"""How often the answers are right over several draws, with intervals: names, sizes, axes and equations."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from draw_rates import DRAWS, EXPECTED, check_most
from real_at_rates import points
from recorded_sizes import NOISY, sizes
from small_rig import ANOTHER
from turned_axes import TURNED, cambered, leaning, misread
from unnamed_problem import by_memory, by_speed, jolt, nothing, problem, swinging
from weighed import all_but, named, named_sets
from worthless_slip import AXLE, RUINS, free_drive, without_slip

from tire_pipeline.concealed.scoring.rows import share_row
from tire_pipeline.magic_formula import fit_magic_formula
from tire_pipeline.mismatch import Explainer, explain_mismatch
from tire_pipeline.mismatch.discrepancy.gaussian_form import gaussian_form
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.analysis import analyse
from tire_pipeline.mismatch.inference.learnt.sizes import learnt
from tire_pipeline.mismatch.inference.sets.answer import answered
from tire_pipeline.mismatch.inference.sets.enumerate import enumerate_sets
from tire_pipeline.mismatch.model.blocks import sweeps
from tire_pipeline.mismatch.proof.trial import put_in
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.unnamed_physics.search import find


def nothing_missing_is_agreement(tire, record, seed):
    answer = Explainer().weigh(tire, record(seed)).answer
    return answer.sets == () and answer.agreement > 0.5


def a_missing_friction_is_among_the_names_and_as_large_as_it_is(tire, record, seed):
    analysis = analyse(prepare(tire, record(seed, friction=0.88)).data)
    case = enumerate_sets(analysis, learnt(), [("friction_scale",)]).case
    answer = answered(case, learnt())
    changes = next(each.changes for each in case.sets if each.names == ("friction_scale",))
    return (
        len(answer.sets) == 1
        and "friction_scale" in answer.sets[0][0]
        and answer.sets[0][1] > 0.5
        and answer.agreement < 0.05
        and abs(changes[0][1]["friction"] + 0.12) < 0.01
    )


def no_physics_is_named_while_axes_are_open(tire, record, seed):
    """Others in each draw are turned, and the force is too large by 7% in every second."""
    turned = TURNED[seed % len(TURNED)]
    wrong = misread(cambered(tire, seed), turned, (1.07, 1.0)[seed % 2])
    names = named(leaning(tire), wrong)
    return "sign_convention" in names and not [n for n in names if catalogue()[n].kind == "physics"]


def another_tire_on_the_rig_asks_for_the_file(tire, record, seed):
    report = explain_mismatch(tire.replace(**ANOTHER), record(seed))
    return report.verdict == "another tire" and report.effects == []


def speed_is_the_driver_and_its_square_the_form(tire, record, seed):
    found = find(problem(by_speed, seed))
    if found.physics is None:
        return False
    before, after, _ = found.unseen["fy"]
    value, error = found.coefficients[0]
    return (
        found.physics.depends_on == ("speed",)
        and "v^2" in found.physics.equations["fy"]
        and "fx" not in found.physics.equations
        and after < 0.3 * before
        and abs(value + 0.05) < 4.0 * error + 0.002
    )


def a_memory_is_the_driver(tire, record, seed):
    found = find(problem(by_memory, seed)).physics
    return found is not None and found.depends_on == ("memory of slip_angle",)


def noise_alone_gives_no_equation(tire, record, seed):
    found = find(problem(nothing, seed))
    return found.physics is None and bool(found.why_not)


def what_is_never_seen_twice_is_not_kept(tire, record, seed):
    """A jolt in one sweep is a driver of nothing: it must not come into the model."""
    return find(problem(jolt, seed)).physics is None


def noise_alone_is_predicted_by_no_form(tire, record, seed):
    data = prepare(tire, record(seed)).data
    rest = np.random.default_rng(seed).normal(0.0, 50.0, data.size)
    return abs(gaussian_form(data, rest, "fy", sweeps(data), 50.0).explained) < 0.05


def what_swings_with_a_drum_has_its_way_in_the_equation(tire, record, seed):
    recording = swinging(record(seed), 0.08)
    report = explain_mismatch(tire, recording)
    physics = report.unnamed.physics
    return (
        report.effects == []
        and report.verdict == "unexplained"
        and physics is not None
        and physics.depends_on == ("path",)
        and report.fit["fy"].rms_after < report.fit["fy"].rms_before
    )


RIGHT = (
    nothing_missing_is_agreement,
    a_missing_friction_is_among_the_names_and_as_large_as_it_is,
    no_physics_is_named_while_axes_are_open,
    another_tire_on_the_rig_asks_for_the_file,
    speed_is_the_driver_and_its_square_the_form,
    a_memory_is_the_driver,
    noise_alone_gives_no_equation,
    what_is_never_seen_twice_is_not_kept,
    noise_alone_is_predicted_by_no_form,
    what_swings_with_a_drum_has_its_way_in_the_equation,
)


@pytest.mark.long
@pytest.mark.parametrize("right", RIGHT, ids=lambda right: right.__name__)
def test_most_draws_are_answered_rightly(tire, record, right):
    check_most(lambda seed: right(tire, record, seed), right.__name__)


@pytest.fixture(scope="module")
def calm_and_noisy(tire, record):
    """What is seen in each draw with little noise and with four times as much, beside what looks like it."""
    without = all_but(*NOISY, "low_pass", "relaxation_length", "nonuniformity")
    return [[sizes(tire, record(seed, noise=n), without)[1] for n in (20.0, 80.0)] for seed in DRAWS]


@pytest.mark.long
@pytest.mark.parametrize("key", NOISY.items(), ids=" ".join)
def test_more_noise_hides_more(calm_and_noisy, key):
    def right(seed):
        calm, noisy = (found[key].seen for found in calm_and_noisy[seed])
        return calm < noisy

    check_most(right, key[0])


def _named_at_its_size(tire, recording, seed):
    """(effect, parameter) -> function that says if it is named, put in at the size that is seen."""
    analysis, found = sizes(tire, recording)
    rng = np.random.default_rng(seed)

    def is_named(key):
        sight = found[key]
        sign = 1.0 if sight.parameter.one_sided else rng.choice([-1.0, 1.0])
        there = put_in(tire, recording, key[0], sight.values(analysis.data, sign * sight.seen))
        return any(key[0] in names for names in named_sets(tire, there))

    return {key: partial(is_named, key) for key, sight in found.items() if np.isfinite(sight.seen)}


def _check_named(told: dict[tuple[str, str], bool], least: int):
    row = share_row("named", list(told.values()))
    wrong = [key for key, right in told.items() if not right]
    print(f"{row['value']:.2f} ({row['low']:.2f} to {row['high']:.2f}) of {row['n']}; not named: {wrong}")
    assert len(told) >= least
    assert row["high"] >= EXPECTED


@pytest.mark.long
def test_what_is_said_to_be_seen_is_named(tire, record):
    """Each parameter in another draw."""
    drawn = [_named_at_its_size(tire, record(seed), seed) for seed in DRAWS]
    keys = sorted(set().union(*drawn))
    asked = {key: [each[key] for each in drawn if key in each] for key in keys}
    _check_named({key: asked[key][number % len(asked[key])]() for number, key in enumerate(keys)}, 15)


@pytest.mark.long
def test_what_is_said_to_be_seen_in_real_points_is_named():
    """The TYDEX points without camber, and a fit to them; rates: ``benchmarks/visible_sizes.py``."""
    tire, table, _ = points()
    flat = table[table["camber"].abs() < 0.002].reset_index(drop=True)
    _check_named({key: asked() for key, asked in _named_at_its_size(tire, flat, 0).items()}, 10)


@pytest.mark.long
@pytest.mark.parametrize(("how", "size"), RUINS)
def test_a_drive_whose_slip_is_worth_nothing_is_unusable_for_a_model_that_was_fitted_to_it(how, size):
    def right(seed):
        drive = without_slip(free_drive(), how, size, seed)
        return prepare(fit_magic_formula(drive[AXLE]).model, drive).stopped == "unusable"

    check_most(right, how)
