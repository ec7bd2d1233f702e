"""Errors, ratios and shares, on cases worked out by hand."""

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tire_pipeline.errors import DomainError
from tire_pipeline.evaluation import (
    Curves,
    EvaluationGrid,
    curve_errors,
    curves_of,
    evaluate_translations,
    floor_evaluation,
)

SMALL = EvaluationGrid(
    slip_angles=np.linspace(-0.25, 0.25, 21),
    load_axis=np.array([3000.0, 6000.0]),
    slip_ratios=np.linspace(-0.2, 0.2, 9),
)
BASE = {
    "FNOMIN": 4000.0,
    "UNLOADED_RADIUS": 0.32,
    "PCY1": 1.4,
    "PDY1": 1.0,
    "PDY2": -0.1,
    "PEY1": -0.5,
    "PEY2": 0.0,
    "PKY1": -20.0,
    "PKY2": 1.8,
    "PHY1": 0.0,
    "PHY2": 0.0,
    "PVY1": 0.0,
    "PVY2": 0.0,
    "PCX1": 1.5,
    "PDX1": 1.05,
    "PEX1": 0.1,
    "PKX1": 21.0,
    "QBZ1": 9.0,
    "QCZ1": 1.15,
    "QDZ1": 0.11,
    "QEZ1": -1.0,
}


def _curves(*levels: float) -> Curves:
    return Curves(
        fy=np.array([np.full((3, 4), level) for level in levels]),
        cornering_stiffness=np.array([[10.0 * level, 10.0 * level] for level in levels]),
        peak_friction=np.array([[0.1 * level] for level in levels]),
    )


def _table(**changes: list[float]) -> pd.DataFrame:
    count = len(next(iter(changes.values())))
    table = pd.DataFrame([BASE] * count)
    return table.assign(**changes)


def test_summary_by_hand() -> None:
    """Untranslated errors 4, 4 (forces); translated 1, 9: ratio 10 / 8, one of two improved."""
    outcome = evaluate_translations(_curves(1.0, 3.0), _curves(2.0, -2.0), _curves(0.0, 0.0))
    row = outcome.summary.loc["forces"]
    assert row["ratio"] == pytest.approx(10.0 / 8.0)
    assert row["improved"] == 0.5
    assert row["worst"] == pytest.approx(9.0 / 4.0)
    assert row["files"] == 2
    slope = outcome.per_file["cornering_stiffness"]
    assert slope.tolist() == [100.0, 900.0]
    assert outcome.per_file["peak_friction_untranslated"].tolist() == pytest.approx([0.04, 0.04])
    assert outcome.per_file["forces_improved"].tolist() == [True, False]


def test_mean_row_is_over_the_thesis_metrics_only() -> None:
    untranslated = _table(PDY1=[1.1, 1.2])
    translated = _table(PDY1=[1.05, 1.1])
    outcome = evaluate_translations(translated, untranslated, _table(PDY1=[1.0, 1.0]), grid=SMALL)
    three = outcome.summary.loc[["forces", "cornering_stiffness", "peak_friction"]]
    assert outcome.summary.loc["mean", "ratio"] == pytest.approx(three["ratio"].mean())
    assert outcome.summary.loc["mean", "improved"] == pytest.approx(three["improved"].mean())
    assert set(outcome.summary.index) == {
        "forces",
        "cornering_stiffness",
        "peak_friction",
        "forces_camber",
        "fx",
        "mz",
        "mean",
    }


def test_nothing_done_is_ratio_one_and_nothing_improved() -> None:
    untranslated = _table(PDY1=[1.1, 0.9], PKY1=[-25.0, -18.0])
    reference = _table(PDY1=[1.0, 1.0])
    summary = evaluate_translations(untranslated, untranslated, reference, grid=SMALL).summary
    thesis = summary.loc[["forces", "cornering_stiffness", "peak_friction", "mean"]]
    assert (thesis["ratio"] == 1.0).all()
    assert (summary["improved"] == 0.0).all()


def test_perfect_translation_is_ratio_zero() -> None:
    reference = _table(PDY1=[1.0, 1.0])
    summary = evaluate_translations(
        reference, _table(PDY1=[1.1, 0.9], PKY1=[-25.0, -18.0]), reference, grid=SMALL
    ).summary
    assert (summary.loc[["forces", "cornering_stiffness", "peak_friction"], "ratio"] == 0.0).all()
    assert summary.loc["mean", "improved"] == 1.0


def test_zero_over_zero_and_harm_over_zero() -> None:
    same = _curves(1.0)
    assert evaluate_translations(same, same, same).summary.loc["forces", "ratio"] == 1.0
    harmed = evaluate_translations(_curves(2.0), same, same).summary.loc["forces", "ratio"]
    assert harmed == np.inf


def test_curves_of_a_known_tire() -> None:
    """Without shifts and with E = 0 the peak is D where C > 1: mu = PDY1 + PDY2 df; K is A.23."""
    table = _table(PEY1=[0.0], PCY1=[1.6], PKY1=[-30.0])
    curves = curves_of(table, SMALL)
    load = SMALL.load_axis
    df = (load - 4000.0) / 4000.0
    stiffness = 30.0 * 4000.0 * np.sin(2.0 * np.arctan(load / (1.8 * 4000.0)))
    np.testing.assert_allclose(curves.cornering_stiffness[0], stiffness, rtol=1e-12)
    fine = EvaluationGrid(slip_angles=np.linspace(-0.25, 0.25, 2001), load_axis=load)
    peak = curves_of(table, fine, lateral_only=True).peak_friction[0]
    np.testing.assert_allclose(peak, 1.0 - 0.1 * df, rtol=1e-5)
    assert curves.fy.shape == (1, 3, 21)
    assert curves.mz.shape == (1, 3, 3, 21)
    assert curves.fx.shape == (1, 3, 3, 9)
    assert curves.fy_camber.shape == (1, 2, 3, 21)


