"""Figures of tires and fits: axes with units, a caption, lines where the model has forces; short reprs."""

from __future__ import annotations

import dataclasses

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import TireModel, fit_magic_formula
from tire_pipeline.magic_formula.key_figures import key_figures, usual_loads

COEFFICIENTS = {
    "FNOMIN": 4000.0,
    "UNLOADED_RADIUS": 0.32,
    "PCY1": 1.3,
    "PDY1": 1.0,
    "PKY1": -20.0,
    "PKY2": 2.0,
    "PCX1": 1.6,
    "PDX1": 1.1,
    "PKX1": 22.0,
}


@pytest.fixture(scope="module")
def tire() -> TireModel:
    return TireModel.from_coefficients(COEFFICIENTS)


@pytest.fixture(scope="module")
def fitted(tire):
    angle, load = (x.ravel() for x in np.meshgrid(np.linspace(-0.2, 0.2, 60), [2000.0, 4000.0, 6000.0]))
    noise = 20.0 * np.random.default_rng(0).standard_normal(angle.size)
    force = tire.forces(slip_angle=angle, normal_load=load).fy + noise
    return fit_magic_formula(pd.DataFrame({"slip_angle": angle, "normal_load": load, "fy": force}))


def labels(figure) -> list[str]:
    return [text for axis in figure.axes for text in (axis.get_xlabel(), axis.get_ylabel())]


def test_a_tire_is_drawn_with_units_and_a_caption(tire):
    figure = tire.plot(loads=[1000.0, 5000.0])
    assert set(labels(figure)) == {
        "slip angle (deg)",
        "slip ratio",
        "normal load Fz (kN)",
        "lateral force Fy (kN)",
        "longitudinal force Fx (kN)",
        "aligning moment Mz (N m)",
        "cornering stiffness (N/deg)",
    }
    assert "Pure slip, camber 0 deg" in figure.get_supxlabel()
    drawn = figure.axes[0].lines[1]
    there = tire.forces(slip_angle=np.radians(drawn.get_xdata()), normal_load=5000.0).fy
    assert drawn.get_ydata() * 1e3 == pytest.approx(there)
    assert [text.get_text() for text in figure.axes[0].get_legend().get_texts()] == ["1,000 N", "5,000 N"]


def test_a_force_that_the_file_has_not_is_said_to_be_absent():
    lateral = {k: v for k, v in COEFFICIENTS.items() if "X" not in k}
    figure = TireModel.from_coefficients(lateral).plot()
    assert [text.get_text() for text in figure.axes[1].texts] == ["the file does not give it"]
    values = {f.name: f.value for f in key_figures(TireModel.from_coefficients(lateral))}
    assert np.isnan(values["largest longitudinal friction"])


def test_camber_stiffness_and_trail_are_those_of_the_forces():
    leaning = TireModel.from_coefficients(
        {"FNOMIN": 4000.0, "UNLOADED_RADIUS": 0.3, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20.0, "PKY2": 2.0}
        | {"PHY3": 0.05, "QBZ1": 9.0, "QCZ1": 1.1, "QDZ1": 0.1}
    )
    values = {f.name: f.value for f in key_figures(leaning)}
    each_way = np.radians([0.2, -0.2])
    fy = leaning.forces(camber=each_way, normal_load=4000.0).fy
    assert values["camber stiffness"] == pytest.approx(-(fy[0] - fy[1]) / 0.4, rel=1e-2)
    assert values["camber stiffness"] > 0.0
    turned = leaning.forces(slip_angle=[1e-4, -1e-4], normal_load=4000.0)
    trail = -(turned.mz[0] - turned.mz[1]) / (turned.fy[0] - turned.fy[1])
    assert values["pneumatic trail"] == pytest.approx(trail, rel=1e-3)
    bare = TireModel.from_coefficients(
        {"FNOMIN": 4000.0, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20.0, "PKY2": 2.0}
    )
    assert all(
        np.isnan(f.value) for f in key_figures(bare) if f.name in ("camber stiffness", "pneumatic trail")
    )


def test_key_figures_are_those_of_the_forces(tire):
    values = {f.name: f.value for f in key_figures(tire)}
    small = tire.forces(slip_angle=1e-6, normal_load=4000.0).fy
    assert values["cornering stiffness"] == pytest.approx(abs(small) / 1e-6 * np.pi / 180.0, rel=1e-4)
    assert values["largest lateral friction"] == pytest.approx(1.0, abs=1e-3)


def test_loads_stay_inside_of_the_files_ranges(tire):
    assert usual_loads([tire]) == [2000.0, 4000.0, 6000.0]
    assert usual_loads([tire, tire.replace(FZMIN=2500.0, FZMAX=4500.0)]) == [2500.0, 3500.0, 4500.0]


def test_a_fit_is_drawn_over_what_was_measured(fitted):
    figure = fitted.plot()
    assert labels(figure)[:2] == ["slip angle (deg)", "Fy (N)"]
    assert "Points: measured" in figure.get_supxlabel()
    left, right = figure.axes
    assert sum(len(line.get_xdata()) for line in left.lines[::2]) == len(fitted.measured)
    largest = max(np.abs(line.get_ydata()).max() for line in right.lines)
    assert largest < 100.0
    with pytest.raises(DomainError, match="no points at pure slip"):
        dataclasses.replace(fitted, measured=None).plot()


def test_reprs_are_short_and_notebooks_get_a_table(tire, fitted):
    assert repr(tire) == "TireModel(version '5.2', FNOMIN = 4000 N, 9 coefficients, 115 missing)"
    assert "cornering stiffness" in tire._repr_html_()
    assert len(repr(fitted)) < 300
    assert "<td>PKY1</td>" in fitted._repr_html_()
    hostile = dataclasses.replace(tire, path="<script>.tir")
    assert "<script>" not in hostile._repr_html_()
