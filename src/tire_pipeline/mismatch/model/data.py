"""The prepared recording: its channels, the model's forces, and the states along it."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass, field, replace

import numpy as np

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.model.channels import RecordedChannels
from tire_pipeline.mismatch.model.nominal import NominalConditions, Reference
from tire_pipeline.mismatch.model.simulated import BaseSimulation
from tire_pipeline.mismatch.model.states import States, StatesOfPart
from tire_pipeline.mismatch.model.wheel import Wheel

Array = np.ndarray


@dataclass(frozen=True)
class Choices:
    """Choices of the user that replace those of the effects.

    Parameters
    ----------
    priors : mapping of str to mapping of str to float
        Effect -> parameter -> standard deviation of its prior, in the parameter's unit.
    """

    priors: Mapping[str, Mapping[str, float]] = field(default_factory=dict)


NO_CHOICES = Choices()
NO_REFERENCE = Reference()


@dataclass(frozen=True, eq=False)
class Data:
    """A recording (or a part of it) beside its tire model: values that are built one from the other.

    What is recorded is asked of it directly, all else of the value that holds it.

    Parameters
    ----------
    recording : RecordedChannels
    nominal : NominalConditions
    simulation : BaseSimulation
    states : States or StatesOfPart
    wheel : Wheel
    choices : Choices
    """

    recording: RecordedChannels
    nominal: NominalConditions
    simulation: BaseSimulation
    states: States | StatesOfPart
    wheel: Wheel
    choices: Choices = NO_CHOICES

    @classmethod
    def of(
        cls,
        tire: TireModel,
        recording: RecordedChannels,
        *,
        beside: Mapping[str, Array] | None = None,
        own_relaxation: Mapping[str, float] | None = None,
        reference: Reference = NO_REFERENCE,
        way: Array | None = None,
        choices: Choices = NO_CHOICES,
    ) -> Data:
        """Return a whole recording beside its tire model.

        Parameters
        ----------
        tire : TireModel
        recording : RecordedChannels
        beside, own_relaxation
            As for :class:`.BaseSimulation`.
        reference : Reference
            Of the recording that was explained, if it is another one.
        way : ndarray, shape (n,), optional
            As ``known_way`` of :class:`.Wheel`.
        choices : Choices
        """
        nominal = NominalConditions(tire, recording, reference)
        simulation = BaseSimulation(nominal, beside, own_relaxation)
        return cls(recording, nominal, simulation, States(simulation), Wheel(simulation, way), choices)

    def part(self, rows: Array) -> Data:
        """Return the rows of ``rows`` (bool), what is integrated or nominal taken over from all of them."""
        recording, known = self.recording.part(rows), self.nominal
        reference = replace(
            known.reference,
            scales=self.states.scales,
            pressure_nominal=known.pressure if self.has("pressure") else None,
            speed_nominal=known.speed if self.has("speed") else None,
        )
        nominal = NominalConditions(self.tire, recording, reference)
        beside = self.simulation.beside
        simulation = BaseSimulation(
            nominal,
            None if beside is None else {n: x[rows] for n, x in beside.items()},
            self.simulation.own_relaxation,
        )
        way = None if self.states.power is None else self.wheel.way[rows]
        states = StatesOfPart(self.states, rows)
        return Data(recording, nominal, simulation, states, Wheel(simulation, way), self.choices)

    @property
    def tire(self) -> TireModel:
        """The model."""
        return self.nominal.tire

    @property
    def measured(self) -> Set[str]:
        """Channels that were recorded where effects were found: here, or in the recording explained."""
        known = self.nominal.reference.measured
        return self.present if known is None else known

    @property
    def followed_relaxation(self) -> dict[str, float]:
        """Relaxation lengths of the file by which the slips that vary are lagged, m."""
        own = self.simulation.own_relaxation or {}
        return {slip: length for slip, length in own.items() if self.varies(slip)}

    def stated_prior(self, effect: str, parameter: str) -> float | None:
        """Return the standard deviation that a user states for a parameter's prior, in its unit."""
        stated = self.choices.priors.get(effect, {}).get(parameter)
        return None if stated is None else float(stated)

    @property
    def channels(self) -> Mapping[str, Array]:
        """Channels, SI."""
        return self.recording.channels

    @property
    def recorded(self) -> Mapping[str, Array]:
        """fx and or fy, N."""
        return self.recording.recorded

    @property
    def present(self) -> Set[str]:
        """Channels that the recording really has."""
        return self.recording.present

    @property
    def time(self) -> Array | None:
        """Time, s."""
        return self.recording.time

    @property
    def time_line(self) -> Array:
        """The time, s, where only a recording with time is asked."""
        return self.recording.time_line

    @property
    def start(self) -> Array:
        """First samples of uninterrupted pieces."""
        return self.recording.start

    @property
    def step(self) -> Array:
        """Time step that ends at each sample, s."""
        return self.recording.step

    @property
    def sampling(self) -> float:
        """Time from one sample to the next, s."""
        return self.recording.sampling

    @property
    def size(self) -> int:
        """Number of samples."""
        return self.recording.size

    @property
    def outputs(self) -> tuple[str, ...]:
        """Forces that are recorded."""
        return self.recording.outputs

    @property
    def has_combined(self) -> bool:
        """Whether both slips are large together in at least 1% of the samples."""
        return self.recording.has_combined

    def get(self, name: str) -> Array:
        """Return one channel."""
        return self.recording.get(name)

    def has(self, name: str) -> bool:
        """Whether the recording has the channel."""
        return self.recording.has(name)

    def varies(self, name: str) -> bool:
        """Whether the channel is recorded and varies by more than a sensor's noise."""
        return self.recording.varies(name)

    def smooth(self, name: str) -> Array:
        """Return a slow channel without its sensor noise."""
        return self.recording.smooth(name)

    def running_mean(self, x: Array, seconds: float) -> Array:
        """Return the mean over so many seconds around each sample, within its piece."""
        return self.recording.running_mean(x, seconds)