def test_camber_coefficients_count_in_the_camber_metrics_only() -> None:
    outcome = evaluate_translations(
        _table(PDY3=[0.0], QHZ3=[0.0]),
        _table(PDY3=[5.0], QHZ3=[0.1]),
        _table(PDY3=[0.0], QHZ3=[0.0]),
        grid=SMALL,
    ).per_file.iloc[0]
    assert outcome["forces_untranslated"] == 0.0
    assert outcome["peak_friction_untranslated"] == 0.0
    assert outcome["forces_camber_untranslated"] > 0.0
    assert outcome["mz_untranslated"] > 0.0
    assert outcome["fx_untranslated"] == 0.0


def test_longitudinal_coefficients_count_in_fx_only() -> None:
    row = evaluate_translations(
        _table(PDX1=[1.05]), _table(PDX1=[1.2]), _table(PDX1=[1.05]), grid=SMALL
    ).per_file.iloc[0]
    assert row["fx_untranslated"] > 0.0
    assert row["forces_untranslated"] == row["mz_untranslated"] == 0.0


def test_floor_goes_through_the_same_function() -> None:
    second, first = _table(PDY1=[1.01, 0.99]), _table(PDY1=[1.0, 1.0])
    source = _table(PDY1=[1.1, 0.9])
    ours = floor_evaluation(second, source, first, grid=SMALL).summary
    theirs = evaluate_translations(second, source, first, grid=SMALL).summary
    pd.testing.assert_frame_equal(ours, theirs)
    fine = EvaluationGrid(slip_angles=np.linspace(-0.25, 0.25, 2001), load_axis=SMALL.load_axis)
    exact = floor_evaluation(second, source, first, grid=fine, lateral_only=True).summary
    assert exact.loc["peak_friction", "ratio"] == pytest.approx(0.01**2 / 0.1**2, rel=1e-4)


def test_index_and_nominal_load_do_not_matter_beyond_names() -> None:
    """The same tire written with another F_z0 has the same curves (thesis, Appendix B)."""
    a = _table(PDY1=[1.0])
    ratio, shift = 5000.0 / 4000.0, 1000.0 / 4000.0
    b = a.assign(
        FNOMIN=5000.0,
        PDY1=a["PDY1"] + a["PDY2"] * shift,
        PDY2=a["PDY2"] * ratio,
        PKY1=a["PKY1"] / ratio,
        PKY2=a["PKY2"] / ratio,
    )
    errors = curve_errors(curves_of(a, SMALL, lateral_only=True), curves_of(b, SMALL, lateral_only=True))
    assert (errors.to_numpy() < 1e-12).all()
    named = a.set_axis(["B/T1.tir"])
    outcome = evaluate_translations(named, named, a, grid=SMALL, lateral_only=True)
    assert outcome.per_file.index.tolist() == ["B/T1.tir"]


def test_wrong_input_is_named() -> None:
    good = _table(PDY1=[1.0, 1.0])
    with pytest.raises(DomainError, match="shape"):
        evaluate_translations(good, good, _table(PDY1=[1.0]), grid=SMALL)
    with pytest.raises(DomainError, match="has no column PEY2"):
        curves_of(good.drop(columns="PEY2"), SMALL)
    holed = good.assign(file=["A/1.tir", "A/2.tir"])
    holed.loc[1, "PKY2"] = np.nan
    with pytest.raises(DomainError, match=r"A/2\.tir has no value for PKY2"):
        curves_of(holed, SMALL)
    with pytest.raises(DomainError, match="no tire"):
        curves_of(good.iloc[:0], SMALL)


levels = st.lists(st.floats(-50.0, 50.0), min_size=3, max_size=3)


@settings(max_examples=60, deadline=None)
@given(after=levels, before=levels, target=levels, scale=st.floats(0.1, 10.0))
def test_ratio_and_share_do_not_depend_on_units_or_order(after, before, target, scale) -> None:
    def summary(order: list[int], factor: float) -> pd.DataFrame:
        parts = [_curves(*(factor * np.array(part)[order])) for part in (after, before, target)]
        return evaluate_translations(*parts).summary.loc[["forces", "cornering_stiffness"]]

    if min(abs(b - t) for b, t in zip(before, target, strict=True)) < 1e-3:
        return
    plain = summary([0, 1, 2], 1.0)
    pd.testing.assert_frame_equal(plain, summary([2, 0, 1], 1.0), rtol=1e-9)
    scaled = summary([0, 1, 2], 4.0 if scale > 1.0 else 0.25)  # exact in binary
    pd.testing.assert_frame_equal(plain, scaled, rtol=1e-9)
    assert ((plain["improved"] >= 0) & (plain["improved"] <= 1)).all()
    assert (plain["worst"] >= plain["ratio"] * (1 - 1e-12)).all()
