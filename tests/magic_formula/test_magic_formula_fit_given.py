"""What a fit says of recordings that hold no measurement, or hardly vary."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula import PoorFitWarning, TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.recordings import join_recordings

pytestmark = pytest.mark.slow

TIRE = TireModel.from_coefficients(
    {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2, "UNLOADED_RADIUS": 0.3}
)


def sweep() -> pd.DataFrame:
    slip, load = np.tile(np.linspace(-0.2, 0.2, 40), 3), np.repeat([2000.0, 4000.0, 6000.0], 40)
    fy = TIRE.forces(slip_angle=slip, normal_load=load).fy
    return pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": fy})


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"fy": np.nan}, "no force or moment was measured: fy holds no number"),
        ({"fy": 1e300}, "no force or moment was measured: fy holds no number"),
        ({"fy": 5.0}, "no force or moment was measured: fy is 5 N throughout"),
        ({"fy": 0.0}, "no force or moment was measured"),
        ({"slip_angle": np.inf}, "neither slip_angle nor slip_ratio is recorded; slip_angle holds no number"),
    ],
)
def test_what_was_not_measured_is_no_fit(change, said):
    with pytest.raises(RecordingError, match=said):
        fit_magic_formula(sweep().assign(**change))


def test_a_force_without_any_slip_is_no_fit():
    with pytest.raises(RecordingError, match="neither slip_angle nor slip_ratio is recorded"):
        fit_magic_formula(sweep().drop(columns="slip_angle"))


def test_a_force_that_was_not_measured_does_not_keep_another_from_being_fitted():
    fit = fit_magic_formula(sweep().assign(fx=-3.0))
    assert "fx is -3 N throughout: not fitted" in fit.notes
    assert fit.relative_rms["fy"] < 1e-3


def test_infinite_values_are_left_out_as_missing_ones_are():
    table = sweep()
    table.loc[::7, "fy"] = np.inf
    assert fit_magic_formula(table).relative_rms["fy"] < 1e-3


@pytest.mark.parametrize("noise", [0.0, 2e-4, 0.01])
def test_a_slip_ratio_that_says_locked_throughout_was_not_measured(noise):
    """Rigs write -1, with the noise of the wheel's speed, where they roll freely: the side force doubled."""
    table = sweep()
    ratio = -1.0 + np.random.default_rng(1).normal(0.0, noise, len(table))
    ratio[[3, 70]] = [0.4, np.nan]  # an odd sample, and a missing one, change nothing
    fit = fit_magic_formula(table.assign(slip_ratio=ratio), starts=4)
    assert fit.relative_rms["fy"] < 1e-3
    assert len(fit.measured) == len(table)
    assert any("locked wheel: taken as not measured" in note for note in fit.notes)


def test_a_wheel_that_brakes_until_it_locks_was_measured():
    table = braked([-0.14, -0.07, 0.0, 0.07, 0.14])[0]
    stopped = table.assign(slip_ratio=np.where(table["slip_ratio"] < -0.1, -1.0, table["slip_ratio"]))
    fit = fit_magic_formula(stopped, starts=1)
    assert not any("locked" in note for note in fit.notes)
    assert fit.measured["slip_ratio"].min() == -1.0


def test_of_joined_recordings_one_may_have_no_slip_ratio():
    """A rig writes -1 in its sweeps of the slip angle, and measures the slip where it brakes."""
    table, tire = braked([-0.14, -0.07, 0.0, 0.07, 0.14])
    free = sweep().assign(slip_ratio=-1.0002, fx=0.0)
    joined = join_recordings({"free": free, "braked": table})
    fit = fit_magic_formula(joined, starts=4)
    assert (
        f"slip_ratio is -1 in rows 0 to {len(free) - 1}, a locked wheel: taken as not measured, and as 0"
        in (fit.notes)
    )
    at = {"slip_angle": [0.02, 0.1], "normal_load": 4000.0}
    assert np.allclose(fit.forces(**at).fy, tire.forces(**at).fy, rtol=0.02)
    assert fit.measured["slip_ratio"].min() == -0.2


