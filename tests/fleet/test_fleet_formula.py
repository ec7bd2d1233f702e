"""The fit's own Magic Formula agrees with the engine's, and its derivatives with differences."""

import numpy as np
import pytest

from tire_pipeline.fleet.manufacturer_fits import formula
from tire_pipeline.fleet.manufacturer_fits.habits import HABITS, fit_setup
from tire_pipeline.magic_formula import TireModel

PARTS = {
    "lateral": formula.FITTED_LATERAL,
    "longitudinal": formula.FITTED_LONGITUDINAL,
    "aligning": formula.FITTED_ALIGNING,
}


def _draw(names: list[str], count: int, rng: np.random.Generator) -> np.ndarray:
    setup = fit_setup(list(names), HABITS["A"], rng.random(count))
    drawn = setup.start + 0.3 * rng.normal(size=setup.start.shape) / np.sqrt(setup.stiffness)
    return np.clip(drawn, setup.lower, setup.upper)


def _case(count: int = 5, points: int = 60):
    rng = np.random.default_rng(3)
    where = formula.FitPoints(
        slip=rng.uniform(-0.24, 0.24, (count, points)),
        camber=rng.uniform(-0.09, 0.09, (count, points)),
        normal_load=rng.uniform(1500.0, 9000.0, (count, points)),
        nominal_load=rng.uniform(3500.0, 6500.0, (count, 1)),
        radius=rng.uniform(0.3, 0.37, (count, 1)),
    )
    drawn = {name: _draw(names, count, rng) for name, names in PARTS.items()}
    return where, drawn


def _evaluate(name: str, parameters: np.ndarray, where: formula.FitPoints, lateral: np.ndarray):
    if name == "aligning":
        return formula.aligning(parameters, where, lateral)
    return getattr(formula, name)(parameters, where)


@pytest.mark.parametrize("name", PARTS)
def test_values_are_those_of_the_engine(name: str) -> None:
    where, drawn = _case()
    ours, _ = _evaluate(name, drawn[name], where, drawn["lateral"])
    for i in range(len(ours)):
        coefficients = {"FNOMIN": where.nominal_load[i, 0], "UNLOADED_RADIUS": where.radius[i, 0]}
        for part, names in PARTS.items():
            coefficients.update(zip(names, drawn[part][i], strict=True))
        coefficients.update(LONGVL=16.7)
        if name == "aligning":  # the engine adds the lever of Fx; without Fx there is none
            coefficients.update(dict.fromkeys(formula.FITTED_LONGITUDINAL[-4:], 0.0))
        tire = TireModel.from_coefficients(coefficients, version="5.2")
        slip = "slip_ratio" if name == "longitudinal" else "slip_angle"
        forces = tire.forces(
            normal_load=where.normal_load[i],
            camber=where.camber[i],
            limits="ignore",
            **{slip: where.slip[i]},
        )
        theirs = {"lateral": forces.fy, "longitudinal": forces.fx, "aligning": forces.mz}[name]
        np.testing.assert_allclose(ours[i], theirs, rtol=0, atol=1e-9 * np.abs(theirs).max())


@pytest.mark.parametrize("name", PARTS)
def test_derivatives_are_those_of_differences(name: str) -> None:
    where, drawn = _case()
    parameters = drawn[name]
    _, jacobian = _evaluate(name, parameters, where, drawn["lateral"])
    for k, coefficient in enumerate(PARTS[name]):
        step = 1e-6 * max(1e-2, np.abs(parameters[:, k]).max())
        up, down = parameters.copy(), parameters.copy()
        up[:, k] += step
        down[:, k] -= step
        high = _evaluate(name, up, where, drawn["lateral"])[0]
        low = _evaluate(name, down, where, drawn["lateral"])[0]
        numeric = (high - low) / (2.0 * step)
        scale = np.abs(numeric).max()
        assert scale > 0, coefficient
        assert np.abs(numeric - jacobian[:, k]).max() < 2e-5 * scale, coefficient
