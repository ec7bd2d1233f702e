"""The batched Levenberg-Marquardt finds what SciPy finds, and each problem by itself."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from tire_pipeline.numerics.levenberg_marquardt import LeastSquares, Steps, solve


def _decay(x: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """a exp(-b x) + c, and its derivatives."""
    a, b, c = (p[:, k, None] for k in range(3))
    decay = np.exp(-b * x)
    return a * decay + c, np.stack([decay, -a * x * decay, np.ones_like(x)], axis=1)


def _problem(count: int = 7, points: int = 40, freeze: bool = False, lazy: bool = False) -> LeastSquares:
    rng = np.random.default_rng(11)
    x = np.sort(rng.uniform(0.0, 4.0, (count, points)), axis=1)
    truth = rng.uniform([1.0, 0.4, -0.5], [3.0, 2.0, 0.5], (count, 3))
    target = _decay(x, truth)[0] + rng.normal(0.0, 0.02, x.shape)
    lower, upper = np.tile([0.0, 0.1, -1.0], (count, 1)), np.tile([5.0, 1.0, 1.0], (count, 1))
    if freeze:
        lower[:, 2] = upper[:, 2] = 0.25
    weight = rng.uniform(0.5, 1.5, x.shape)

    def model(p: np.ndarray, rows: np.ndarray, slopes: bool):
        value, jacobian = _decay(x[rows], p)
        residual = (value - target[rows]) * weight[rows]
        return residual, None if lazy and not slopes else jacobian * weight[rows][:, None]

    return LeastSquares(
        model=model,
        start=np.tile([1.0, 0.5, 0.0], (count, 1)),
        lower=lower,
        upper=upper,
        prior=np.tile([1.0, 0.5, 0.0], (count, 1)),
        stiffness=np.full((count, 3), 0.01),
    )


@pytest.mark.parametrize("relative", [True, False])
def test_agrees_with_scipy_also_at_bounds(relative: bool) -> None:
    problem = _problem()
    ours, costs = solve(problem, Steps(most=200, tolerance=1e-14, relative=relative))
    at_bound = 0
    for i in range(len(ours)):

        def residual(p: np.ndarray, i: int = i) -> np.ndarray:
            fit, _ = problem.model(p[None], np.array([i]), False)
            return np.concatenate([fit[0], 0.1 * (p - problem.prior[i])])

        found = least_squares(
            residual,
            problem.start[i],
            bounds=(problem.lower[i], problem.upper[i]),
            xtol=1e-14,
            ftol=1e-14,
            gtol=1e-14,
        )
        theirs = found.x
        np.testing.assert_allclose(costs[i], 2.0 * found.cost, rtol=1e-7)
        np.testing.assert_allclose(ours[i], theirs, atol=2e-5)
        at_bound += bool(np.isclose(ours[i, 1], 1.0, atol=1e-9))
    assert at_bound > 0, "no problem meets a bound: the test would not try that"


@pytest.mark.parametrize("hold", [True, False])
def test_frozen_parameters_stay(hold: bool) -> None:
    fitted, _ = solve(_problem(freeze=True), Steps(hold=hold))
    assert np.array_equal(fitted[:, 2], np.full(len(fitted), 0.25))


def test_a_problem_does_not_depend_on_its_neighbours() -> None:
    problem = _problem()
    together, _ = solve(problem)
    for i in range(len(together)):
        rows = np.array([i])
        alone, _ = solve(
            LeastSquares(
                model=lambda p, _, slopes, rows=rows: problem.model(p, rows, slopes),
                **{
                    name: getattr(problem, name)[rows]
                    for name in ("start", "lower", "upper", "prior", "stiffness")
                },
            )
        )
        np.testing.assert_allclose(alone[0], together[i], rtol=1e-10)


def test_derivatives_on_demand_change_nothing() -> None:
    np.testing.assert_array_equal(solve(_problem(lazy=True))[0], solve(_problem())[0])


def test_the_result_is_the_best_point_that_was_tried() -> None:
    problem = _problem()
    best, costs = solve(problem, Steps(most=3))
    rows = np.arange(len(best))
    residual, _ = problem.model(best, rows, False)
    again = (residual**2).sum(axis=1) + (0.01 * (best - problem.prior) ** 2).sum(axis=1)
    np.testing.assert_allclose(costs, again, rtol=1e-12)
    residual, _ = problem.model(problem.start, rows, False)
    assert (costs < (residual**2).sum(axis=1)).all()
