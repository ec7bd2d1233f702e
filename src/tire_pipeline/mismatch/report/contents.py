"""The contents of a mismatch report, before it is drawn or written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from tire_pipeline.mismatch.corrected.model import CorrectedModel
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.amounts import amount_with_interval
from tire_pipeline.mismatch.proof.locate import Located
from tire_pipeline.mismatch.proof.measured import OutputFit, Remainder, Visible
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedReport
from tire_pipeline.pages.first_letter import first_large
from tire_pipeline.progress import under_way
from tire_pipeline.tasks import one_thread

VERDICTS = (
    "agrees",
    "undecided",
    "explained",
    "ambiguous",
    "partly explained",
    "unexplained",
    "unusable",
    "another tire",
)


@dataclass(frozen=True)
class Head:
    """The first sentences of a report.

    Parameters
    ----------
    causes : str
        What was found; a sentence without its full stop, or a clause after the verdict.
    spot : str
        Where recording and simulation differ; a clause, "" if that is not informative.
    size : str
        How much, before and after; a clause, "" where nothing was corrected.
    todo : str
        What to do next; a sentence, "" where nothing is to be done.
    notes : tuple of str
        What a reader must know beside it, the most important first; each in sentences.
    equation : str
        What is known about the unexplained residual, in sentences; "" if nothing is.
    verdict : str
        Stands before the causes; "" where they are a sentence by themselves.
    question : Question, optional
        An open question, which comes first in place of the verdict.
    """

    causes: str
    spot: str = ""
    size: str = ""
    todo: str = ""
    notes: tuple[str, ...] = ()
    equation: str = ""
    verdict: str = ""
    question: Question | None = None

    @property
    def remarks(self) -> tuple[str, ...]:
        """Everything that stands beside the three sentences."""
        return (*self.notes, *filter(None, [self.equation]))

    @property
    def text(self) -> str:
        """The three sentences: verdict and names; where and how much; what to do next."""
        first = ": ".join(filter(None, [self.verdict, self.causes]))
        if self.question is not None:
            first = self.question.beside(self.causes)
        middle = "; ".join(filter(None, [self.spot, self.size]))
        sentences = [f"{first_large(part)}." for part in (first, middle) if part]
        return " ".join(filter(None, [*sentences, self.todo]))

    def beside(self, *notes: str) -> Head:
        """Return the head with notes before its own; empty ones are none."""
        return replace(self, notes=(*filter(None, notes), *self.notes))


@dataclass(frozen=True)
class EffectReport:
    """One effect that was found.

    Parameters
    ----------
    name, kind : str
        ``kind`` is ``"physics"`` or ``"artefact"``.
    title : str
        The name in words.
    alternatives : tuple of str
        Names that the data cannot exclude.
    confidence : float
        Posterior probability that the cause is the name or one of its alternatives.
    output : str
        Force in which it is largest.
    where : dict
        Channel -> (low, high), SI: holds the central 90% of its energy.
    when : list of (start, end)
        s; its RMS over 1 s is above the noise floor.
    share : float
        Share of the held-out mismatch that it removes.
    equation, source : str
        What the effect does to the tire or its recording, and where that is published.
    parameters : dict
        Name -> (value, standard error, unit).
    evidence : dict
        ``log_evidence``: how much the best set with it has above the best one without.
    intervals : dict
        Name of a parameter -> (low, high): its 95% interval within the parameter's bounds.
    undetermined : tuple of str
        Parameters of which the recording says less than what tires usually have (their priors).
    same_to_data : tuple of (words, kind)
        What is the same to the data and has no name of its own: a fault of the recording, or physics.

    See Also
    --------
    MismatchReport : Holds them, largest first, and gives names with confidence as ``sets``.

    Notes
    -----
    Confidence, parameters and their errors are of the posterior over sets of effects:
    docs/explanation/mismatch.md. What each effect does: the catalogue in the reference.

    Examples
    --------
    A rig on which the tire has 10% less cornering stiffness than its file says:

    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.mismatch import explain_mismatch
    >>> from tire_pipeline.tir import read_tir
    >>> tire = read_tir("tire.tir")
    >>> slip_angle = np.tile(np.linspace(-0.15, 0.15, 100), 2)
    >>> rig = pd.DataFrame({"slip_angle": slip_angle, "normal_load": np.repeat([3000.0, 5000.0], 100)})
    >>> rig["fy"] = tire.replace(LKY=0.9).forces(slip_angle=slip_angle, normal_load=rig["normal_load"]).fy
    >>> rig["fy"] += np.random.default_rng(0).normal(0.0, 20.0, len(rig))
    >>> effect = explain_mismatch(tire, rig).effects[0]
    >>> "stiffness_scale" in (effect.name, *effect.alternatives), effect.output
    (True, 'fy')
    """

    name: str
    kind: str
    title: str
    alternatives: tuple[str, ...]
    confidence: float
    output: str
    where: dict[str, tuple[float, float]]
    when: list[tuple[float, float]]
    share: float
    equation: str
    source: str
    parameters: dict[str, tuple[float, float, str]]
    evidence: dict[str, float | str] = field(default_factory=dict)
    intervals: dict[str, tuple[float, float]] = field(default_factory=dict)
    undetermined: tuple[str, ...] = ()
    same_to_data: tuple[tuple[str, str], ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """The name and its alternatives: one of them is the cause."""
        return (self.name, *self.alternatives)

    def rows(self) -> list[tuple[str, str, str, str]]:
        """Return each parameter's value, its 95% interval, and whether it may have no effect.

        Returns
        -------
        list of (str, str, str, str)
            Name, value, interval, and what is uncertain about it.
        """
        return [(n.replace("_", " "), *self._sizes(n), self._not_determined(n)) for n in self.parameters]

    def _sizes(self, name: str) -> tuple[str, str]:
        value, error, unit = self.parameters[name]
        return amount_with_interval(value, error, self.intervals.get(name, (value, value)), unit)

    def _not_determined(self, name: str) -> str:
        if name in self.undetermined:
            return "not determined by this recording"
        low, high = self.intervals.get(name, (np.nan, np.nan))
        zero = catalogue()[self.name].parameter(name).zero if low < high else np.nan
        return f"may be {zero:g}" if low <= zero <= high else ""

    def __repr__(self) -> str:
        sizes = ", ".join(f"{name} {' ('.join(self._sizes(name))})" for name in self.parameters)
        instead = f", or {' or '.join(self.alternatives)}" if self.alternatives else ""
        named = f"{self.name}{instead}, confidence {self.confidence:.2g}"
        return f"EffectReport({named}: {sizes or 'no parameters'})"


@dataclass(frozen=True)
class PredictionError:
    """Errors of one output in a recording that no fit has seen, N or N m.

    Parameters
    ----------
    rms_before, rms_after : float
        Of the model as it was, and with what was found.
    ratio_low, ratio_high : float
        95% interval of ``rms_after / rms_before`` by resampling stretches of the recording.
    """

    rms_before: float
    rms_after: float
    ratio_low: float
    ratio_high: float


@dataclass(frozen=True)
class HeldOutFit:
    """How the explained model predicts one recording: one that was held out, or one of several explained.

    Parameters
    ----------
    recording : str
        Its name.
    samples : int
        How many had numbers in all channels.
    errors : dict of str to PredictionError
        By output.

    See Also
    --------
    explain_recordings : Holds one of several recordings out.
    OutputFit : Errors on sweeps of the recordings that were explained.

    Notes
    -----
    A held-out recording takes no part in choosing or fitting. Only what a whole rig shares, such as the
    unit of a channel, is taken from the others. ``report.each`` holds the recordings that did take part.

    Examples
    --------
    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.mismatch import explain_recordings
    >>> from tire_pipeline.tir import read_tir
    >>> tire = read_tir("tire.tir")
    >>> slip_angle = np.tile(np.linspace(-0.15, 0.15, 100), 2)
    >>> rig = pd.DataFrame({"slip_angle": slip_angle, "normal_load": np.repeat([3000.0, 5000.0], 100)})
    >>> rig["fy"] = tire.replace(LKY=0.9).forces(slip_angle=slip_angle, normal_load=rig["normal_load"]).fy
    >>> rig["fy"] += np.random.default_rng(0).normal(0.0, 20.0, len(rig))
    >>> again = rig.assign(fy=rig["fy"] + np.random.default_rng(1).normal(0.0, 20.0, len(rig)))
    >>> report = explain_recordings(tire, {"first": rig, "second": again}, held_out="second")
    >>> error = report.held_out.errors["fy"]
    >>> report.held_out.recording, error.rms_after < error.rms_before
    ('second', True)
    """

    recording: str
    samples: int
    errors: dict[str, PredictionError]


@dataclass(repr=False)
class ReportContents:
    """The fields of :class:`~tire_pipeline.mismatch.MismatchReport`, which says what each is."""

    verdict: str
    effects: list[EffectReport]
    fit: dict[str, OutputFit]
    next_experiment: str
    corrected: CorrectedModel
    head: Head
    located: list[Located]
    remainder: Remainder
    notes: list[str]
    candidates: list[dict[str, Any]]
    series: dict[str, Any] = field(default_factory=dict, repr=False)
    recordings: tuple[str, ...] = ()
    held_out: HeldOutFit | None = None
    each: tuple[HeldOutFit, ...] = ()
    assumed: list[str] = field(default_factory=list)
    find_visible: Callable[[], list[Visible]] = field(default=list, repr=False, compare=False)
    unnamed: UnnamedReport = field(
        default_factory=partial(UnnamedReport, None, "it was not looked for", looked_for=False)
    )
    withheld: tuple[str, ...] = ()
    probabilities: list[tuple[tuple[str, ...], float]] = field(default_factory=list)

    @property
    def visible(self) -> list[Visible]:
        """How large each effect would have had to be to be seen; weighed when it is first asked for."""
        with one_thread(), under_way("weighing what could have been seen"):
            found = self.find_visible()
        self.find_visible = partial(list, found)  # its inputs are no longer needed
        return found

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "find_visible": partial(list, self.visible)}

    @property
    def stated_verdict(self) -> str:
        """The verdict, and what is open where what was found rests on it: axes, or that recordings differ."""
        question = self.corrected.question
        return self.verdict if question is None or question.verdict else f"{self.verdict}, {question.short}"

    @property
    def summary(self) -> str:
        """Verdict and names, where and how much, and what to do next, in three sentences."""
        return self.head.text