@pytest.mark.parametrize("ratio", [0.05, -0.5])
@pytest.mark.parametrize("version", ["5.2", "6.1"])
def test_a_slip_ratio_that_stands_still_takes_nothing_off_the_side_force(ratio, version):
    """At one slip ratio nothing tells what it takes off. A part was made up, and pure Fy grew by it."""
    table, rng = sweep(), np.random.default_rng(2)
    table["fy"] += rng.normal(0.0, 60.0, len(table))
    plain = fit_magic_formula(table, version, starts=4)
    held = fit_magic_formula(
        table.assign(slip_ratio=ratio + rng.normal(0.0, 2e-4, len(table))), version, starts=4
    )
    at = {"slip_angle": [0.02, 0.1], "normal_load": 4000.0}
    assert np.allclose(held.forces(**at).fy, plain.forces(**at).fy, rtol=1e-3)
    assert "RBY1" not in held.standard_errors
    assert any(f"slip_ratio is {ratio:g} throughout" in note for note in held.notes)


def test_braking_at_one_slip_angle_gives_the_force_there():
    table = braked([0.07])[0]
    fit = fit_magic_formula(table, starts=4)
    assert fit.relative_rms["fx"] < 0.01
    assert "RBX1" not in fit.standard_errors
    assert any("slip_angle is 0.07 throughout" in note for note in fit.notes)


@pytest.mark.parametrize(("by_pressure", "ripple"), [(0.0, 0.011), (0.0, 0.02), (3.0, 0.011)])
def test_the_ripple_of_one_set_pressure_says_nothing_of_another_pressure(by_pressure, ripple):
    """Friction that goes along with the ripple made a model that is far off at another pressure."""
    rng = np.random.default_rng(0)
    slip, load = np.tile(np.linspace(-0.2, 0.2, 60), 5), np.repeat(np.linspace(0.4, 1.6, 5), 60) * 4000.0
    drift = rng.uniform(-ripple, ripple, slip.size)
    table = pd.DataFrame({"slip_angle": slip, "normal_load": load, "pressure": 220e3 * (1.0 + drift)})
    table["fy"] = TIRE.forces(slip_angle=slip, normal_load=load).fy * (1.0 + by_pressure * drift)
    table["fy"] += rng.normal(0.0, 15.0, slip.size)
    fit = fit_magic_formula(table, "6.1")
    assert any(
        text.startswith("one pressure only: PPY1, PPY2, PPY3, PPY4, PPY5 kept") for text in fit.undetermined
    )
    assert not any(fit.model.value(f"PPY{i}") for i in range(1, 6))


def test_two_set_pressures_give_what_changes_with_pressure():
    slip, load, pressure = (
        x.ravel()
        for x in np.meshgrid(
            np.linspace(-0.2, 0.2, 40), [2000.0, 4000.0, 6000.0], [200e3, 212e3], indexing="ij"
        )
    )
    tire = TIRE.to_version("6.1").replace(NOMPRES=200e3, PPY3=-0.8)
    fy = tire.forces(slip_angle=slip, normal_load=load, pressure=pressure).fy
    table = pd.DataFrame({"slip_angle": slip, "normal_load": load, "pressure": pressure, "fy": fy})
    fit = fit_magic_formula(table, "6.1")
    assert fit.relative_rms["fy"] < 5e-3
    slope = fit.model.value("PPY3") * 200e3 / fit.model.value("NOMPRES")
    assert slope == pytest.approx(-0.8, abs=0.2)


def braked(angles, *, sign=1.0):
    """Sweeps of the slip ratio at fixed slip angles."""
    ratio, angle, load = (
        x.ravel()
        for x in np.meshgrid(np.linspace(-0.2, 0.2, 31), angles, [2000.0, 4000.0, 6000.0], indexing="ij")
    )
    tire = TIRE.replace(PCX1=1.6, PDX1=1.1, PKX1=25.0, RBX1=12.0, RBX2=8.0, RCX1=1.1, RBY1=8.0, RCY1=1.0)
    forces = tire.forces(slip_angle=angle, slip_ratio=ratio, normal_load=load)
    table = pd.DataFrame({"slip_angle": angle, "slip_ratio": ratio, "normal_load": load})
    return table.assign(fx=sign * forces.fx, fy=forces.fy), tire


@pytest.mark.parametrize("version", ["5.2", "6.1"])
def test_braking_at_fixed_slip_angles_alone_gives_the_longitudinal_force(version):
    """Without a point at zero slip angle Fx was 0, and 60% were left with a reason that was none."""
    table, tire = braked([-0.14, -0.07, 0.07, 0.14])
    fit = fit_magic_formula(table, version)
    assert fit.relative_rms["fx"] < 0.01
    assert "Fx at pure slip was not measured: told from combined slip" in fit.notes
    straight = {"slip_ratio": np.linspace(-0.15, 0.15, 21), "normal_load": 4000.0}
    found, true = (m.forces(**straight).fx for m in (fit.model, tire))
    assert np.abs(found - true).max() < 0.05 * np.abs(true).max()


