"""The model with the missing physics added."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import INPUT_CHANNELS, SLIP_AND_LOAD
from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.corrected.agreed import agreed
from tire_pipeline.mismatch.corrected.going_on import GoingOn
from tire_pipeline.mismatch.corrected.holes import around_holes
from tire_pipeline.mismatch.corrected.put_in_equation import put_equation
from tire_pipeline.mismatch.corrected.tir_file import comments, with_coefficients
from tire_pipeline.mismatch.corrected.wheel_phase import WheelWay
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.base import Finding
from tire_pipeline.mismatch.effects.shared import own_relaxation
from tire_pipeline.mismatch.model.channels import RecordedChannels
from tire_pipeline.mismatch.model.data import NO_REFERENCE, Data
from tire_pipeline.mismatch.model.forces import Change, simulate, simulate_moments
from tire_pipeline.mismatch.model.nominal import Reference
from tire_pipeline.mismatch.model.plain_forces import plain_forces
from tire_pipeline.mismatch.model.residual import error_over_forces, partly, rms
from tire_pipeline.mismatch.recording.given import numeric
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.mismatch.recording.prepare import ASSUMED_ZERO
from tire_pipeline.mismatch.recording.smoothing import denoise
from tire_pipeline.mismatch.recording.time_line import beginnings
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedPhysics

Array = np.ndarray


@dataclass(frozen=True)
class CorrectedModel:
    """A tire model and the effects that it left out.

    Parameters
    ----------
    tire : TireModel
        The model as it came; None where it stands in for another simulator.
    changes : tuple of (name, parameters)
        Effects of the catalogue, with their parameters in SI, in the order they are added.
    outputs : tuple of str
        Forces that were recorded.
    reference : Reference
        Of the recording that was explained: nominal pressure and speed, loads, what work, heat and time are
        measured by, and which channels were recorded. What it lacks is found in the recording to predict.
    stands_in : bool
        True if the tire model only stands in for another simulator, whose output a recording to
        predict must have as ``simulated_fy``.
    moments : tuple of str
        Moments that were recorded and that the tire model gives.
    as_filed : tuple of str
        Those of the moments that effects do not change: they would make them worse.
    factors : dict of str to float
        Channel -> what repairs its sign and unit: true = factor times recorded.
    limits : dict of str to (low, high)
        Force -> the range in which it is recorded, as recorded.
    question : Question, optional
        A question to settle before a file may be written from it.
    cleaned : dict of str to float
        Input channel that is cleaned of sensor noise before the effects are added -> RMS of that noise, SI.
        In the recording that was explained alone, whose forces show that it is noise.
    unnamed : UnnamedPhysics, optional
        An equation of unnamed physics, put in last.
    unnamed_later : float
        Part of it that is added after the recording that was explained, if it goes with the way rolled.
    instead : tuple of (odds, changes)
        Other explanations that the recording cannot tell from ``changes``, and how likely they are beside
        these: ``predict`` adds what they agree on (:func:`.agreed`).
    part : float
        Share of the effects' change that is added, as far as unseen sweeps confirm it
        (:func:`.proof.never_worse.confirmed_part`).
    rolled : WheelWay, optional
        Angle of the wheel, if an effect follows it.
    going_on : GoingOn, optional
        How effects go on after the recording that was explained, if one goes with time.

    See Also
    --------
    explain_mismatch : Finds what to add: ``report.corrected``.

    Notes
    -----
    Equations and sources of the effects: ``docs/reference/effects.md``. Forces in N, moments in N m, ISO W
    axes.

    Examples
    --------
    10% less stiffness at small slip, and the same friction:

    >>> import pandas as pd
    >>> from tire_pipeline.tir import read_tir
    >>> tire = read_tir("tire.tir")
    >>> changes = (("stiffness_scale", {"stiffness": -0.1, "lateral_stiffness": 0.0}),)
    >>> softer = CorrectedModel(tire, changes, outputs=("fy",))
    >>> run = pd.DataFrame({"slip_angle": [0.001, 0.3], "normal_load": 4000.0})
    >>> before = tire.forces(slip_angle=run["slip_angle"], normal_load=run["normal_load"]).fy
    >>> (softer.predict(run)["fy"] / before).round(1).tolist()
    [0.9, 1.0]
    """

    tire: Any
    changes: tuple[Change, ...]
    outputs: tuple[str, ...]
    reference: Reference = NO_REFERENCE
    stands_in: bool = False
    moments: tuple[str, ...] = ()
    as_filed: tuple[str, ...] = ()
    factors: Mapping[str, float] = field(default_factory=dict)
    limits: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    question: Question | None = None
    cleaned: Mapping[str, float] = field(default_factory=dict)
    unnamed: UnnamedPhysics | None = None
    unnamed_later: float = 1.0
    instead: tuple[tuple[float, tuple[Change, ...]], ...] = ()
    part: float = 1.0
    rolled: WheelWay | None = None
    going_on: GoingOn | None = None

    def __repr__(self) -> str:
        put_in = [name for name, _ in self.changes]
        put_in += ["an empirical equation of the residual"] if self.unnamed is not None else []
        return f"CorrectedModel({' and '.join(self.outputs)}, with {', '.join(put_in) or 'nothing added'})"

    @property
    def _changed(self) -> bool:
        """Whether anything is added."""
        return bool(self.changes) or self.unnamed is not None

    @property
    def as_it_came(self) -> CorrectedModel:
        """The model with nothing added and nothing repaired: ``predict`` gives ``tire.forces``."""
        return replace(
            self, changes=(), factors={}, limits={}, cleaned={}, unnamed=None, instead=(), part=1.0
        )

    def predict(self, recording: pd.DataFrame) -> pd.DataFrame:
        """Return the corrected forces at the samples of a recording.

        Parameters
        ----------
        recording : pandas.DataFrame
            Canonical columns, as the same rig records them; forces are not needed.

        Returns
        -------
        pandas.DataFrame
            ``fx``, ``fy`` in N and ``mx``, ``my``, ``mz`` in N m (those that were recorded when the
            model was corrected), index as the recording's. Artefacts are added, too, wrong signs and
            units and clipping as well: this is what would be recorded. Without effects and repairs it is
            what ``tire.forces`` gives at the rows as they are. Where several explanations are open, a force
            changes by what they agree on. ``attrs["notes"]`` says where physics without a name was outside of
            its range and faded, where the angle of the wheel is not known (what comes back once a turn is
            left out there), and what is after the recording that was explained: there causes that go with
            time stay at its end. Rows without a number in an input are NaN.

        Raises
        ------
        RecordingError
            If a channel is missing that the model or an effect needs.
        """
        return around_holes(numeric(recording), self._predicted)

    def _predicted(self, recording: pd.DataFrame) -> pd.DataFrame:
        data = self._data(recording)
        for name, _ in self.changes:
            for channel in catalogue()[name].lacking(data):
                raise RecordingError(
                    f"{name} needs the channel {channel}", where=channel, todo="add the column"
                )
        others = [
            (odds, changes)
            for odds, changes in self.instead
            if not any(catalogue()[name].lacking(data) for name, _ in changes)
        ]
        forces = self._simulated(data, self.changes)
        if others or self.part < 1.0:
            plain = self._simulated(data, ())
            each = [forces, *(self._simulated(data, changes) for _, changes in others)]
            whole = agreed(plain, each, [1.0, *(odds for odds, _ in others)]) if others else forces
            forces = {name: partly(start, whole[name], self.part) for name, start in plain.items()}
        going_on = [] if self.going_on is None else self.going_on.note(data, self.changes)
        notes = [*self._of_unknown_phase(data), *going_on, *self._put_equation(data, forces)]
        if len(others) < len(self.instead):
            notes.append("explanations that need a channel which is not recorded here are not counted")
        recorded = {name: force / self.factors.get(name, 1.0) for name, force in forces.items()}
        for name, (low, high) in self.limits.items():
            recorded[name] = np.clip(recorded[name], low, high)
        out = pd.DataFrame(recorded, index=recording.index)
        if notes:
            out.attrs["notes"] = notes
        return out

    def _simulated(self, data: Data, changes: Sequence[Change]) -> dict[str, Array]:
        """Return forces, N, and moments, N m, with effects added, as far as they go on."""
        add = partial(self._with, data)
        return add(changes) if self.going_on is None else self.going_on.added(data, changes, add)

    def _with(self, data: Data, changes: Sequence[Change]) -> dict[str, Array]:
        """Return forces, N, and moments, N m, with effects added in full."""
        forces = simulate(data, changes)
        moved = tuple(name for name in self.moments if name not in self.as_filed)
        for names, added in ((moved, changes), (self.as_filed, ())):
            forces |= simulate_moments(data, added, names) if names else {}
        return forces

    def _put_equation(self, data: Data, forces: dict[str, Array]) -> list[str]:
        """Add the unnamed equation to the forces, and say where it fades."""
        if self.unnamed is None:
            return []
        last = np.inf if self.rolled is None else self.rolled.last
        return put_equation(self.unnamed, data, self.changes, forces, last, self.unnamed_later)

    def _of_unknown_phase(self, data: Data) -> list[str]:
        """Say which effects are left out because the angle of the wheel is unknown."""
        if data.wheel.known_way is None:
            return []
        unknown = float(np.mean(np.isnan(data.wheel.known_way)))
        turning = [e.title for n, p in self.changes if (e := catalogue()[n]).quarter_turn(p) is not None]
        return [
            f"{title}: left out at {unknown:.1%} of the samples, which neither are of the recording that was "
            "explained nor follow it at once: the angle of the wheel is not known there"
            for title in turning
            if unknown
        ]

    def cleaned_where_it_helps(self, recording: pd.DataFrame) -> CorrectedModel:
        """Return the model, cleaned or not, whichever predicts the recording that was explained better.

        Parameters
        ----------
        recording : pandas.DataFrame
            That recording as it was recorded, SI.

        Returns
        -------
        CorrectedModel
            Without any cleaning if the recorded forces are predicted no better with it.
        """
        if not (self.cleaned and self._changed and "time" in recording):
            return self
        plain = replace(self, cleaned={})
        recorded = {o: recording[o] for o in self.outputs if o in recording}
        clean, raw = (error_over_forces(m.predict(recording), recorded) for m in (self, plain))
        return self if clean < raw else plain

    def limited_where_it_helps(self, recording: pd.DataFrame) -> CorrectedModel:
        """Return the model with the limits of those forces that are predicted no worse with them.

        Parameters
        ----------
        recording : pandas.DataFrame
            The recording that was explained, as it was recorded, SI.

        Returns
        -------
        CorrectedModel
            The same where no limit is left out.
        """
        if not self.limits:
            return self
        within, free = self.predict(recording), replace(self, limits={}).predict(recording)
        kept = {
            o: ends
            for o, ends in self.limits.items()
            if rms(recording[o] - within[o]) <= rms(recording[o] - free[o])
        }
        return replace(self, limits=kept)

    def _data(self, recording: pd.DataFrame) -> Data:
        n = len(recording)
        if "normal_load" not in recording:
            raise RecordingError("no normal_load to predict forces from", todo="add the column")
        channels = {
            str(c): recording[c].to_numpy(dtype=float, na_value=np.nan) * self.factors.get(str(c), 1.0)
            for c in recording.columns
            if c in INPUT_CHANNELS
        }
        time = recording["time"].to_numpy(dtype=float) if "time" in recording else None
        start = beginnings(time, n)
        for name in ASSUMED_ZERO:
            channels.setdefault(name, np.zeros(n))
        way = None
        if self.rolled is not None and time is not None:
            at = time, recording["normal_load"].to_numpy(dtype=float, na_value=np.nan)
            way = self.rolled.at(*at, channels.get("speed"))
            for name in self.cleaned if self._changed else {}:
                channels[name] = np.where(
                    self.rolled.own(*at), denoise(channels[name], start), channels[name]
                )
        beside = None
        if self.stands_in:
            needed = [f"simulated_{o}" for o in self.outputs]
            missing = [c for c in needed if c not in recording]
            if missing:
                raise RecordingError(
                    f"{', '.join(missing)} is needed: the model is another simulator's output",
                    todo="add the column",
                )
            own = plain_forces(self.tire, **{n: channels[n] for n in SLIP_AND_LOAD})
            beside = {o: recording[f"simulated_{o}"].to_numpy(dtype=float) - own[o] for o in self.outputs}
        recorded = RecordedChannels(
            channels=channels,
            recorded={o: np.zeros(n) for o in self.outputs},
            time=time,
            start=start,
            present={c for c in channels if c in recording.columns},
        )
        whole = Data.of(
            self.tire,
            recorded,
            beside=beside,
            own_relaxation=own_relaxation(self.tire) if self._changed and self.reference.relaxes else None,
            reference=self.reference,
            way=way,
        )
        return whole if self.going_on is None else self.going_on.put_into(whole)

    def tire_model(self) -> tuple[Any, dict[str, dict[str, object]]]:
        """Return the tire model with all effects that its format has a place for, and the rest.

        Returns
        -------
        tire : TireModel
        sidecar : dict
            Effect -> equation, parameters and reference values, for what a ``.tir`` cannot hold; and
            ``part``, by which its change of a force is multiplied, if that is not 1.
            Artefacts belong to the recording, not to the tire, and are in neither.
        """
        return with_coefficients(self.tire, self.changes, self.part, self.reference, self.unnamed)

    def to_tir(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write the corrected ``.tir`` file, and a sidecar for what the format has no place for.

        Parameters
        ----------
        path : path
        overwrite : bool

        Returns
        -------
        Path
            Of the ``.tir`` file.

        Raises
        ------
        RecordingError
            If a question is open on which all of it rests: ``question`` says which.
        """
        from tire_pipeline.tir import write_sidecar, write_tir
        from tire_pipeline.tir.format.values import COMPUTED_DIGITS

        if self.question is not None:
            raise RecordingError(
                f"nothing corrected is written: {self.question.why}", where=str(path), todo=self.question.todo
            )
        tire, sidecar = self.tire_model()
        others = [changes for _, changes in self.instead]
        said = comments(self.changes, self.part, others, sidecar)
        written = write_tir(tire, path, comments=said, overwrite=overwrite, digits=COMPUTED_DIGITS)
        if sidecar:
            write_sidecar(written, sidecar)
        return written


def force_limits(findings: Iterable[Finding], outputs: Iterable[str]) -> dict[str, tuple[float, float]]:
    """Return the range in which each clipped force is recorded, as recorded."""
    out = {}
    for finding in findings:
        if finding.limits is not None and finding.channel in outputs:
            out[finding.channel] = finding.limits
    return out
