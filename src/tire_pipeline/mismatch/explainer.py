"""The public interface of the method: explains a recording, with options for the user."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import pandas as pd

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.explain import prove, weigh
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes, learnt
from tire_pipeline.mismatch.inference.sets.answer import LEVEL
from tire_pipeline.mismatch.model.data import Choices
from tire_pipeline.mismatch.report.assemble import Explained
from tire_pipeline.mismatch.report.result import MismatchReport
from tire_pipeline.recordings.conventions.plausible import implausible_radii
from tire_pipeline.tasks import one_thread


@dataclass(frozen=True)
class Explainer:
    """Explains recordings, with options that a user may want to change.

    Parameters
    ----------
    without : collection of str
        Effects that are not looked for, as if the catalogue lacked them: their share of the difference then
        stays unexplained. Faults that are found from exact factors are found all the same.
    priors : mapping of str to mapping of str to float
        Effect -> parameter -> standard deviation of its prior, in the parameter's unit, in place of the one
        that the effect's file states.
    level : float
        Probability from which an effect, with its alternatives, is named.
    learnt : LearntSizes, optional
        Learnt sizes and odds of the posterior; those that ship with the package if left out.

    See Also
    --------
    explain_mismatch : The same with defaults.
    explain_recordings : Several recordings of one tire together.

    Notes
    -----
    The method is described in docs/explanation/mismatch.md; :meth:`explain` follows it step by step.

    Examples
    --------
    What a catalogue without the right effect says:

    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.mismatch import Explainer
    >>> from tire_pipeline.tir import read_tir
    >>> tire = read_tir("tire.tir")
    >>> slip_angle = np.tile(np.linspace(-0.15, 0.15, 100), 2)
    >>> rig = pd.DataFrame({"slip_angle": slip_angle, "normal_load": np.repeat([3000.0, 5000.0], 100)})
    >>> rig["fy"] = tire.replace(LKY=0.9).forces(slip_angle=slip_angle, normal_load=rig["normal_load"]).fy
    >>> rig["fy"] += np.random.default_rng(0).normal(0.0, 20.0, len(rig))
    >>> report = Explainer(without=["stiffness_scale"]).explain(tire, rig)
    >>> "stiffness_scale" in [name for names, _ in report.sets for name in names]
    False
    """

    without: Collection[str] = ()
    priors: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    level: float = LEVEL
    learnt: LearntSizes = field(default_factory=learnt)

    def explain(self, tire: Any, recording: pd.DataFrame) -> MismatchReport:
        """Explain one recording.

        Parameters
        ----------
        tire : TireModel or None
            The model; None if the recording has a column ``simulated_fy`` or ``simulated_fx``.
        recording : pandas.DataFrame
            Canonical columns in SI, as for :func:`explain_mismatch`.

        Returns
        -------
        MismatchReport
            Verdict, effects with their probabilities, errors before and after, and the corrected model.

        Raises
        ------
        RecordingError
            If the recording cannot be used, or the catalogue lacks an effect of ``without`` or ``priors``.
        """
        with one_thread():
            return prove(self.weigh(tire, recording))

    def weigh(self, tire: Any, recording: pd.DataFrame) -> Explained:
        """Return what a report is made of, without the proof on held-out sweeps.

        Parameters
        ----------
        tire : TireModel or None
            As for :meth:`explain`.
        recording : pandas.DataFrame
            As for :meth:`explain`.

        Returns
        -------
        Explained
            The prepared recording, its sets of effects, and their posterior.

        Raises
        ------
        RecordingError
            As :meth:`explain`.
        """
        self._check()
        return weigh(
            tire,
            recording,
            without=self.without,
            choices=Choices(self.priors),
            level=self.level,
            learnt=self.learnt,
        )

    def _check(self) -> None:
        known = set(catalogue())
        unknown = sorted({*self.without, *self.priors} - known)
        if unknown:
            raise RecordingError(
                f"the catalogue has no {', '.join(unknown)}", todo="name effects of the catalogue"
            )


def explain_mismatch(tire: Any, recording: pd.DataFrame, *, without: Collection[str] = ()) -> MismatchReport:
    """Say where a simulation and a recording differ, what the model left out, and prove it.

    Parameters
    ----------
    tire : TireModel or None
        The model. None if the recording has a column ``simulated_fy`` (or ``simulated_fx``), the
        output of another simulator.
    recording : pandas.DataFrame
        Canonical columns in SI: ``time`` s, ``slip_angle`` rad, ``slip_ratio``, ``camber`` rad,
        ``normal_load`` N, ``speed`` m/s, ``pressure`` Pa, ``tread_temperature`` degC, ``fx fy`` N.
        Without ``time`` the rows are steady points.
    without : collection of str
        Effects that are not looked for, as if the catalogue lacked them: their share of the difference then
        stays unexplained. For proofs; faults that are found from exact factors are found all the same.

    Returns
    -------
    MismatchReport
        Verdict, effects with their probabilities, errors before and after, and the corrected model.

    Raises
    ------
    RecordingError
        If the recording cannot be used; the message says why and what to do.

    See Also
    --------
    explain_recordings : Several recordings of one tire, one of them held out.
    tire_pipeline.recordings.read_recording : Reads a file into such a table.

    Notes
    -----
    Method and limits: ``docs/explanation/mismatch.md``. :class:`Explainer` has the options.

    Examples
    --------
    A rig on which the tire has 10% less cornering stiffness than its file says:

    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.tir import read_tir
    >>> tire = read_tir("tire.tir")
    >>> softer = tire.replace(LKY=0.9)
    >>> slip_angle = np.tile(np.linspace(-0.15, 0.15, 100), 2)
    >>> rig = pd.DataFrame({"slip_angle": slip_angle, "normal_load": np.repeat([3000.0, 5000.0], 100)})
    >>> rig["fy"] = softer.forces(slip_angle=rig["slip_angle"], normal_load=rig["normal_load"]).fy
    >>> rig["fy"] += np.random.default_rng(0).normal(0.0, 20.0, len(rig))
    >>> report = explain_mismatch(tire, rig)
    >>> "stiffness_scale" in report.sets[0][0], report.fit["fy"].rms_before > 5 * report.fit["fy"].rms_after
    (True, True)
    """
    report = Explainer(without=without).explain(tire, recording)
    return replace(report, notes=[*report.notes, *implausible_radii({"": recording})])
