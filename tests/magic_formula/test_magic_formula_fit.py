"""Fitting: a real tire, and made-up ones whose truth is known."""

import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from magic_formula_tires import tire_52, tire_61

from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import FitResult, fit_magic_formula
from tire_pipeline.magic_formula.fitting.setup import typical
from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS
from tire_pipeline.mismatch.effects.shared import relaxation_lengths
from tire_pipeline.tir import read_tir, write_tir

pytestmark = pytest.mark.slow

TYDEX = Path(__file__).resolve().parents[2].parent / "shared" / "recordings" / "tydex"
INPUTS = ("slip_angle", "slip_ratio", "camber", "normal_load", "speed", "pressure")
FORCES = ("fx", "fy", "mx", "my", "mz")


def rig(tire: TireModel, count=4000, noise=0.004, outliers=0.0, seed=0) -> pd.DataFrame:
    """Sweeps at four loads, three cambers, pure and combined."""
    rng = np.random.default_rng(seed)
    kind = rng.integers(0, 3, count)
    nominal = 220_000.0
    table = pd.DataFrame(
        {
            "slip_angle": rng.uniform(-0.25, 0.25, count) * (kind != 1),
            "slip_ratio": rng.uniform(-0.3, 0.3, count) * (kind != 0),
            "camber": rng.choice([-0.07, 0.0, 0.07], count),
            "normal_load": rng.choice([0.4, 0.8, 1.2, 1.6], count) * tire.value("FNOMIN"),
            "speed": rng.choice([10.0, 20.0, 30.0], count),
            "pressure": rng.choice([0.8, 1.0, 1.2], count) * nominal,
        }
    )
    forces = tire.forces(**{name: table[name].to_numpy() for name in INPUTS}, limits="ignore")
    for name in FORCES:
        value = getattr(forces, name)
        largest = np.abs(value).max()
        value = value + rng.normal(0, noise * largest, count)
        wrong = rng.random(count) < outliers
        table[name] = np.where(wrong, value + rng.normal(0, 0.5 * largest, count), value)
    return table


def misfit(fit: FitResult, tire: TireModel, name: str) -> float:
    """RMS of fitted minus true force over the largest true one, at points that the fit has not seen."""
    points = rig(tire, noise=0.0, seed=99)
    found = fit.forces(**{n: points[n].to_numpy() for n in INPUTS}, limits="ignore")
    return float(np.sqrt(np.mean((getattr(found, name) - points[name]) ** 2)) / np.abs(points[name]).max())


@pytest.fixture(scope="module")
def tydex() -> pd.DataFrame:
    files = sorted(TYDEX.glob("*.tdx"))
    if not files and not os.environ.get("CI"):
        pytest.skip(f"no TYDEX recording in {TYDEX}")
    from tire_pipeline.recordings import read_recording

    return read_recording(files[0])


@pytest.mark.parametrize("version", ["5.2", "6.1"])
def test_a_real_tire_fits_within_one_and_a_half_percent(tydex, version):
    fit = fit_magic_formula(tydex, version)
    assert fit.model.version == version
    assert fit.relative_rms["fy"] < 0.015
    residual = (
        fit.forces(
            slip_angle=tydex["slip_angle"],
            camber=tydex["camber"],
            normal_load=tydex["normal_load"],
            limits="ignore",
        ).fy
        - tydex["fy"]
    )
    assert np.sqrt(np.mean(residual**2)) / np.abs(tydex["fy"]).max() == pytest.approx(fit.relative_rms["fy"])
    assert fit.model.value("UNLOADED_RADIUS") == pytest.approx(0.29)
    assert [text for text in fit.undetermined if text.startswith("no Fx measured: PCX1") and "RBX1" in text]
    reasons = [text.partition(":")[0] for text in fit.undetermined if text.endswith("kept at 0")]
    assert len(reasons) == len(set(reasons))  # "no combined slip" stood there three times
    assert any(text.startswith("no combined slip: RBY1") for text in fit.undetermined)


