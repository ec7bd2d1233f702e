"""Base classes of the effects that can explain a difference between a recording and its tire model."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.context import Context, Simulate

Array = np.ndarray
Parameters = Mapping[str, float]
TOO_SMALL_TO_SEE = 1e-9
"""A size that is too small to be seen. In a start it marks a parameter as free to be fitted."""
_OF_UNIFORM = 12.0**-0.5
"""Standard deviation of a uniform distribution over its width."""
_MEASURES: dict[str, Callable[[Context], float]] = {
    "": lambda data: 1.0,
    "load_nominal": lambda data: data.nominal.load,
    "radius": lambda data: data.nominal.radius,
    "sampling": lambda data: data.sampling,
}
"""Quantities of a recording that a prior may be a multiple of, in the parameter's unit."""


@dataclass(frozen=True)
class Parameter:
    """One parameter of an effect: the effect is absent at ``zero``.

    Parameters
    ----------
    name, unit : str
    low, high : float
        Physical bounds.
    step : float
        A change that is small against what matters, for finite differences.
    zero : float
        The value at which the parameter does nothing.
    output : str, optional
        ``"fx"`` or ``"fy"`` if it acts on one output alone.
    ratio : bool
        Whether a fit multiplies it by a factor, of at most e in one step, instead of adding to it.
    further : bool
        Whether it only refines the effect of the other parameters.
    form : bool
        Whether it sets the form of the effect, not its size: a reference, a lag, a moment.
    prior : float
        Standard deviation about ``zero`` if the effect is present; with 0 every value between the bounds is
        equally likely.
    prior_in : str
        What of the recording (``load_nominal``, ``radius``, ``sampling``) the prior is a multiple of; nothing
        if it is in the parameter's own unit.
    """

    name: str
    unit: str
    low: float
    high: float
    step: float
    zero: float = 0.0
    output: str | None = None
    ratio: bool = False
    further: bool = False
    form: bool = False
    prior: float = 0.0
    prior_in: str = ""

    @property
    def one_sided(self) -> bool:
        """Whether ``zero``, where the effect is absent, is its lower bound."""
        return self.low == self.zero


@dataclass
class State:
    """Intermediate values of a simulation, from channels to forces; effects change them in place.

    Similarity (Pacejka, Tire and Vehicle Dynamics, 3rd ed., section 4.2): a tire whose friction is m
    times and whose slip stiffness is k times the model's gives ``m F(slip k / m)``; effects add to
    the logarithms of m and k. ``load_apart`` (N) is by how much the loads of two wheels differ from their
    mean, whose forces are the mean of both. ``pressure`` (Pa) is None where the model does not ask for it.
    """

    slip_angle: Array
    slip_ratio: Array
    camber: Array
    normal_load: Array
    log_friction: Array
    log_friction_y: Array
    log_stiffness: Array
    log_stiffness_y: Array
    coefficients: dict[str, float] = field(default_factory=dict)
    turn_slip: Array | None = None
    added_y: Array | float = 0.0
    load_apart: Array | None = None
    pressure: Array | None = None
    forces: dict[str, Array] = field(default_factory=dict)


@dataclass(frozen=True)
class Finding:
    """An artefact that is found without a fit: its channel, how certain it is, and the repair.

    Parameters
    ----------
    name, channel, text : str
    parameters : dict
        ``{name: (value, standard error, unit)}``.
    repaired : dict of ndarray
        Channels that replace the recorded ones.
    bad : ndarray of bool, optional
        Samples that cannot be repaired.
    evidence : float
        Between 0 and 1.
    span : (start, end), optional
        s, if it does not last the whole recording.
    alike : tuple of tuple of str
        Other sets of channels in which the same fault would look alike.
    axes : bool
        Whether the recording may have other axes than those it was read in.
    limits : tuple of float, optional
        Lowest and highest value that the channel can have, infinite where it has no limit.
    """

    name: str
    channel: str
    text: str
    parameters: dict[str, tuple[float, float, str]]
    repaired: dict[str, Array] = field(default_factory=dict)
    bad: Array | None = None
    evidence: float = 0.98
    span: tuple[float, float] | None = None
    alike: tuple[tuple[str, ...], ...] = ()
    axes: bool = False
    limits: tuple[float, float] | None = None


