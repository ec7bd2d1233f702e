"""Combined slip that the file lacks: named where brake sweeps tell it, with its like where they don't."""

from __future__ import annotations

import numpy as np
import pytest
from brake_rig import brake_sweeps, weighted
from draw_rates import check_most
from weighed import named_sets

from tire_pipeline.mismatch import explain_mismatch

OTHER = 100
"""Seeds of sweeps at other angles are so much larger."""


def _errors(report, file, recording):
    """RMS error of each force before and after, N."""
    inputs = recording.drop(columns=["fx", "fy"])
    plain = file.forces(**{n: inputs[n].to_numpy() for n in ("slip_angle", "slip_ratio", "normal_load")})
    after = report.corrected.predict(inputs)
    return [(_rms(recording[o] - getattr(plain, o)), _rms(recording[o] - after[o])) for o in after]


def _rms(x):
    return float(np.sqrt(np.mean(np.square(x))))


@pytest.mark.long
@pytest.mark.parametrize("angles", [(0.0, 4.0), (-3.0, 5.0)])
def test_at_two_slip_angles_combined_slip_is_named_and_other_angles_come_out_better(braked, angles):
    def right(seed):
        report = explain_mismatch(braked, brake_sweeps(weighted(braked), angles, seed))
        elsewhere = brake_sweeps(weighted(braked), (2.0, 6.0), seed + OTHER)
        named = [names for names, _ in report.sets] == [("combined_slip",)]
        return named and all(after < 0.5 * before for before, after in _errors(report, braked, elsewhere))

    check_most(right, f"at {angles} deg")


@pytest.mark.long
@pytest.mark.parametrize("missing", [[], ["tread_temperature"], ["fx"], ["fy"]], ids=str)
def test_at_one_slip_angle_the_only_set_holds_combined_slip(braked, missing):
    def right(seed):
        sets = named_sets(braked, brake_sweeps(weighted(braked), (4.0,), seed).drop(columns=missing))
        return len(sets) == 1 and "combined_slip" in sets[0]

    check_most(right, f"without {missing}")


@pytest.mark.long
def test_a_weighting_that_is_a_gain_at_one_slip_angle_is_named_with_the_gain(braked):
    """Its share of Fx hardly changes with slip ratio here, which 0.5% of the evidence must not decide."""

    def right(seed):
        sets = named_sets(braked, brake_sweeps(weighted(braked, rbx2=0.8), (4.0,), seed).drop(columns="fy"))
        return len(sets) == 1 and sets[0] >= {"combined_slip", "force_gain"}

    check_most(right, "a gain")