def test_without_camber_the_camber_coefficients_are_named(tydex):
    upright = tydex[np.abs(tydex["camber"]) < 0.004]
    fit = fit_magic_formula(upright, "5.2")
    said = "no camber sweeps: PDY3, PEY4, PKY3, PHY3, PVY3, PVY4"
    assert any(text.startswith(said) and text.endswith(" kept at 0") for text in fit.undetermined)
    assert "PDY3" not in fit.model.coefficients
    assert "PDY3" not in fit.standard_errors
    assert "no camber sweeps" in fit.summary()


def test_the_other_sign_gives_the_mirrored_model(tydex):
    fit = fit_magic_formula(tydex.assign(fy=-tydex["fy"], mz=-tydex["mz"]), "5.2")
    assert fit.model.value("PKY1") > 0
    assert fit.relative_rms["fy"] < 0.015
    assert any("not in ISO axes" in note for note in fit.notes)


def test_a_radius_that_nobody_states_is_the_one_that_an_explanation_takes_too(tydex):
    bare = tydex.assign(loaded_radius=0.196)
    bare.attrs = {}
    fit = fit_magic_formula(bare, "5.2", starts=1)
    assert fit.model.value("UNLOADED_RADIUS") == ASSUMED_RADIUS
    (note,) = (
        note for note in fit.notes if note.startswith(f"UNLOADED_RADIUS = {ASSUMED_RADIUS} m is assumed")
    )
    assert "the median of the recorded loaded radius is 0.196 m" in note
    coefficients = dict(fit.model.coefficients)
    del coefficients["UNLOADED_RADIUS"]
    lacking = TireModel.from_coefficients({**coefficients, "PTY1": 1.0, "PTY2": 2.0}, version="5.2")
    known = lacking.replace(UNLOADED_RADIUS=ASSUMED_RADIUS)
    assert relaxation_lengths(lacking) == relaxation_lengths(known)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_sweeps_in_coarse_steps_tell_the_sign(sign):
    """Nothing but zero is among the smallest fifth of the slips."""
    tire = tire_52()
    load, angle = np.meshgrid([2000.0, 4000.0, 6000.0], np.radians(np.arange(-12.0, 13.0, 2.0)))
    points = pd.DataFrame({"slip_angle": angle.ravel(), "normal_load": load.ravel()})
    forces = tire.forces(**{n: points[n].to_numpy() for n in points}, limits="ignore")
    fit = fit_magic_formula(points.assign(fy=sign * forces.fy))
    assert np.sign(fit.model.value("PKY1")) == sign * np.sign(tire.value("PKY1"))
    assert fit.relative_rms["fy"] < 0.01


def few_points(tire: TireModel, count: int, seed: int, noise: float) -> pd.DataFrame:
    """Points at pure lateral slip, upright, at three loads, with a formula's own error and noise."""
    rng = np.random.default_rng(seed)
    table = pd.DataFrame(
        {
            "slip_angle": rng.choice(np.radians([-12, -6, -2, -1, -0.5, 0.5, 1, 2, 6, 12]), count),
            "normal_load": rng.choice([0.4, 1.0, 1.6], count) * tire.value("FNOMIN"),
        }
    )
    fy = tire.forces(**{n: table[n].to_numpy() for n in table}, limits="ignore").fy
    return table.assign(fy=fy + noise * np.abs(fy).max() * rng.standard_normal(count))


def test_few_points_give_a_tire_between_them_too(monkeypatch):
    tire = tire_52()
    dense = few_points(tire, 400, 99, 0.0)
    where = {n: dense[n].to_numpy() for n in ("slip_angle", "normal_load")}
    off = {}
    for error in (typical.FORMULA_ERROR, 0.0):
        monkeypatch.setattr(typical, "FORMULA_ERROR", error)
        models = [fit_magic_formula(few_points(tire, 18, seed, 0.005)).model for seed in range(8)]
        found = [m.forces(**where, limits="ignore") for m in models]
        off[error] = [np.sqrt(np.mean((f.fy - dense["fy"]) ** 2)) / dense["fy"].abs().max() for f in found]
    drawn, alone = off.values()
    assert np.mean(drawn) < 0.5 * np.mean(alone)
    assert np.max(drawn) < 0.05