class Effect:
    """One effect; a subclass a file. Class attributes describe it, the methods apply it.

    Attributes
    ----------
    name, kind : str
        ``kind`` is ``"physics"`` or ``"artefact"``.
    title : str
        Plain words for the report.
    equation, source : str
    channels : tuple of str
        Channels that have to be there and vary.
    used : tuple of str
        Channels that have to be there, but need not vary.
    family : str
        Effects of one family occur in every recording to a small extent, of about the same size.
    prior_source : str
        Where the priors of its parameters come from.
    needs_time : bool
    dynamic : bool
        True if it lags or shifts in time; half a sample of that can come from the sampling of the rig.
    needed : tuple of str
        Parameters of which at least one is always kept: without any of them it is another effect.
    scanned : tuple of str
        Parameters that the starts scan, so that the screen need not move them.
    stepped : tuple of str
        Moments (s) among them that a fit moves by trial, since the force jumps there.
    constant : str
        Parameter by which it changes friction or stiffness by a constant factor, if it does.
    wrong_channel : str
        Channel of the slips, camber or load that reads wrong, if that is all it does: :meth:`misread`.
    instead_of_file : bool
        True if it takes the place of the relaxation that the file itself states.
    found_in : str
        ``"samples"`` if :meth:`detect` finds samples that no repair brings back, ``"factors"`` if it finds
        wrong signs and units, nothing if the effect is fitted.
    in_one_stretch : bool
        True if the samples that it spoils follow each other.
    parameters : tuple of Parameter
    looks_like : dict
        Name of another effect -> what tells them apart.
    told_by : dict
        Name of another effect -> the channel that has to vary to tell them apart, if it is one channel.
    experiment : str
        What to record to be sure of it.
    """

    name = ""
    kind = "physics"
    title = ""
    equation = ""
    source = ""
    channels: tuple[str, ...] = ()
    used: tuple[str, ...] = ()
    family = ""
    prior_source = ""
    needs_time = False
    dynamic = False
    needed: tuple[str, ...] = ()
    scanned: tuple[str, ...] = ()
    stepped: tuple[str, ...] = ()
    constant = ""
    wrong_channel = ""
    instead_of_file = False
    found_in = ""
    in_one_stretch = False
    parameters: tuple[Parameter, ...] = ()
    looks_like: Mapping[str, str] = {}
    told_by: Mapping[str, str] = {}
    experiment = ""
    order = 50

    @property
    def by_clock(self) -> bool:
        """Whether its state follows the clock alone: no channel, and no work."""
        return self.family == "slow" and self.needs_time and not self.used

    def absent(self, data: Context) -> str | None:
        """Return why the effect cannot be tested in this recording, or None if it can."""
        if self.needs_time and data.time is None:
            return "the recording has no time"
        for name in self.channels:
            if not data.varies(name):
                return f"{name} {'does not vary' if data.has(name) else 'is not recorded'}"
        for name in self.used:
            if not data.has(name):
                return f"{name} is not recorded"
        return None

    def lacking(self, data: Context) -> list[str]:
        """Return the channels (and ``time``) without which the effect cannot be put into a recording."""
        lost = [n for n in (*self.channels, *self.used) if n not in data.channels]
        return [*lost, "time"] if self.needs_time and data.time is None else lost

    def parameter(self, name: str) -> Parameter:
        """Return the parameter of a name."""
        return next(p for p in self.parameters if p.name == name)

    def usual(self, data: Context, name: str) -> tuple[float, float]:
        """Return centre and standard deviation of a parameter's prior in a recording.

        Where the parameter states none (``prior`` 0) every value between its bounds, or between the ends of
        the recording for a moment in time, is as likely: the centre is NaN.
        """
        p = self.parameter(name)
        stated = data.stated_prior(self.name, name)
        if stated is not None:
            return self.zeros(data)[name], stated
        if p.prior:
            return self.zeros(data)[name], p.prior * _MEASURES[p.prior_in](data)
        width, time = p.high - p.low, data.time
        if p.unit == "s" and time is not None:
            width = min(width, float(time[-1] - time[0]))
        return float("nan"), width * _OF_UNIFORM

    def outside(self, data: Context, p: Parameters) -> bool:
        """Whether parameters are outside of what this recording can show; bounds are checked besides."""
        return False

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Return the parameter values to start from: one dict for each form worth trying."""
        return [self.zeros(data)]

    def expected(self, data: Context) -> bool:
        """Whether physics requires it: its driver varied, and the file has no term for it."""
        return False

    def same_to_data(self, data: Context, p: Parameters) -> tuple[str, str] | None:
        """Return what is the same to the data at some parameters and has no name, in words, and its kind.

        None by default. Kinds are those of effects: "physics" or "artefact".
        """
        return None

    def drivers(self, output: str) -> tuple[str, ...]:
        """Return the channels whose values decide how large it is in a force; none if time does."""
        return () if self.needs_time else self.channels

    def blind(self, data: Context) -> bool:
        """Whether its state is integrated because its channel is not recorded."""
        return False

    def other_forms(self, data: Context, p: Parameters) -> list[dict[str, float]]:
        """Return other parameters between which and the found ones the truth may lie; none by default."""
        return []

    def quarter_turn(self, p: Parameters) -> dict[str, float] | None:
        """Return the parameters of the same effect a quarter of a wheel turn on, if it follows the wheel."""
        return None

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Change what the tire sees (slips, camber, load)."""

    def misread(self, true: Array, p: Parameters) -> Array:
        """Return what its ``wrong_channel`` reads where the value is ``true``; plus ``offset`` by default."""
        return true + p["offset"]

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Change the tire (friction, stiffness, coefficients)."""

    def outputs(self, state: State, data: Context, p: Parameters) -> None:
        """Change the forces that are recorded."""

    def moments(self, state: State, data: Context, p: Parameters) -> None:
        """Change the moments that are recorded, which then stand in ``state.forces``; nothing by default."""

    def detect(self, channels: Mapping[str, Array], simulate: Simulate) -> list[Finding]:
        """Look for the effect without a fit (artefacts that are exact); nothing by default.

        Parameters
        ----------
        channels : mapping of ndarray
            The recording's channels.
        simulate : callable
            ``simulate(channels) -> {"fx": ..., "fy": ...}``: the model on changed channels.
        """
        return []

    def coefficients(self, tire: TireModel, p: Parameters) -> dict[str, float]:
        """Return the ``.tir`` coefficients that hold the effect, or nothing if the format has no place."""
        return {}

    def zeros(self, data: Context) -> dict[str, float]:
        """Return the parameter values at which the effect is absent."""
        return {p.name: p.zero for p in self.parameters}

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Return the names of the parameters that float in the form that begins at ``start``."""
        return tuple(p.name for p in self.parameters)
