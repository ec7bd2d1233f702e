"""Errors after are of sweeps that neither the choice of effects nor their fit has seen."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from weighed import all_but

from tire_pipeline.mismatch import Explainer, explain_mismatch
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.sets.answer import LEVEL
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.measured import OutputFit
from tire_pipeline.mismatch.proof.nested import FOLDS, ByFold, RepeatedChoice
from tire_pipeline.recordings import read_recording
from tire_pipeline.tir import read_tir

ROOT = Path(__file__).resolve().parents[3]


def rms(x):
    return float(np.sqrt(np.mean(x["fy"] ** 2)))


@pytest.fixture(scope="module")
def softer(tire, record):
    few = all_but("friction_scale", "force_offset", "stiffness_scale")
    return Explainer(without=few).weigh(tire, record(3, friction=0.7))


def test_a_fit_that_ended_off_its_optimum_is_not_said_to_be_there(softer):
    """A real drive was said to fall from 1.1 N to 0.12 N, where the corrected model left 0.81 N."""
    (best,) = (each for each in softer.sets.sets if each.names == ("friction_scale",))
    ((name, values),) = best.changes
    elsewhere = [(name, {key: 0.5 * (1.0 + value) for key, value in values.items()})]
    off = softer.sets.products.of_set(elsewhere, best.free)
    by_fold = ByFold(softer.sets, off, softer.analysis.block % FOLDS)
    there = rms(residual(softer.analysis.data, elsewhere))
    assert there > 1.5 * rms(residual(softer.analysis.data, best.changes))
    assert rms(by_fold.predicted(softer.sets.likelihood, off)) == pytest.approx(there)


def test_what_is_withheld_predicts_nothing(softer):
    found = RepeatedChoice(softer.sets, softer.analysis.block, LEVEL).unseen(set(catalogue()))
    assert found.chosen == ((),) * FOLDS
    assert rms(found.left) == rms(residual(softer.analysis.data, []))


def test_one_sweep_proves_nothing(softer):
    found = RepeatedChoice(softer.sets, np.zeros(softer.analysis.data.size, int), LEVEL).unseen()
    assert found.chosen == ()
    assert rms(found.left) == rms(residual(softer.analysis.data, []))


def test_an_error_that_no_likely_cause_explains_is_undecided():
    """The pressure of the example's run varies; without its column no cause is likelier than none."""
    run = read_recording(ROOT / "examples" / "rig_run.csv", axes="ISO")
    four = run[["time", "slip_angle", "normal_load", "fy"]]
    tire = read_tir(ROOT / "examples" / "tire.tir")
    report = explain_mismatch(tire, four)
    simulated = tire.forces(slip_angle=four["slip_angle"], normal_load=four["normal_load"]).fy
    largest = np.quantile(np.abs(simulated), 0.995)
    stated, recorded = report.remainder.unusual["fy"], report.fit["fy"].rms_before / largest
    assert f"{stated:.1%}" == f"{recorded:.1%}", "of the rows that were weighed, and of those recorded"
    assert (report.verdict, report.effects, report.remainder.significant) == ("undecided", [], False)
    assert report.to_dict()["verdict"] == "undecided"
    assert "I can't tell" in report.summary
    assert "Explain a recording with more channels" in report.next_experiment
    assert report.located


@pytest.mark.parametrize(
    ("floor", "after", "share"),
    [(6.0, 6.0, 1.0), (6.0, 10.0, 0.0), (6.0, 68.0**0.5, 0.5), (6.0, 100.0, -1.0), (9.9, 9.9, math.nan)],
)
def test_what_is_recovered_counts_squares_above_the_noise_floor(floor, after, share):
    fit = OutputFit(floor, rms_before=10.0, rms_after=after, rms_after_low=after, rms_after_high=after)
    assert fit.recovered == pytest.approx(share, nan_ok=True)
    halved = replace(fit, noise_floor=0.0, rms_after=5.0)
    assert halved.recovered == pytest.approx(0.75)