def test_few_points_are_said_to_be_few_and_many_are_left_alone():
    tire = tire_52()
    assert "are few for" in fit_magic_formula(few_points(tire, 18, 0, 0.005)).summary()
    assert "are few for" not in fit_magic_formula(few_points(tire, 200, 0, 0.005)).summary()


def test_few_points_without_noise_are_met_exactly():
    tire = tire_52()
    assert fit_magic_formula(few_points(tire, 40, 1, 0.0)).relative_rms["fy"] < 1e-3


@pytest.mark.parametrize(
    ("tire", "outliers"),
    [
        pytest.param(tire_52(), 0.05, id="5.2-0.05"),
        pytest.param(tire_61(), 0.0, id="6.1-0.0"),
        pytest.param(tire_52(), 0.0, id="5.2-0.0", marks=pytest.mark.long),
        pytest.param(tire_61(), 0.05, id="6.1-0.05", marks=pytest.mark.long),
    ],
)
def test_a_known_tire_is_found_again_below_its_noise(tire, outliers):
    fit = fit_magic_formula(
        rig(tire, count=4000 if outliers else 1500, outliers=outliers), tire.version, unloaded_radius=0.32
    )
    for name in ("fx", "fy", "mz"):
        assert misfit(fit, tire, name) < 0.004, name
    assert set(fit.residuals["output"]) == set(FORCES)
    assert {"normal_load", "camber", "count", "bias", "rms", "largest"} <= set(fit.residuals.columns)


@pytest.mark.long
def test_outliers_leave_a_known_tire_below_its_noise_in_whatever_draw():
    """Two fits in eight leave twice the noise in mz: SLACK is a share of an RMS that outliers make large."""
    tire = tire_52()
    fits = [fit_magic_formula(rig(tire, outliers=0.05, seed=seed), unloaded_radius=0.32) for seed in range(8)]
    assert max(misfit(fit, tire, name) for fit in fits for name in ("fx", "fy", "mz")) < 0.004


def test_standard_errors_are_those_of_repeated_measurements():
    tire = tire_52()
    scales = {n: v for n, v in tire.coefficients.items() if n.startswith("L") and n != "LONGVL"}
    plain = tire.replace(**dict.fromkeys(scales, 1.0))
    fits = []
    for seed in range(8):
        table = rig(plain, count=900, noise=0.01, seed=seed)
        pure = table[np.abs(table["slip_ratio"]) == 0][[*INPUTS, "fy"]]
        fits.append(fit_magic_formula(pure, start=plain, starts=1))
    for name in ("PDY1", "PKY1", "PVY3"):
        spread = np.std([fit.model.value(name) for fit in fits], ddof=1)
        stated = np.mean([fit.standard_errors[name] for fit in fits])
        # eight repeats know a spread to a factor of about two
        assert 0.4 < spread / stated < 2.5, name


def test_what_a_start_model_has_is_kept_where_the_data_are_silent():
    tire = tire_52()
    table = rig(tire, count=600, noise=0.0)
    pure = table[(table["slip_ratio"] == 0) & (table["camber"] == 0)][[*INPUTS, "fy"]]
    fit = fit_magic_formula(pure, start=tire, starts=1)
    assert fit.model.value("PCX1") == tire.value("PCX1")
    assert fit.model.value("PDY3") == tire.value("PDY3")
    assert any("kept at their start values" in text for text in fit.undetermined)
    assert fit.relative_rms["fy"] < 1e-3


def test_recordings_that_cannot_be_fitted_say_why():
    with pytest.raises(RecordingError, match="normal_load"):
        fit_magic_formula(pd.DataFrame({"fy": [1.0]}))
    with pytest.raises(RecordingError, match="no force or moment"):
        fit_magic_formula(pd.DataFrame({"normal_load": np.ones(20)}))
    with pytest.raises(RecordingError, match="only 3 points"):
        fit_magic_formula(pd.DataFrame({"normal_load": np.ones(3), "fy": np.ones(3)}))