@pytest.mark.parametrize(
    ("table", "output", "said"),
    [
        (braked([0.0], sign=-1.0)[0], "fx", "falls with slip_ratio"),
        (
            braked([0.0])[0].assign(slip_ratio=lambda t: 12.0 * t["slip_ratio"]),
            "fx",
            "slip_ratio looks like percent",
        ),
        (
            sweep().assign(slip_angle=lambda t: 5.0 * t["slip_angle"], fy=lambda t: t["fy"] / 30.0),
            "fy",
            "stiffness is below any tire's",
        ),
        (
            sweep().assign(slip_angle=lambda t: 0.05 * t["slip_angle"]),
            "fy",
            "stiffness is beyond any tire's",
        ),
        (sweep().assign(fy=lambda t: t["fy"] / 1000.0), "fy", "reaches no more than 0.00"),
        (sweep().assign(fy=lambda t: t["fy"] / 40.0), "fy", "reaches no more than 0.02"),
        (sweep().assign(fy=lambda t: t["fy"] / 4.448), "fy", "both below any tire's"),
    ],
)
def test_what_no_tire_has_is_no_success(table, output, said):
    with pytest.warns(PoorFitWarning, match=said):
        fit = fit_magic_formula(table)
    assert said in fit.poor[output]


def cambered():
    """Steady points as a rig records them: few at each load and camber, cambers of both signs."""
    rng = np.random.default_rng(1)
    load = rng.choice([1200.0, 3000.0, 4800.0, 6600.0, 8400.0], 111)
    slip, camber = rng.uniform(-0.2, 0.2, 111), rng.uniform(-0.08, 0.08, 111)
    tire = TIRE.replace(PVY3=0.3, PDY2=-0.15, PHY3=0.02)
    fy = tire.forces(slip_angle=slip, normal_load=load, camber=camber).fy * rng.normal(1.0, 0.01, 111)
    table = pd.DataFrame({"slip_angle": slip, "normal_load": load, "camber": camber, "fy": fy})
    return table.sort_values(["slip_angle"], key=np.abs, ignore_index=True)


def turned(table, name):
    return table.assign(**{name: -table[name]})


def shuffled(table, name):
    return table.assign(**{name: np.random.default_rng(2).permutation(table[name])})


def half_turned(table):
    return table.assign(fy=table["fy"] * np.where(np.arange(len(table)) % 2, 1.0, -1.0))


def without_sign(table, name):
    return table.assign(**{name: table[name].abs()})


FEW = cambered()
MANY = pd.concat([FEW] * 3, ignore_index=True).assign(fy=lambda t: t["fy"] + np.linspace(-9.0, 9.0, len(t)))


@pytest.mark.parametrize("table", [FEW, MANY], ids=["few", "many"])
@pytest.mark.parametrize(
    ("change", "start", "said"),
    [
        (lambda t: turned(t, "fy"), TIRE, "reason: axes or signs; fy over slip_angle has the other sign"),
        (lambda t: turned(t, "slip_angle"), TIRE, "reason: axes or signs; fy over slip_angle has the other"),
        (lambda t: turned(t, "fy"), TIRE, "the force falls with slip_angle in the tire's own convention"),
        (half_turned, None, "reason: signs; the size of fy follows that of slip_angle, its sign does not"),
        (lambda t: without_sign(t, "slip_angle"), None, "reason: signs; the size of fy follows"),
        (lambda t: without_sign(t, "fy"), None, "reason: signs; the size of fy follows"),
        (lambda t: shuffled(t, "fy"), None, "reason: a channel that does not belong; fy hardly follows slip"),
        (lambda t: shuffled(t, "slip_angle"), None, "a channel that does not belong; fy hardly follows slip"),
        (lambda t: shuffled(t, "normal_load"), None, "does not belong; fy hardly follows normal_load"),
    ],
)
def test_signs_and_channels_are_judged_before_bounds(table, change, start, said):
    """Mirrored and shuffled forces end at a bound of the slip stiffness: their units seemed wrong."""
    with pytest.warns(PoorFitWarning):
        fit = fit_magic_formula(change(table), start=start, starts=4)
    assert said in fit.poor["fy"]


