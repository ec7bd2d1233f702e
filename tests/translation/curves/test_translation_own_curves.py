"""Curves of a file as it is."""

from __future__ import annotations

import warnings
from types import SimpleNamespace

import numpy as np

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.translation.curves.of_files import file_curves

LEFT_ALONE = SimpleNamespace(bands={}, stiffness=None, normal_load=None)


def test_a_file_without_radius_has_its_forces_and_no_second_warning():
    tire = TireModel.from_coefficients(
        {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2, "QDZ1": 0.1}
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        curves = file_curves(["a.tir"], {"a.tir": tire}, LEFT_ALONE)
    assert np.isfinite(curves["fy_source"]).all()
    assert np.isnan(curves["mz_source"]).any()


def test_a_curve_that_would_rest_on_a_value_the_file_does_not_state_is_not_drawn():
    """A refused file without PKY2 had a cornering stiffness all the same."""
    tire = TireModel.from_coefficients(
        {"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20}
        | {"PCX1": 1.6, "PDX1": 1.1, "PKX1": 22.0}
    )
    curves = file_curves(["a.tir"], {"a.tir": tire}, LEFT_ALONE)
    for name in ("fy", "mz", "stiffness"):
        assert np.isnan(curves[f"{name}_source"]).all(), name
    assert np.isfinite(curves["fx_source"]).all()
