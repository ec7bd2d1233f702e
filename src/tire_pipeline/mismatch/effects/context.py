"""The interface through which an effect sees a recording; ``model.data.Data`` implements it.

All arrays have shape (n,), one value a sample, SI. Effects do not import the model: any object with these
members works.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Set
from typing import Protocol

import numpy as np

Array = np.ndarray
Simulate = Callable[[Mapping[str, Array]], Mapping[str, Array]]
"""The model on changed channels: ``simulate(channels) -> {"fx": ..., "fy": ...}``, N."""


class OfModel(Protocol):
    """What the tire model refers to."""

    @property
    def coefficients(self) -> Mapping[str, float]:
        """Coefficients of the file."""

    @property
    def load(self) -> float:
        """Nominal load, N."""

    @property
    def load_range(self) -> tuple[float, float]:
        """Least and largest load that the file holds for, N; infinite where it states no range."""

    @property
    def radius(self) -> float:
        """Unloaded radius, m."""

    @property
    def pressure(self) -> float:
        """Pressure at which the model is right, Pa."""

    @property
    def pressure_levels(self) -> list[float]:
        """Pressures at which it may be right, Pa."""

    @property
    def off_pressure(self) -> bool:
        """Whether the recording stays at another pressure than the file's."""

    @property
    def off_camber(self) -> bool:
        """Whether the camber stays at one that is not zero and not within the file's range."""

    @property
    def speed_excess(self) -> Array:
        """``(v - v0) / v0``, v0 the speed at which the model is right."""

    @property
    def knows_camber(self) -> bool:
        """Whether the lateral force answers to camber."""

    @property
    def knows_pressure(self) -> bool:
        """Whether the forces answer to the inflation pressure."""

    def load_excess(self, load: Array, right_at: float = 1.0) -> Array:
        """Return ``Fz / Fz0 - right_at``, faded outside of the loads that were explained."""


class OfSimulation(Protocol):
    """What the model gives at the recorded points, before any effect."""

    @property
    def shift_by_thrust(self) -> Array:
        """Slip angle for a side force as large as the load, rad."""

    @property
    def slope_share(self) -> Array:
        """|dFy / d slip angle| over the cornering stiffness at nominal load, at most 2."""

    @property
    def slope_share_x(self) -> Array:
        """|dFx / d slip ratio| over the slip stiffness at nominal load, at most 2."""

    def driven(self, output: str) -> bool:
        """Whether ``"fx"`` or ``"fy"`` is recorded and moved by the slips."""

    def turned_by_force(self, slip_angle: Array, steer: float, steer_by_fx: float = 0.0) -> Array:
        """Return the slip angle (rad) less ``steer Fy + steer_by_fx Fx``, both in rad/N."""


class OfStates(Protocol):
    """What builds up along the time line, from the model's own forces."""

    @property
    def time_span(self) -> float:
        """Duration of the recording that was explained, s."""

    @property
    def elapsed(self) -> Array:
        """Time so far over that duration."""

    @property
    def power(self) -> Array | None:
        """Friction power, W; None without time or speed."""

    @property
    def work(self) -> Array:
        """Friction work so far over all of it."""

    def heat(self, lag: float) -> Array:
        """Return the friction power followed with a lag (s) of first order, over the largest power."""


class OfWheel(Protocol):
    """How the wheel turns."""

    @property
    def way(self) -> Array:
        """Distance that it rolled, m; NaN where it is unknown."""

    @property
    def turns_resolved(self) -> bool:
        """Whether there are at least three samples a turn."""

    def rolling_radius(self, wobbling: tuple[str, ...] = ()) -> float:
        """Return the radius (m) at which the residual has most power once a turn.

        ``wobbling``: channels that the force then follows by its slope; none for a force of its own.
        """


class Context(Protocol):
    """A recording beside its tire model, as effects see it."""

    @property
    def nominal(self) -> OfModel:
        """What the tire model refers to."""

    @property
    def simulation(self) -> OfSimulation:
        """What the model gives without any effect."""

    @property
    def states(self) -> OfStates:
        """What builds up along the time line."""

    @property
    def wheel(self) -> OfWheel:
        """How the wheel turns."""

    @property
    def channels(self) -> Mapping[str, Array]:
        """Channels by name: slip_angle rad, slip_ratio, camber rad, normal_load N, speed m/s ..."""

    @property
    def measured(self) -> Set[str]:
        """Channels that were recorded where the effect was found."""

    @property
    def outputs(self) -> tuple[str, ...]:
        """Forces that were recorded: ``"fx"``, ``"fy"``."""

    @property
    def time(self) -> Array | None:
        """Time, s, rising; None for steady points."""

    @property
    def time_line(self) -> Array:
        """The same for an effect that needs time."""

    @property
    def start(self) -> Array:
        """Whether a sample is the first of an uninterrupted piece, bool."""

    @property
    def step(self) -> Array:
        """Time step that ends at each sample, s; zero without time."""

    @property
    def sampling(self) -> float:
        """Time from one sample to the next, s."""

    @property
    def has_combined(self) -> bool:
        """Whether both slips are large together somewhere."""

    def has(self, name: str) -> bool:
        """Whether a channel is recorded."""

    def varies(self, name: str) -> bool:
        """Whether a channel is recorded and varies by more than its sensor's noise."""

    def get(self, name: str) -> Array:
        """Return a channel."""

    def smooth(self, name: str) -> Array:
        """Return a slow channel without its sensor noise."""

    def stated_prior(self, effect: str, parameter: str) -> float | None:
        """Return the standard deviation that the user states for a prior, in the parameter's unit."""
