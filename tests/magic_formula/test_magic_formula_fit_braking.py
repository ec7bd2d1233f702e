"""Fits to brake and drive sweeps at a slip angle that the rig holds, but for its noise."""

from __future__ import annotations

import warnings
from itertools import product

import numpy as np
import pandas as pd
import pytest
from magic_formula_tires import tire_52

from tire_pipeline.magic_formula import PoorFitWarning, fit_magic_formula

pytestmark = pytest.mark.slow


def brake_sweeps(held, cambers=(0.0, 0.035, 0.07), seed=1):
    """Sweeps of slip ratio at four loads and a held slip angle, rad, with a rig's noise on all channels."""
    rng = np.random.default_rng(seed)
    tire, sweep = tire_52(), 0.2 * np.sin(np.linspace(0.0, 2.0 * np.pi, 60))
    parts = []
    for load in (0.4, 0.7, 1.1, 1.5):
        for camber in cambers:
            part = pd.DataFrame({"slip_ratio": sweep, "camber": camber})
            part["slip_angle"] = held + rng.normal(0.0, 0.0009, sweep.size)
            part["normal_load"] = load * tire.value("FNOMIN") + rng.normal(0.0, 25.0, sweep.size)
            parts.append(part)
    table = pd.concat(parts, ignore_index=True)
    forces = tire.forces(**{name: table[name].to_numpy() for name in table}, limits="ignore")
    for name in ("fx", "fy"):
        table[name] = getattr(forces, name) + rng.normal(0.0, 20.0, len(table))
    return table


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_held_slip_angle_does_not_turn_the_sign_of_the_cornering_stiffness(seed):
    """The slope of the noise gave PKY1 = +200, with "the data are not in ISO axes"."""
    fit = fit_magic_formula(brake_sweeps(-0.105, seed=seed), starts=2)
    assert fit.model.value("PKY1") < 0.0
    assert not fit.poor
    assert not any("ISO" in note for note in fit.notes)


def test_a_slip_angle_that_was_not_swept_is_the_reason_of_a_poor_side_force():
    """It was "a channel that does not belong (another wheel, another run, or a shift in time)"."""
    with pytest.warns(PoorFitWarning, match="slip_angle was not swept"):
        fit = fit_magic_formula(brake_sweeps(0.0), starts=2)
    assert "fx" not in fit.poor


def test_a_moment_without_a_force_that_it_contains_says_which():
    """It was "a channel that does not belong (another wheel, another run, or a shift in time)"."""
    rng = np.random.default_rng(6)
    parts = [brake_sweeps(held) for held in (-0.1, -0.05, 0.0, 0.05, 0.1)]
    table = pd.concat(parts, ignore_index=True)
    arm = 0.05 * table["fx"] - 0.02 * table["fy"]
    table = table.assign(mz=arm + rng.normal(0.0, 1.0, len(table))).drop(columns="fx")
    with pytest.warns(PoorFitWarning, match="fx was not recorded, and mz contains it"):
        fit_magic_formula(table, starts=2)


def test_a_moment_is_not_said_to_contain_a_force_that_it_does_not():
    """Mx is made of the load, camber and Fy: without Fx it is no worse."""
    rng = np.random.default_rng(7)
    table = pd.concat([brake_sweeps(held) for held in (-0.1, 0.0, 0.1)], ignore_index=True)
    table = table.assign(mx=rng.normal(0.0, 50.0, len(table))).drop(columns="fx")
    with pytest.warns(PoorFitWarning) as told:
        fit = fit_magic_formula(table, starts=2)
    assert "mx" in fit.poor
    assert not any("fx was not recorded, and mx" in str(each.message) for each in told)


@pytest.mark.parametrize(("sign", "told"), [(1.0, False), (-1.0, True)], ids=["as it is", "mirrored"])
def test_a_mirrored_aligning_moment_is_no_success(sign, told):
    """It was fitted as well as the true one, by a negative pneumatic trail, without a word."""
    tire, sweep = tire_52(), 0.2 * np.sin(np.linspace(0.0, 2.0 * np.pi, 60))
    loads = np.repeat([0.4, 0.7, 1.1, 1.5], sweep.size) * tire.value("FNOMIN")
    table = pd.DataFrame({"slip_angle": np.tile(sweep, 4), "normal_load": loads})
    forces = tire.forces(**{name: table[name].to_numpy() for name in table}, limits="ignore")
    table = table.assign(fy=forces.fy, mz=sign * forces.mz)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", PoorFitWarning)
        fit = fit_magic_formula(table, starts=2)
    assert any("the pneumatic trail is negative" in str(each.message) for each in caught) is told
    assert ("mz" in fit.poor) is told


@pytest.mark.parametrize(("sign", "told"), [(1.0, False), (-1.0, True)], ids=["as it is", "mirrored"])
def test_a_mirrored_camber_is_no_success(sign, told):
    """A flat-belt recording in SAE axes was fitted with the camber thrust of a mirrored tire."""
    tire, sweep = tire_52(), 0.2 * np.sin(np.linspace(0.0, 2.0 * np.pi, 60))
    parts = [
        pd.DataFrame({"slip_angle": sweep, "camber": camber, "normal_load": load * tire.value("FNOMIN")})
        for load in (0.5, 1.0, 1.5)
        for camber in (-0.05, 0.0, 0.05)
    ]
    table = pd.concat(parts, ignore_index=True)
    forces = tire.forces(**{name: table[name].to_numpy() for name in table}, limits="ignore")
    table = table.assign(fy=forces.fy, camber=sign * table["camber"])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", PoorFitWarning)
        fit_magic_formula(table, starts=2)
    assert any("away from the side to which the wheel leans" in str(w.message) for w in caught) is told


