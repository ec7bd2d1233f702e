"""Whether the file is of the recorded tire. If several of its basic figures are off at once, it is not."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy

from tire_pipeline.channels import SLIP_AND_LOAD, SLIP_OF_FORCE
from tire_pipeline.mismatch.effects.shared import INDEPENDENT_STRETCHES, beyond_known
from tire_pipeline.mismatch.model.channels import ENOUGH_ROWS, least_spread, moves
from tire_pipeline.mismatch.model.nominal import loads_of_file
from tire_pipeline.mismatch.model.plain_forces import plain_forces, slip_at_peak
from tire_pipeline.mismatch.model.simulated import DIFFERENCE
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.mismatch.recording.usable import LEAST, Drive, drives

Array = np.ndarray

FIGURES = (
    "peak friction",
    "fall of friction with load",
    "slip stiffness",
    "change of stiffness with load",
    "curvature",
)
_LOADED = (1, 3)
"""Figures that say how the others change with load."""

TOLERANCE = (0.05, 0.05, 0.10, 0.10, 0.25)
"""How far a figure may be off in a recording of the file's own tire, in logarithms (load slopes: per change
of load by its median). What fits and rigs leave: in simulated cases where nothing is missing at most two of a
force's five are off by more, and setting them right removes 0.3 of the mismatch at most."""

_ERRORS_OFF = 3.0
"""Standard errors by which it must be off."""

SEVERAL = 3
LEAST_OFF = 2
LEAST_REMOVED = 0.5
"""Several figures are off, and with them right at least half of the mismatch is gone. Then the report asks if
this is the file of this tire, unless a set of effects answers that. If a few are off, another tire is one
effect among others: friction and stiffness alone may be a state of the same tire."""

RECORDED_STATES = ("pressure", "tread_temperature")
"""Channels by which friction and stiffness of the same tire change. What they explain is no other tire's."""

_LARGEST_FIGURE = 2.0

SPREAD_OF_TIRES = (0.2, 0.2, 0.4, 0.4, 0.4)
"""How far the basic figures of two tires are apart, in logarithms (standard deviation): friction by a fifth,
stiffness and curvature by half."""
SIZES_OF_TIRES = (1.0, 0.25, 0.5, 2.0, 4.0)
"""Load ratings over that of the file which are tried: forces over the rating are alike at loads over it."""
_SPREAD_OF_CAMBER = (0.5, 0.5, 5.0, 1.0)
"""The same of the camber thrust, over load and camber, of its change per change of the load by its median,
and of what camber takes off friction (per rad^2: PDY3) and off stiffness (per rad)."""
_SPREAD_OF_SIDES = 0.01
"""The same of conicity, over load, and of ply steer, rad."""


@dataclass(frozen=True)
class Figures:
    """How far the basic figures of one force are off.

    Parameters
    ----------
    output : str
    values, errors : ndarray, shape (5,)
        Logarithms of true over file's, in the order of ``FIGURES`` (curvature: of the effective slip in the
        bend); NaN where the recording does not determine them.
    left : float
        Squared mismatch that is left with them.
    without : callable
        Gives the same with the recorded states alone; that takes another fit.
    known : ndarray of bool, shape (5,)
        Which of them the file can know: from one load it does not know how the others change with load.
    """

    output: str
    values: Array
    errors: Array
    left: float
    without: Callable[[], float]
    known: Array

    @cached_property
    def removed(self) -> float:
        """Share of the squared mismatch that is gone with them, of what the recorded states leave."""
        return 1.0 - self.left / max(self.without(), 1e-300)

    @property
    def off(self) -> Array:
        """Which figures are off, bool."""
        size = np.abs(np.nan_to_num(self.values))
        return (
            self.known
            & (size > np.array(TOLERANCE))
            & (size > _ERRORS_OFF * np.nan_to_num(self.errors, nan=np.inf))
        )

    def another(self, least: int) -> bool:
        """Whether this force says that it is another tire, of which so many figures are off."""
        return bool(self.off.sum() >= least and self.removed > LEAST_REMOVED)

    @property
    def in_words(self) -> str:
        """The figures that are off, in words."""
        parts = []
        for i in np.flatnonzero(self.off):
            per = " (from the median load to twice that)" if i in _LOADED else ""
            name = "cornering stiffness" if (i, self.output) == (2, "fy") else FIGURES[i]
            parts.append(f"{name} {100.0 * np.expm1(self.values[i]):+.0f}%{per}")
        return f"{self.output.capitalize()}: {', '.join(parts)}"


