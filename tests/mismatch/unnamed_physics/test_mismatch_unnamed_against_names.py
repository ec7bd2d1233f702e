"""What an equation has to beat: the named effects, on unseen sweeps and in their own likelihood."""

from dataclasses import replace

import numpy as np
import pytest
from weighed import all_but

from tire_pipeline.mismatch import Explainer
from tire_pipeline.mismatch.inference.analysis import with_fit
from tire_pipeline.mismatch.inference.evidence.hypotheses import plain_evidence
from tire_pipeline.mismatch.inference.linearised_set import Fit
from tire_pipeline.mismatch.unnamed_physics.against_names import Acting, NamesToBeat
from tire_pipeline.mismatch.unnamed_physics.choose import choose
from tire_pipeline.mismatch.unnamed_physics.problems.forces_residual import problem_of
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import by_condition
from tire_pipeline.mismatch.unnamed_physics.products import Columns

FEW = all_but("friction_scale", "stiffness_scale", "force_offset")


@pytest.fixture(scope="module")
def softer(tire, record):
    """A recording with 12% less friction, weighed."""
    return Explainer(without=FEW).weigh(tire, record(friction=0.88))


@pytest.fixture(scope="module")
def equation(softer):
    """The equation alone that is chosen for it."""
    columns = Columns(by_condition(problem_of(with_fit(softer.analysis, Fit([], [])))))
    choice = choose(columns)
    model = choice.best()
    return Acting(columns, [choice.terms[i] for i in model.terms], columns.problem.outputs, model)


def test_columns_that_do_nothing_are_as_likely_as_no_effect(softer):
    nothing = {o: np.zeros((softer.analysis.data.size, 2)) for o in softer.analysis.data.outputs}
    empty = next(each for each in softer.sets.sets if not each.names)
    found = softer.sets.log_evidence_of(nothing, 0.05)
    assert found == pytest.approx(plain_evidence(softer.sets.likelihood, empty), rel=1e-9)


def test_a_term_of_an_equation_has_the_size_of_the_largest_force(equation):
    problem = equation.columns.problem
    forces = equation.forces(problem.outputs)
    sizes = [np.sqrt(np.mean(x**2, axis=0)) / problem.largest[o] for o, x in forces.items()]
    assert np.max(sizes, axis=0) == pytest.approx(np.ones(len(equation.terms)))


def test_an_equation_is_no_likelier_than_the_true_name_whose_form_it_resembles(softer, equation):
    assert softer.answer.names == ("friction_scale",)
    assert not NamesToBeat({}, softer.sets, softer.answer).less_likely_than([equation])


def test_an_equation_is_likelier_than_names_of_less_evidence_by_its_price(softer, equation):
    """The names' weight at which it turns is the equation's evidence without what its terms cost."""
    evidence = softer.sets.log_evidence_of(equation.forces(softer.analysis.data.outputs), 0.05)
    for away, likelier in ((-0.01, True), (0.01, False)):
        answer = replace(softer.answer, log_weight=evidence - equation.price + away)
        assert NamesToBeat({}, softer.sets, answer).less_likely_than([equation]) is likelier


def test_the_weight_of_the_names_is_their_share_of_the_posterior(softer):
    """Evidence times odds of all that hold names, over that of the likeliest set without one."""
    answer, empty = softer.answer, next(each for each in softer.sets.sets if not each.names)
    with_names = sum(p for names, p in answer.probabilities.items() if names)
    alone = plain_evidence(softer.sets.likelihood, empty)
    assert answer.log_weight - alone == pytest.approx(np.log(with_names / answer.alone[()]), rel=1e-6)