def test_braking_without_a_slip_ratio_is_no_free_rolling():
    """Fy left 7% of the largest force, without a word."""
    table = pd.concat([brake_sweeps(held) for held in (-0.105, -0.05, 0.0, 0.05, 0.105)], ignore_index=True)
    with pytest.warns(PoorFitWarning, match="no slip ratio was measured, but fx changes, up to") as told:
        fit_magic_formula(table.drop(columns="slip_ratio"), starts=2)
    assert [str(each.message)[:3] for each in told] == ["fy:"]


def brake_rounds(true, seed):
    """Sweeps of slip ratio at 0, -3 and -6 deg; the force is a sample late, and falls as the tread warms."""
    rng = np.random.default_rng(seed)
    sweep = np.interp(np.linspace(0.0, 5.0, 90), [0.0, 1.0, 2.0, 4.0, 5.0], [0.0, 0.0, 0.2, -0.2, 0.0])
    parts = []
    for held, camber, load in product(np.radians([0.0, -3.0, -6.0]), (0.0, 0.035), (0.5, 1.0, 1.5)):
        part = pd.DataFrame({"slip_ratio": sweep, "camber": camber})
        part["slip_angle"] = held + rng.normal(0.0, 5e-4, sweep.size)
        part["normal_load"] = load * true.value("FNOMIN") + rng.normal(0.0, 25.0, sweep.size)
        late = part.assign(slip_ratio=np.r_[0.0, sweep[:-1]])
        forces = true.forces(**{name: late[name].to_numpy() for name in late}, limits="ignore")
        warm = 1.0 - np.linspace(0.0, 0.15, sweep.size)
        parts.append(part.assign(fy=forces.fy * warm + rng.normal(0.0, 20.0, sweep.size)))
    return pd.concat(parts, ignore_index=True)


@pytest.mark.parametrize("seed", [2, 3])
def test_slip_angles_to_one_side_give_the_other_side_too(seed):
    """PVY1 was 0.5 and PVY2 0.5: at the slip angles of the other sign Fy was 0.4 to 1.4 times the tire's."""
    true = tire_52().replace(
        PDY1=2.2, PDX1=2.3, PKY1=-75.0, PKX1=80.0, PKY2=2.5, RBX1=35.0, RBY1=32.0,
        PVY1=0.03, PHY1=0.003, PHY2=0.002, PVY2=0.01, PVY3=0.0, PVY4=0.0, PHY3=0.0,
    )  # fmt: skip
    fit = fit_magic_formula(brake_rounds(true, seed), starts=4)
    there = {"slip_angle": np.radians([3.0, 6.0, 9.0]), "normal_load": true.value("FNOMIN")}
    found, expected = (m.forces(**there, limits="ignore", outputs=("fy",)).fy for m in (fit.model, true))
    assert found == pytest.approx(expected, rel=0.1)


def bristles(slip_angle, slip_ratio, load):
    """Forces and moment of bristles under a parabolic pressure, on a carcass that gives way sideways."""
    place = np.linspace(-1.0, 1.0, 49)[:, None]
    half = 0.055 * np.sqrt(load / 1100.0)
    pressure = 0.75 * (1.0 - place**2) * (1.0 - 0.12 * place) * load / half
    stiff = np.sin(2.0 * np.arctan(load / 1760.0)) / np.sin(2.0 * np.arctan(1.0 / 1.6)) / (2.0 * half**2)
    lateral = -41_800.0 * stiff * np.tan(slip_angle + 0.003) / (1.0 + slip_ratio) * (place + 1.0) * half
    ahead = 49_500.0 * stiff * slip_ratio / (1.0 + slip_ratio) * (place + 1.0) * half
    friction = 2.4 * (load / 1100.0) ** -0.14 / (1.0 + 0.13 * np.hypot(np.tan(slip_angle), slip_ratio))
    held = np.minimum(1.0, friction * pressure / np.maximum(np.hypot(lateral, ahead), 1e-9)) * half / 24.0
    fx, fy = (ahead * held).sum(axis=0), (lateral * held).sum(axis=0) + 0.01 * load
    return fx, fy, -(place * half * lateral * held).sum(axis=0) - 9e-6 * fy * fx


def test_moments_of_braking_at_slip_angles_to_one_side_are_met():
    """What the slip's sign decides stayed at 0 where all points together need it."""
    sweep = np.interp(np.linspace(0.0, 3.5, 58), [0.0, 1.0, 2.75, 3.5], [0.0, -0.2, 0.15, 0.0])
    held, load, ratio = (
        x.ravel()
        for x in np.meshgrid(np.radians([0.0, 3.0, 6.0]), [550.0, 1100.0, 1540.0], sweep, indexing="ij")
    )
    rng = np.random.default_rng(0)
    fx, fy, mz = (
        force + size * rng.standard_normal(load.size)
        for force, size in zip(bristles(held, ratio, load), (20.0, 20.0, 0.6), strict=True)
    )
    table = pd.DataFrame({"slip_angle": held, "slip_ratio": ratio, "normal_load": load})
    fit = fit_magic_formula(table.assign(fx=fx, fy=fy, mz=mz))
    assert fit.relative_rms["mz"] < 0.0145  # the least is 0.0141; 0.0149 was left