def another_tire(tire: Any, arrays: Mapping[str, Array], counted: list[Drive]) -> Question | None:
    """Return the question whether this is the file of this tire, if its basic figures are off in every force.

    They have to be off whether or not friction and stiffness may follow the recorded states: what these do
    to the tire is not known, and where one of the two accounts needs no other tire, it may be this one. Sets
    of effects answer the question, too: one or two effects may put several figures off.

    Parameters
    ----------
    tire : TireModel
    arrays : mapping of ndarray, shape (n,)
        Channels, SI, without holes, signs and units repaired.
    counted : list of Drive
        Forces that their slip drives.
    """
    outputs = [d.output for d in counted if d.varies and d.works]
    found = _all_off(tire, arrays, outputs)
    if not found or _met_beside(tire, arrays, outputs):
        return None
    likely, found = all(f.another(SEVERAL) for f in found), found[: len(outputs)]
    said = "; ".join(f.in_words for f in found)
    gone = min(f.removed for f in found)
    return Question(
        "this seems not to be the file of this tire, or not of its state (pressure, rim), or the recorded "
        f"normal load is wrong: several properties differ from the file at once ({said}). Together they "
        f"explain {100.0 * gone:.0f}% of the squared difference",
        "compare the name of the file, the size and the inflation pressure with what was on the rig, check "
        "the load cell (zero without load, a known weight), or fit a model to this recording (tire fit, or "
        "fit_magic_formula in Python)",
        "another tire",
        by_sets=True,
        likely=likely,
    )


def _all_off(tire: Any, arrays: Mapping[str, Array], outputs: list[str]) -> list[Figures]:
    """Return the figures of each force beside the recorded states, then without; none if one is not off."""
    found: list[Figures] = []
    for states in (RECORDED_STATES, ()):
        for output in outputs:
            found.append(figures(tire, arrays, output, states))
            if not found[-1].another(LEAST_OFF):  # a fit takes long, and no other one changes the answer
                return []
    return found


def _met_beside(tire: Any, arrays: Mapping[str, Array], outputs: list[str]) -> bool:
    """Tell whether the model meets another recorded force, whose slip does not vary, as it is.

    In brake sweeps at one slip angle the side force is such a one. Another tire's would be off, too, so that
    other figures remove most of it.
    """
    others = [d.output for d in drives(tire, arrays, None) if d.output not in outputs and d.plain >= LEAST]
    return any(figures(tire, arrays, output).removed <= LEAST_REMOVED for output in others)


