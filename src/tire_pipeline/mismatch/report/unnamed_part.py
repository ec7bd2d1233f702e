"""What has no name in a report: equations of the forces and of the aligning moment, put into the model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from tire_pipeline.channels import ALIGNING_MOMENT
from tire_pipeline.magic_formula.fitting.report.verdict import MOST_LEFT
from tire_pipeline.mismatch.corrected.as_recorded import never_worse
from tire_pipeline.mismatch.corrected.model import CorrectedModel
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.model.channels import ENOUGH_ROWS, largest
from tire_pipeline.mismatch.model.forces import simulate_moments
from tire_pipeline.mismatch.model.residual import partly, rms
from tire_pipeline.mismatch.proof.measured import OutputFit
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedReport
from tire_pipeline.mismatch.unnamed_physics.language.symbols import table_of
from tire_pipeline.mismatch.unnamed_physics.problems.aligning_moment import problem_of_moment
from tire_pipeline.mismatch.unnamed_physics.search import (
    more_than_usual,
    unnamed_moment,
    unnamed_physics,
)
from tire_pipeline.progress import under_way

Array = np.ndarray
_SOMETHING_LEFT = ("unexplained", "partly explained")
_SETTLE_FIRST = "none was looked for, because the recording has to be settled first"
_AS_USUAL = "none was looked for, because the named effects leave no more than a fitted formula usually does"
_ENDS_HERE = "an equation of the clock or the way rolled ends with its recording, and settles nothing"


@dataclass(frozen=True)
class MomentError:
    """How far the model's aligning moment is off.

    Parameters
    ----------
    before, after, mirrored : float
        RMS error of the moment as it was recorded, with what was found in the forces, and with the other sign
        beside what was repaired, N m.
    largest : float
        Largest moment of the model, N m.
    noise : float
        N m; NaN where it is not known.
    """

    before: float
    after: float
    mirrored: float
    largest: float
    noise: float

    @property
    def far_off(self) -> bool:
        """Whether it is as far off as a fit that counts as failed; calspan's leaves 7%."""
        return self._far_off(self.before)

    @property
    def stays_far_off(self) -> bool:
        """Whether it is as far off with what was found in the forces."""
        return self.far_off and self._far_off(self.after)

    @property
    def other_sign(self) -> bool:
        """Whether the other sign leaves less than half of the error that stays."""
        return self.stays_far_off and 2.0 * self.mirrored < min(self.before, self.after)

    def _far_off(self, error: float) -> bool:
        above = error**2 - np.nan_to_num(self.noise) ** 2
        return bool(above > (MOST_LEFT * self.largest) ** 2)


def moment_error(analysis: Analysis, fit: Mapping[str, OutputFit]) -> MomentError | None:
    """Return the error of the aligning moment, or None where it was not recorded or the model has none."""
    if ALIGNING_MOMENT not in fit:
        return None
    data = analysis.data
    simulated = simulate_moments(data, [], (ALIGNING_MOMENT,))[ALIGNING_MOMENT]
    recorded = data.channels[ALIGNING_MOMENT]
    own = fit[ALIGNING_MOMENT]
    mirrored = rms(recorded + simulated)
    return MomentError(own.rms_before, own.rms_after, mirrored, largest(simulated), own.noise_floor)


def only_moment(moment: MomentError, found: UnnamedReport) -> bool:
    """Whether the aligning moment differs and no force does.

    Parameters
    ----------
    moment : MomentError
    found : UnnamedReport
        With the equations that are in the model.
    """
    equations = {} if found.physics is None else found.physics.equations
    return moment.far_off if not equations else set(equations) == {ALIGNING_MOMENT}


def put_in_equations(
    analysis: Analysis,
    verdict: str,
    model: CorrectedModel,
    recording: pd.DataFrame,
    moment: MomentError | None,
    *,
    named: bool,
    stopped: bool,
    equation: UnnamedReport | None,
) -> tuple[UnnamedReport, CorrectedModel]:
    """Look for equations of what is left, and put in those that hold on unseen sweeps.

    The odds of an unnamed part do not decide whether it is looked for: they say that a misfit could absorb
    it, not that it is one. Sweeps that an equation has not seen tell the two apart.

    Parameters
    ----------
    analysis : Analysis
    verdict : str
        On the forces.
    model : CorrectedModel
        With the named effects.
    recording : pandas.DataFrame
        As it came.
    moment : MomentError, optional
    named, stopped : bool
        Whether effects are named, and whether the recording has to be settled first.
    equation : UnnamedReport, optional
        One of the forces that was found instead of names.
    """
    if stopped:
        return UnnamedReport(None, _SETTLE_FIRST, looked_for=False), model
    plainly = verdict not in (*_SOMETHING_LEFT, "undecided")
    found = UnnamedReport(None, _AS_USUAL, looked_for=False)
    with under_way("looking for an equation of the residual"):
        if not (named and plainly and not more_than_usual(analysis)):
            found = equation or unnamed_physics(analysis, plainly=plainly)
        of_moment = None if moment is None else _equation_of_moment(analysis, model, moment)
    if verdict == "undecided" and found.physics is not None and found.physics.of_one_recording:
        found = found.refused(_ENDS_HERE)
    found, put_in = never_worse(found, model, recording)
    if plainly and found.physics is None:
        found = replace(found, alternatives=[])  # of an equation that nothing asked for
    if of_moment is None or of_moment.physics is None:
        return found, put_in
    of_moment, with_moment = never_worse(of_moment, model, recording)
    both = found.joined(of_moment)
    if found.physics is None:
        return both, with_moment
    return both, replace(put_in, unnamed=both.physics, unnamed_later=both.later)


def _equation_of_moment(
    analysis: Analysis, model: CorrectedModel, moment: MomentError
) -> UnnamedReport | None:
    """Look for an equation of the aligning moment; None if its sign is asked for, or its error is usual."""
    if moment.other_sign:
        return None
    problem = problem_of_moment(analysis, model.changes, as_filed=ALIGNING_MOMENT in model.as_filed)
    return None if problem is None else unnamed_moment(problem, plainly=not moment.far_off)


def moment_series(
    analysis: Analysis, model: CorrectedModel, moment: MomentError | None
) -> dict[str, Array | float]:
    """Return the page's arrays of the aligning moment, N m, where it differs.

    Parameters
    ----------
    analysis : Analysis
    model : CorrectedModel
        With what was found.
    moment : MomentError, optional
    """
    equation = model.unnamed if model.unnamed is not None and model.unnamed.of_moment else None
    if moment is None or (equation is None and not moment.far_off):
        return {}
    data, name = analysis.data, ALIGNING_MOMENT
    changes = () if name in model.as_filed else model.changes
    first, last = (simulate_moments(data, each, (name,))[name] for each in ((), changes))
    added: Array | float = 0.0
    if equation is not None:
        added = equation.change(table_of(data, model.changes, equation.nominal, (name,))[0])[name]
    recorded, step = data.channels[name], max(1, data.size // ENOUGH_ROWS)
    after = recorded - partly(first, last, model.part) - added
    noise = float(np.nan_to_num(moment.noise))
    return {
        f"before_{name}": (recorded - first)[::step],
        f"after_{name}": after[::step],
        f"floor_{name}": noise,
    }
