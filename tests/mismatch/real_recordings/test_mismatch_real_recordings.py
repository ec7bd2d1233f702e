"""The two real recordings of ../shared/recordings: what the issue claims of them, and what was reached.

The experiments are those of benchmarks/real_recordings.py, which prints all figures
(docs/history/mismatch.md).
"""

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest
from mismatch_shared import shared
from weighed import named_sets

from tire_pipeline.mismatch import explain_mismatch

FILE = Path(__file__).resolve().parents[3] / "benchmarks" / "real_recordings.py"


@pytest.fixture(scope="module")
def real():
    shared("recordings/tydex")
    shared("recordings/dart")
    spec = importlib.util.spec_from_file_location("real_recordings", FILE)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


_LONG = pytest.mark.long
DRAWS = range(20)
"""All draws that benchmarks/real_recordings.py prints; none is left out."""


@pytest.fixture(scope="module")
def tydex_draws(real):
    """Camber hidden, 40% of the cambered points held out: report, error before and after of every draw."""
    return [real.tydex_camber(seed) for seed in DRAWS]


@pytest.mark.slow
def test_tydex_camber_of_a_few_draws(real):
    draws = [real.tydex_camber(seed) for seed in range(2)]
    assert all(after <= before for _, before, after in draws)
    assert [real.names(report) for report, _, _ in draws] == [["camber"]] * len(draws)


@pytest.mark.long
def test_tydex_camber_is_found(real, tydex_draws):
    found = [real.names(report) == ["camber"] for report, _, _ in tydex_draws]
    assert np.mean(found) >= 0.9


@pytest.mark.long
def test_tydex_camber_put_in_halves_the_error_of_held_out_points(tydex_draws):
    halved = [after < 0.5 * before for _, before, after in tydex_draws]
    assert np.mean(halved) >= 0.9


@pytest.mark.long
def test_tydex_camber_never_makes_held_out_points_worse(tydex_draws):
    assert [after <= before for _, before, after in tydex_draws] == [True] * len(tydex_draws)


@pytest.mark.long
@pytest.mark.parametrize("name", ["shift", "thrust", "stiffness_loss"])
def test_tydex_camber_is_the_same_whatever_is_held_out(real, tydex_draws, name):
    """Its thrust over load and its loss of friction were in or out by chance, and moved the others."""
    found = [r.effects[0].parameters for r, _, _ in tydex_draws if real.names(r) == ["camber"]]
    values = np.array([parameters[name][:2] for parameters in found])
    # Draws share 60% of the points or more: they differ by less than independent ones.
    near = np.abs(values[:, 0] - np.median(values[:, 0])) < 2.0 * values[:, 1]
    assert near.sum() >= 0.9 * len(tydex_draws)


@pytest.mark.slow
@pytest.mark.parametrize("half", [0, "even", *(pytest.param(h, marks=_LONG) for h in (*range(1, 10), "odd"))])
def test_tydex_halves_agree(real, half):
    assert real.tydex_halves(half).verdict == "agrees"


@pytest.mark.slow
@pytest.mark.parametrize("half", [0, pytest.param(1, marks=_LONG)])
def test_dart_other_half_gets_no_name_and_an_equation_only_if_it_holds_on_another_day(real, half):
    """A formula leaves 3% of the largest force on these drives, more than fitted models usually do."""
    report, other = real.dart_other_half(half)
    f = report.fit["fy"]
    assert not report.effects
    equation = report.unnamed is not None and report.unnamed.physics is not None
    assert report.verdict == ("unexplained" if equation else "undecided")
    if equation:  # drives of another day
        for drive in real.drives("second_session"):
            left = real.rms(drive["fy"] - report.corrected.predict(drive)["fy"])
            assert left < real.rms(drive["fy"] - report.corrected.as_it_came.predict(drive)["fy"])
    assert min(report.remainder.unusual.values()) > report.remainder.usual[1]
    assert f.rms_before < 0.05 * real.largest(other)


@pytest.mark.slow
@pytest.mark.parametrize("draws", [3, pytest.param(10, marks=_LONG)])
def test_what_too_few_points_show_is_no_agreement(real, draws):
    """With half of the cambered points camber explains most; whether named or not, it is no agreement."""
    flat = real.flat_points()
    reports = []
    for seed in range(draws):
        kept = flat | (np.random.default_rng(seed).random(flat.size) >= 0.5)
        reports.append(explain_mismatch(real.tydex_tire(), real.tydex()[kept]))
    assert "agrees" not in [r.verdict for r in reports]
    # What is named is camber; what is not named says so.
    said = [set(real.names(r)) <= {"camber"} for r in reports]
    assert np.mean(said) >= 0.9
    assert {r.verdict for r in reports if not r.effects} <= {"unexplained"}


def _short(fitted: int, why: str) -> object:
    return pytest.param(fitted, 0.65, marks=pytest.mark.xfail(reason=why, strict=True))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fitted", "gone"),
    [
        (0, 0.55),
        _short(0, "62% are gone, not 65%"),
        pytest.param(1, 0.65, marks=pytest.mark.long),
    ],
)
def test_dart_second_session_is_located_explained_and_repaired(real, fitted, gone):
    """The issue asks for 65%; docs/history/mismatch.md says what is reached."""
    report, before, after = real.dart_repair(fitted)
    assert report.located
    assert report.located[0].mean < 0.0
    assert report.effects
    assert after < (1.0 - gone) * before


@pytest.mark.slow
def test_dart_errors_grow_where_the_second_session_is_wrong(real):
    first, second = real.drives("rubber_floor_ramps"), real.drives("second_session")
    tire = real.dart_tire(0)
    errors = [real.error(tire, r) for r in first[1::2]]
    assert min(real.error(tire, r) for r in second) > 3.0 * max(errors)


IN_CI = {
    "dart": ("force stuck for a tenth", "force 1 s late", "force drifts by 20% of the largest"),
    "tydex": ("force in kN", "slip angle mirrored", "force in lbf", "force cut at half of the largest"),
}
"""What needs a time line in a drive, the rest in points, which are fewer; the others are in ``long``."""


def _cases():
    spec = importlib.util.spec_from_file_location("real_recordings_names", FILE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for which in ("tydex", "dart"):
        for what, (_, _, timed) in module.ARTEFACTS.items():
            if which == "tydex" and timed:
                continue
            marks = () if what in IN_CI[which] else _LONG
            yield pytest.param(which, what, id=f"{which}: {what}", marks=marks)


@pytest.mark.slow
@pytest.mark.parametrize(("which", "what"), list(_cases()))
def test_artefacts_in_real_recordings_get_their_name_and_no_physics(real, which, what):
    """Each set of names holds the artefact: what cannot be told from it may stand beside it, nothing else."""
    right, said = set(real.ARTEFACTS[what][1]), named_sets(*real.with_artefact(which, what))
    assert said
    assert all(names & right for names in said)