def figures(
    tire: Any, arrays: Mapping[str, Array], output: str, states: tuple[str, ...] = RECORDED_STATES
) -> Figures:
    """Fit the basic figures of one force by similarity, and an offset of the force.

    ``F = m F_file(slip k / m exp(c w))`` with ``log m`` and ``log k`` linear in load and in each recorded
    state that varies, and w between 0 (small slip) and 1 (full sliding): Pacejka, Tire and Vehicle Dynamics,
    3rd ed., section 4.2, with a bend. A camber that was not recorded may have any value, the same throughout.
    A tread that warms in each sweep bends the curve as another tire does;
    beside its temperature the bend is not known. Standard errors are by the scatter over stretches of rows.

    Parameters
    ----------
    tire : TireModel
    arrays : mapping of ndarray, shape (n,)
        As for :func:`another_tire`.
    output : str
        The force.
    states : tuple of str
        Channels that friction and stiffness may follow.
    """
    step = max(1, arrays["normal_load"].size // ENOUGH_ROWS)
    a = {n: arrays[n][::step] for n in (*SLIP_AND_LOAD, *states, output) if n in arrays}
    model = _Similar(tire, a, output)
    free, recorded, count = model.free, a[output], len(FIGURES)
    p, left, columns = _fit(model, recorded, np.flatnonzero(free))
    beside = np.arange(free.size) >= count

    def without() -> float:
        states = beside.any()
        rest = _fit(model, recorded, np.flatnonzero(beside))[1] if states else recorded - model(0.0 * p)
        return float(rest @ rest)

    inverse = np.linalg.pinv(columns.T @ columns, rcond=1e-12)
    stretch = np.arange(recorded.size) * INDEPENDENT_STRETCHES // recorded.size
    score = np.array([np.bincount(stretch, c * left, INDEPENDENT_STRETCHES) for c in columns.T])
    errors, values = np.full(free.size, np.nan), np.where(free, p, np.nan)
    errors[free] = np.sqrt(np.maximum(np.diag(inverse @ (score @ score.T) @ inverse), 0.0))[:-1]
    known = np.ones(count, bool)
    known[list(_LOADED)] = not beyond_known(a["normal_load"], loads_of_file(tire))
    return Figures(output, values[:count], errors[:count], float(left @ left), without, known)


def of_another_tire(
    tire: Any, arrays: Mapping[str, Array], recorded: Mapping[str, Array]
) -> dict[str, Array]:
    """Return what another tire changes of each force, N, and what is left with the likeliest figures.

    Its basic figures and its size, and of the side force the camber thrust and what its two sides differ in.

    Parameters
    ----------
    tire : TireModel
    arrays : mapping of ndarray, shape (n,)
        Input channels, SI.
    recorded : mapping of ndarray, shape (n,)
        Forces, N.

    Returns
    -------
    dict of ndarray, shape (n, m + 1)
        For each force, what each property changes where it is off by its spread among tires, of all forces;
        last the residual, linear about the file's own.
    """
    apart = {n: x for n, x in arrays.items() if n not in RECORDED_STATES}
    found = {}
    for output, force in recorded.items():
        tried = [_likeliest(_Similar(tire, apart, output, size), force) for size in SIZES_OF_TIRES]
        found[output] = min(tried, key=lambda each: each[2])[:2]
    none = {output: np.zeros_like(own) for output, (own, _) in found.items()}
    return {
        output: np.column_stack([*(own if o == output else none[o] for o, (own, _) in found.items()), rest])
        for output, (_, rest) in found.items()
    }


def _likeliest(model: _Similar, force: Array) -> tuple[Array, Array, float]:
    """Return what other properties of a tire change of one force, and what is left, linear about its own."""
    count = len(FIGURES)
    p, left, _ = _fit(model, force, np.flatnonzero(model.free))
    here = model(p)
    slopes = [(model(p + step) - here) / DIFFERENCE for step in DIFFERENCE * np.eye(p.size)[:count]]
    rest = force - here + p[:count] @ np.array(slopes)
    columns = [spread * slope for spread, slope in zip(SPREAD_OF_TIRES, slopes, strict=True)]
    if model.output == "fy":
        load, camber = model.points["normal_load"], model.points["camber"]
        moved = {**model.points, model.slip: model.points[model.slip] + _SPREAD_OF_SIDES}
        steered = plain_forces(model.tire, **moved)["fy"] - plain_forces(model.tire, **model.points)["fy"]
        thrust, friction, stiffness = load * camber, slopes[0] * camber**2, slopes[2] * np.abs(camber)
        of_camber = (thrust, thrust * model.excess, friction, stiffness)
        columns += [spread * x for spread, x in zip(_SPREAD_OF_CAMBER, of_camber, strict=True)]
        columns += [_SPREAD_OF_SIDES * load, steered]
    return np.column_stack(columns), rest, float(left @ left)


class _Similar:
    """The file's force with other basic figures, at the recorded points."""

    def __init__(self, tire: Any, a: Mapping[str, Array], output: str, size: float = 1.0) -> None:
        self.tire, self.output, self.slip, self.size = tire, output, SLIP_OF_FORCE[output], size
        zero = np.zeros(a["normal_load"].size)
        self.points = {n: a.get(n, zero) for n in SLIP_AND_LOAD}
        load = self.points["normal_load"]
        middle = float(np.median(load))
        self.excess = (load - middle) / middle
        self.loaded = moves(load, least_spread("normal_load", load))
        varying = {
            n: x - x.mean() for n, x in a.items() if n in RECORDED_STATES and moves(x, least_spread(n, x))
        }
        self.states = np.array([x / x.std() for x in varying.values()]).reshape(-1, load.size)
        self.of_states = 2 * len(varying)
        self.camber_unknown = "camber" not in a
        self.beside = self.of_states + int(self.camber_unknown)
        used = np.abs(self.points[self.slip]) / slip_at_peak(tire, output, load / size)
        self.bend = used / (1.0 + used)
        self.free = np.array([True, self.loaded, True, self.loaded, True, *[True] * self.beside])

    def __call__(self, p: Array) -> Array:
        """Return the force with figures off by ``p``."""
        count = len(FIGURES)
        of_friction, of_stiffness = p[count : count + self.of_states].reshape(2, -1)
        friction, by_load, stiffness, stiffness_by_load, curvature = p[:count]
        m = friction + by_load * self.excess + of_friction @ self.states
        k = stiffness + stiffness_by_load * self.excess + of_stiffness @ self.states
        slip = self.points[self.slip] * np.exp(k - m + curvature * self.bend)
        points = {**self.points, self.slip: slip, "normal_load": self.points["normal_load"] / self.size}
        if self.camber_unknown:
            points["camber"] = np.full(slip.size, p[-1])
        return self.size * np.exp(m) * plain_forces(self.tire, **points)[self.output]


def _fit(model: _Similar, recorded: Array, free: Array) -> tuple[Array, Array, Array]:
    """Least squares; return parameters, the residual, and its derivatives by these and by an offset."""

    def left(some: Array) -> Array:
        p = np.zeros(len(FIGURES) + model.beside)
        p[free] = some
        rest = recorded - model(p)
        return np.asarray(rest - rest.mean())

    found = scipy.optimize.least_squares(
        left, np.zeros(free.size), bounds=(-_LARGEST_FIGURE, _LARGEST_FIGURE), x_scale="jac"
    )
    p = np.zeros(len(FIGURES) + model.beside)
    p[free] = found.x
    return p, found.fun, np.column_stack([-found.jac, np.ones(recorded.size)])
