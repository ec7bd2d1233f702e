"""The forces of many tires at once."""

import numpy as np
import pandas as pd
import pytest
from one_tire import SCALES, TIRE

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.translation.curves import pure_slip


@pytest.mark.parametrize("scales", [{}, SCALES])
@pytest.mark.parametrize("camber", [0.0, -0.06, 0.05])
def test_forces_of_many_tires_are_those_of_the_engine(scales, camber):
    slips, loads = np.linspace(-0.25, 0.25, 11), np.array([2500.0, 6000.0, 8000.0])
    points = pure_slip.Points.grid(slips, loads, [camber])
    p = pure_slip.columns(pd.DataFrame([{**TIRE, **scales}]))
    model = TireModel.from_coefficients({**TIRE, **scales}, version="5.2")
    load, tilt = points.normal_load, np.full(slips.size * loads.size, camber)
    side = model.forces(normal_load=load, slip_angle=points.slip, camber=tilt, limits="ignore")
    along = model.forces(normal_load=load, slip_ratio=points.slip, camber=tilt, limits="ignore")
    for ours, theirs in (
        (pure_slip.lateral_force(p, points), side.fy),
        (pure_slip.aligning_torque(p, points), side.mz),
        (pure_slip.longitudinal_force(p, points), along.fx),
    ):
        np.testing.assert_allclose(ours[0], theirs, rtol=1e-9, atol=1e-9 * np.abs(theirs).max())