def test_one_load_leaves_a_tire_and_not_nothing():
    """With PKY2 at 0 the cornering stiffness would be zero, and the fit a constant."""
    slip = np.linspace(-0.12, 0.12, 81)
    true = TireModel.from_coefficients(
        {"FNOMIN": 7.2, "UNLOADED_RADIUS": 0.03, "PCY1": 1.4, "PDY1": 0.8, "PKY1": -12.0, "PKY2": 1.8},
        version="5.2",
    )
    fy = true.forces(slip_angle=slip, normal_load=np.full(81, 7.2)).fy
    recording = pd.DataFrame({"slip_angle": slip, "normal_load": 7.2, "fy": fy})
    fit = fit_magic_formula(recording)
    assert any("one load only" in text and "PKY2 kept at 1.8" in text for text in fit.undetermined)
    left = fy - fit.forces(slip_angle=slip, normal_load=np.full(81, 7.2)).fy
    assert np.sqrt(np.mean(left**2)) < 0.01 * np.abs(fy).max()


def test_braking_alone_holds_the_side_force_but_is_no_combined_slip():
    """Two slip angles leave RVY1 to RVY6 open at none; one point at combined slip is not enough for a fit."""
    tire = tire_52()
    points = rig(tire, noise=0.002)
    braked = np.abs(points["slip_ratio"]) > 0.02
    turned = np.abs(points["slip_angle"]) > 0.01
    few = points[~(braked & turned)]
    one = pd.concat([few, points[braked & turned].iloc[:1]])
    fit = fit_magic_formula(one[[*INPUTS, "fx", "fy"]], starts=1)
    assert any("only 1 points of combined slip" in why and "RBY1" in why for why in fit.undetermined)
    assert fit.model.coefficients.get("RVY1", 0.0) == 0.0


def test_a_load_that_fluctuates_is_one_load_and_its_stiffness_stays_positive_at_others():
    """A flat belt that holds one load lets it fluctuate by a tenth: that says nothing of other loads."""
    rng = np.random.default_rng(5)
    slip = 0.2 * np.sin(np.linspace(0.0, 12.0, 500))
    load = 2750.0 + 75.0 * rng.standard_normal(500)
    true = tire_52()
    fy = true.forces(slip_angle=slip, normal_load=load).fy + 40.0 * rng.standard_normal(500)
    recording = pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": fy})
    others = np.linspace(0.5, 1.5, 11) * 2750.0
    for version in ("5.2", "6.1"):
        fit = fit_magic_formula(recording, version)
        assert any("one load only" in text for text in fit.undetermined)
        known, found = (
            np.asarray(
                m.forces(
                    normal_load=others, limits="ignore", outputs=("cornering_stiffness",)
                ).cornering_stiffness
            )
            for m in (true, fit.model)
        )
        assert ((found / known > 0.5) & (found / known < 2.0)).all(), version


def test_the_model_to_write_states_the_ranges_that_it_was_fitted_to_and_has_the_same_forces(tmp_path):
    """Only ``tire fit`` wrote them: a model written in Python claimed to hold everywhere."""
    slips, loads = np.meshgrid(np.linspace(-0.1, 0.15, 30), [2000.0, 4000.0, 6000.0])
    at = {"slip_angle": slips.ravel(), "normal_load": loads.ravel()}
    noise = {name: np.linspace(-4e-4, 4e-4, slips.size) for name in ("camber", "slip_ratio")}
    fit = fit_magic_formula(
        pd.DataFrame({**at, **noise, "fy": tire_52().forces(**at, limits="ignore").fy}), starts=1
    )
    write_tir(fit.model_with_ranges, tmp_path / "a.tir")
    back = read_tir(tmp_path / "a.tir")
    assert {name: list(each[2:]) for name, each in back.ranges.items()} == {
        "slip_angle": [pytest.approx(-0.1), pytest.approx(0.15)],
        "normal_load": [2000.0, 6000.0],
    }  # and none of the noise of camber and slip ratio, to which a simulator would clip all else
    assert fit.model.ranges == {}
    for outside in (0.5, 2.0):
        where = {name: outside * values for name, values in at.items()}
        same = fit.model_with_ranges.forces(**where, limits="ignore").fy
        np.testing.assert_array_equal(same, fit.model.forces(**where, limits="ignore").fy)
