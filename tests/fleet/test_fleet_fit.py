"""The batched Levenberg-Marquardt finds what scipy finds, and each problem by itself."""

import numpy as np
from scipy.optimize import least_squares

from tire_pipeline.fleet.fits.levenberg import Problem, solve


def _model(x: np.ndarray):
    def model(p: np.ndarray, rows: np.ndarray):
        a, b, c = (p[:, k, None] for k in range(3))
        here = x[rows]
        decay = np.exp(-b * here)
        jacobian = np.stack([decay, -a * here * decay, np.ones_like(here)], axis=1)
        return a * decay + c, jacobian

    return model


def _problem(count: int = 7, points: int = 40, freeze: bool = False) -> Problem:
    rng = np.random.default_rng(11)
    x = np.sort(rng.uniform(0.0, 4.0, (count, points)), axis=1)
    truth = rng.uniform([1.0, 0.4, -0.5], [3.0, 2.0, 0.5], (count, 3))
    model = _model(x)
    target = model(truth, np.arange(count))[0] + rng.normal(0.0, 0.02, x.shape)
    lower, upper = np.tile([0.0, 0.1, -1.0], (count, 1)), np.tile([5.0, 1.0, 1.0], (count, 1))
    if freeze:
        lower[:, 2] = upper[:, 2] = 0.25
    return Problem(
        model=model,
        target=target,
        weight=rng.uniform(0.5, 1.5, x.shape),
        start=np.tile([1.0, 0.5, 0.0], (count, 1)),
        lower=lower,
        upper=upper,
        prior=np.tile([1.0, 0.5, 0.0], (count, 1)),
        stiffness=np.full((count, 3), 0.01),
    )


def test_agrees_with_scipy_also_at_bounds() -> None:
    problem = _problem()
    ours = solve(problem, iterations=200, tolerance=1e-14)
    at_bound = 0
    for i in range(len(ours)):

        def residual(p: np.ndarray, i: int = i) -> np.ndarray:
            value, _ = problem.model(p[None], np.array([i]))
            fit = (value[0] - problem.target[i]) * problem.weight[i]
            return np.concatenate([fit, 0.1 * (p - problem.prior[i])])

        theirs = least_squares(
            residual,
            problem.start[i],
            bounds=(problem.lower[i], problem.upper[i]),
            xtol=1e-14,
            ftol=1e-14,
            gtol=1e-14,
        ).x
        np.testing.assert_allclose(ours[i], theirs, atol=2e-5)
        at_bound += bool(np.isclose(ours[i, 1], 1.0, atol=1e-9))
    assert at_bound > 0, "no problem meets a bound: the test would not try that"


def test_frozen_parameters_stay() -> None:
    fitted = solve(_problem(freeze=True))
    assert np.array_equal(fitted[:, 2], np.full(len(fitted), 0.25))


def test_a_problem_does_not_depend_on_its_neighbours() -> None:
    problem = _problem()
    together = solve(problem)
    for i in range(len(together)):
        rows = np.array([i])
        alone = solve(
            Problem(
                model=lambda p, _, rows=rows: problem.model(p, rows),
                **{
                    name: getattr(problem, name)[rows]
                    for name in ("target", "weight", "start", "lower", "upper", "prior", "stiffness")
                },
            )
        )
        np.testing.assert_allclose(alone[0], together[i], rtol=1e-10)