@pytest.mark.parametrize("start", [None, TIRE])
@pytest.mark.parametrize(
    "rows",
    [
        FEW,
        FEW[FEW["slip_angle"] > 0.0],
        FEW[FEW["slip_angle"] > 0.07],
        FEW[FEW["slip_angle"].abs() < 0.03],
        FEW.assign(slip_angle=FEW["slip_angle"] + 0.02),
    ],
    ids=["whole", "one side", "beyond the largest force", "small slips", "offset of the slip"],
)
def test_a_part_of_a_sweep_is_no_poor_fit(rows, start):
    assert fit_magic_formula(rows, start=start, starts=4).poor == {}


def in_kn(**more):
    return FEW.assign(normal_load=FEW["normal_load"] / 1e3, fy=FEW["fy"] / 1e3, **more)


@pytest.mark.parametrize(
    ("table", "options", "said"),
    [
        (FEW.assign(pressure=12.0), {"version": "6.1"}, "no tire has a pressure of 12 Pa"),
        (FEW.assign(pressure=83.0), {"version": "6.1"}, "no tire has a pressure of 83 Pa"),
        (FEW.assign(pressure=0.0), {"version": "6.1"}, "no tire has a pressure of 0 Pa"),
        (in_kn(pressure=83e3), {}, "N is a model car's, but a pressure was recorded"),
        (in_kn(), {"unloaded_radius": 0.3}, "but the wheel has a radius of 0.3 m"),
        (in_kn(), {"nominal_load": 4000.0}, "but the nominal load is 4,000 N"),
        (FEW, {"start": TIRE.replace(UNLOADED_RADIUS=320.0)}, "no tire has an unloaded radius of 320 m"),
    ],
)
def test_what_no_tire_has_of_load_pressure_and_radius_is_no_success(table, options, said):
    with pytest.warns(PoorFitWarning, match=said):
        fit = fit_magic_formula(table, starts=2, **options)
    assert said in fit.poor["fy"]


@pytest.mark.parametrize("options", [{}, {"unloaded_radius": 0.023}, {"nominal_load": 4.0}])
def test_a_model_car_is_no_poor_fit(options):
    """Of a load alone nobody can tell: a note asks, unless the caller has said what loads the tire has."""
    fit = fit_magic_formula(in_kn(), starts=2, **options)
    assert fit.poor == {}
    assert any("is a model car's: check the unit" in note for note in fit.notes) != (
        "nominal_load" in options
    )


@pytest.mark.parametrize("version", ["5.2", "6.1"])
def test_a_pressure_that_a_tire_has_is_no_poor_fit(version):
    assert fit_magic_formula(FEW.assign(pressure=69e3), version, starts=2).poor == {}


@pytest.mark.parametrize(
    ("first", "last", "friction"), [(6.0, 14.0, 0.32), (10.0, 14.0, 0.32), (0.2, 10.0, 1.0)]
)
def test_one_direction_alone_is_no_matter_of_units_nor_of_another_channel(first, last, friction):
    """At large slips of one sign a tire on snow was "a channel that does not belong", with 1% left."""
    rows = one_direction(first, last, friction)
    assert fit_magic_formula(rows, starts=4).poor == {}
    with pytest.warns(PoorFitWarning, match="Likely reason: units; fy reaches no more than 0.00"):
        fit_magic_formula(rows.assign(fy=rows["fy"] / 1e3), starts=4)


def test_a_channel_that_hardly_changes_over_one_direction_may_well_belong():
    rows = one_direction(0.2, 10.0, 1.0)
    mx = np.random.default_rng(1).normal(0.0, 20.0, len(rows))
    said = "mx: .* one direction only; slip_angle has one sign throughout, and mx hardly changes with it"
    with pytest.warns(PoorFitWarning, match=said):
        fit_magic_formula(rows.assign(mx=mx), starts=4, unloaded_radius=0.3)


def one_direction(first: float, last: float, friction: float) -> pd.DataFrame:
    slips, loads = np.meshgrid(np.radians(np.linspace(first, last, 60)), [2000.0, 4000.0, 6000.0])
    slip, load = slips.ravel(), loads.ravel()
    fy = TIRE.replace(PDY1=friction).forces(slip_angle=slip, normal_load=load).fy
    noise = np.random.default_rng(0).normal(0.0, 20.0, slip.size)
    return pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": fy + noise})
