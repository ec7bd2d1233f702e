"""What goes with time or turns with the wheel, after the recording that was explained: one clock."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from tire_pipeline.mismatch.corrected.wheel_phase import WheelWay
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.states import States, followed_from_cold

Array = np.ndarray


def goes_with_time(change: Change, data: Data) -> bool:
    """Whether an effect's state follows the clock or accumulated work, and no channel that was recorded."""
    effect = catalogue()[change[0]]
    return effect.family == "slow" and data.measured.isdisjoint(effect.drivers(""))


def turns(change: Change) -> bool:
    """Whether an effect comes back once a turn: where the wheel stands is known as long as it rolls on."""
    return catalogue()[change[0]].quarter_turn(change[1]) is not None


def _goes_on(change: Change, data: Data) -> bool:
    """Whether an effect is added in part after the recording that was explained."""
    return goes_with_time(change, data) or turns(change)


def going_on(
    data: Data, changes: Sequence[Change], rolled: WheelWay | None, confirmed: Callable[[list[int]], float]
) -> GoingOn | None:
    """Return how effects go on after a recording; None if none of them goes with time or turns.

    Parameters
    ----------
    data : Data
        All of the recording that was explained.
    changes : sequence of (name, parameters)
    rolled : WheelWay, optional
        Whose times are those of the recorded rows.
    confirmed : callable
        Which of the effects go with time or turn, by number -> the part that is added.
    """
    own = [i for i, change in enumerate(changes) if _goes_on(change, data)]
    if not own or rolled is None:
        return None
    return GoingOn(rolled, data.time_line, data.step, data.states.power, confirmed(own))


@dataclass(frozen=True)
class GoingOn:
    """How what goes with time, or turns, goes on from the recording that was explained.

    Parameters
    ----------
    rolled : WheelWay
        Its samples, as they were recorded.
    time, step : ndarray, shape (n,)
        Of the samples that were weighed, s.
    power : ndarray, shape (n,), optional
        Friction power there, W; None if it is not known.
    part : float
        Part of the change that is added after it, as far as earlier sweeps predicted later ones
        (:func:`.corrected.later_sweeps.confirmed_later`).
    """

    rolled: WheelWay
    time: Array
    step: Array
    power: Array | None
    part: float

    def put_into(self, data: Data) -> Data:
        """Return a recording to predict with states that go by the clock of the one that was explained."""
        if data.states.power is None or self.power is None or self.another_session(data):
            return data
        return replace(data, states=_StatesGoingOn(data.simulation, self))

    def another_session(self, data: Data) -> bool:
        """Whether a recording begins after a pause that is longer than any in the one that was explained.

        Nobody knows then whether the tire was changed. It counts as new and cold: that changes less.
        """
        return data.time is not None and float(data.time[0]) > self.rolled.last + self.rolled.longest_pause

    def another_clock(self, data: Data) -> bool:
        """Whether a recording has samples while the one that was explained was running, and none of its own.

        Then both clocks were set to zero, and nothing says what came first.
        """
        if data.time is None or data.wheel.known_way is None or np.isfinite(data.wheel.known_way).any():
            return False
        return bool(self.rolled.running(data.time).any())

    def after(self, data: Data) -> Array:
        """Return which samples are after the recording that was explained, bool, shape (n,)."""
        return np.zeros(data.size, bool) if data.time is None else data.time > self.rolled.last

    def added(
        self, data: Data, changes: Sequence[Change], add: Callable[[Sequence[Change]], dict[str, Array]]
    ) -> dict[str, Array]:
        """Return forces with effects that ``add`` adds in full; after it those of time and turns in part.

        What follows the clock alone is left out where that is another one: a drift may be there from its
        begin, or begin anew, or be gone.
        """
        if self.another_clock(data):
            return add([change for change in changes if not catalogue()[change[0]].by_clock])
        whole, after = add(changes), self.after(data)
        lasting = [change for change in changes if not _goes_on(change, data)]
        if len(lasting) == len(changes) or not after.any():
            return whole
        rest, part = add(lasting), np.where(after, self.part, 1.0)
        return {name: rest[name] + part * (force - rest[name]) for name, force in whole.items()}

    def note(self, data: Data, changes: Sequence[Change]) -> list[str]:
        """Say what is added after the recording that was explained, if there is anything."""
        if self.another_clock(data):
            return [
                f"{catalogue()[change[0]].title}: left out; it goes by the clock of the recording that was "
                "explained, and this one has a clock of its own"
                for change in changes
                if catalogue()[change[0]].by_clock
            ]
        after = self.after(data)
        known = after if data.wheel.known_way is None else after & np.isfinite(data.wheel.known_way)
        anew = "; wear and heat begin anew, after a longer pause" if self.another_session(data) else ""
        return [
            *self._added_there(
                [change for change in changes if goes_with_time(change, data)],
                after,
                "nothing goes further there than it was at the end, and ",
                anew,
            ),
            *self._added_there([change for change in changes if turns(change)], known),
        ]

    def _added_there(
        self, changes: Sequence[Change], after: Array, so: str = "", anew: str = ""
    ) -> list[str]:
        """Say which part of some effects is added after the recording that was explained."""
        if not changes or not after.any():
            return []
        titles = " and ".join(catalogue()[name].title for name, _ in changes)
        return [
            f"{titles}: {np.mean(after):.1%} of the samples are after the recording that was explained; {so}"
            f"{self.part:.0%} of the change is added, as far as earlier sweeps predicted later ones{anew}"
        ]


@dataclass(frozen=True, eq=False)
class _StatesGoingOn(States):
    """States that begin where the recording that was explained had them at this time, and end where it ended.

    A recording that follows it does not begin with a new tire while drifts and surfaces stay at their end.
    Nobody has seen what more work or more heat would do.
    """

    so_far: GoingOn

    @cached_property
    def _earlier(self) -> Array:
        """Samples of the explained recording before this one begins, bool."""
        return self.so_far.time < self._recording.time_line[0]

    @property
    def _power_before(self) -> Array:
        assert self.so_far.power is not None
        return self.so_far.power[self._earlier]

    @cached_property
    def work(self) -> Array:
        """Friction work so far over all of the explained recording, at most 1."""
        done = np.sum(self._power_before * self.so_far.step[self._earlier])
        own = np.cumsum(self._known_power * self._recording.step)
        return np.minimum((done + own) / self.scales.work, 1.0)

    def heat(self, lag: float) -> Array:
        """Return the heat as :meth:`States.heat`, at most what it was in the explained recording."""
        before, step = self._power_before, self._recording.step.copy()
        if before.size:
            step[0] = self._recording.time_line[0] - self.so_far.time[self._earlier][-1]
        own = followed_from_cold(
            np.concatenate([before, self._known_power]),
            np.concatenate([self.so_far.step[self._earlier], step]),
            lag,
        )[before.size :]
        assert self.so_far.power is not None
        most = float(followed_from_cold(self.so_far.power, self.so_far.step, lag).max())
        return np.minimum(own, most) * np.hypot(1.0, lag / self.scales.time_span) / self.scales.power
