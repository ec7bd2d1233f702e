"""A channel with the other sign: another axis system, a mirrored file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np

from tire_pipeline.channels import ALIGNING_MOMENT, SLIP_OF_FORCE
from tire_pipeline.mismatch.effects.base import Array, Effect, Finding
from tire_pipeline.mismatch.effects.context import Context, Simulate
from tire_pipeline.mismatch.effects.shared import INDEPENDENT_STRETCHES
from tire_pipeline.recordings.whole_rows import LEAST_POINTS

_CONVENTIONS = {"fy": ("slip_angle", "camber", "fy"), "fx": ("slip_ratio", "fx")}
"""Channels whose signs an axis system may turn, by the force that shows it."""

_SIGN_GAINS = (1.0 / 3.0, 3.0)
"""Whatever the signs, the force may be so much smaller or larger than the model's."""

_EXPLAINED = 0.85
_LEFT = 0.2
"""Where the signs that were given explain less of a force, the model may have the other sign everywhere. Then
turned ones must explain so much, and leave at most this part of the residual without."""

_FORM = 0.15
"""How wrong the form of the model's answer to a channel may be, as a part of it."""

_OF_FILE = 0.25
"""How far a file may be off in what turned signs change, over the misfit: fits of clean tires break the
mirror symmetry by 0.12 to 0.2 of it, and so do recordings. The file of another tire leaves more, and its
asymmetry says less."""

_AWAY = 0.1
"""Part of the mismatch that turned signs must take away: what is there by chance is small."""

_EVIDENCE_TO_TURN = 8.0
"""Log evidence by which turned signs must be likelier than those that were given."""

_NOT_TOLD_APART = 3.0
"""Log evidence within which two conventions cannot be told apart."""

_GAIN_OFF = 0.3
_OFFSET = 0.03
"""How far the force's gain, and its offset over the largest force, may be off where nothing else is wrong."""

_SLIP_OFF = 0.01
"""rad, or 1: how far a slip may be off. In a model with ply steer an offset looks much like turned axes."""

_STIFFNESS_OFF = 0.25
"""How far the slip stiffness may be off: tires of one size differ by a quarter (StiffnessScale)."""


class SignConvention(Effect):
    """A channel agrees with the model when its sign is turned.

    Covers signs that are wrong throughout; that of mz where fy's is. Not covered: axes exchanged, or turned
    by other angles than 180 deg.
    """

    name = "sign_convention"
    found_in = "factors"
    kind = "artefact"
    title = "a channel with the other sign"
    equation = "x recorded = -x"
    source = "SAE J670 and ISO 8855 axis systems"
    looks_like = {
        "crosstalk": "crosstalk needs the other force",
        "camber": "a camber that the model does not know has any size; one of the other sign the model's own",
    }
    experiment = "look at the axis system of the acquisition"

    def absent(self, data: Context) -> str | None:
        """Never a candidate of the fit: signs are tried before."""
        return "signs are tried before the fit"

    def detect(self, channels: Mapping[str, Array], simulate: Simulate) -> list[Finding]:
        """Try all axis conventions of each force; load must be positive."""
        found = []
        load = channels["normal_load"]
        if np.nanmedian(load) < 0.0:
            repaired = {"normal_load": -load}
            channels = {**channels, **repaired}
            found.append(_finding("normal_load", repaired))
        for force, names in _CONVENTIONS.items():
            if force not in channels:
                continue
            best, alike = convention(channels, simulate, force, [n for n in names if n in channels])
            if best:
                channels = {**channels, **{n: -channels[n] for n in best}}
                found.append(_finding(", ".join(best), {n: channels[n] for n in best}, alike))
        return found


def convention(
    channels: Mapping[str, Array], simulate: Simulate, force: str, names: list[str]
) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Return the channels that an axis convention has turned, and other sets that look the same.

    All sets of signs are tried. What the model says with each is compared with the recorded force, whatever
    its gain and offset. Signs under which the model has the other sign everywhere differ grossly. Others
    differ by a part of the force (a camber thrust to the other side): that part must be there with its own
    size, the model's, not with any size, which would be physics.

    Parameters
    ----------
    channels : mapping of ndarray, shape (n,)
    simulate : callable
        The model on given channels.
    force : str
        ``"fy"`` or ``"fx"``.
    names : list of str
        Channels that may be turned.

    Returns
    -------
    turned : tuple of str
        Empty if the signs are as they should be, or if nothing tells.
    alike : list of tuple of str
        Other sets that cannot be told from it.
    """
    sets = [s for k in range(len(names) + 1) for s in combinations(names, k)]
    turned = {s: _turned(channels, simulate, force, s) for s in sets}
    ok = np.isfinite(channels[force]) & np.all([np.isfinite(p) for p in turned.values()], axis=0)
    recorded, beside = channels[force][ok], _beside(channels, simulate, force, turned[()])[ok]
    turned = {s: p[ok] for s, p in turned.items()}
    if ok.sum() < LEAST_POINTS or float(np.var(recorded)) == 0.0:
        return (), []
    share = {s: _explained(recorded, p) for s, p in turned.items()}
    best = max(sets, key=lambda s: round(share[s], 6))  # the fewest turns of those that are the same
    base: tuple[str, ...] = ()
    if share[()] < _EXPLAINED:
        if share[best] < _EXPLAINED or 1.0 - share[best] > _LEFT * (1.0 - share[()]):
            return (), []
        base = best
    chosen = base
    scattered = recorded.size >= INDEPENDENT_STRETCHES
    away = {s for s in sets if scattered and 1.0 - share[s] < (1.0 - _AWAY) * (1.0 - share[base])}
    log_evidence = {
        s: _likelier(recorded, turned[base], turned[s], beside) for s in sets if s in away and share[s] > 0.5
    }
    if log_evidence and max(log_evidence.values()) > _EVIDENCE_TO_TURN:
        chosen = max(log_evidence, key=lambda s: round(log_evidence[s], 3))
    if not chosen:
        return (), []
    same = [s for s in sets if s and share[s] > 0.5 and _alike(recorded, turned[chosen], turned[s], beside)]
    left = {s: float(np.sum((recorded - turned[s]) ** 2)) for s in same}
    same.sort(key=lambda s: round(left[s] / max(min(left.values()), 1e-300), 2))  # fewest turns of equal ones
    return same[0], same[1:]


def turned(findings: Iterable[Finding]) -> list[Finding]:
    """Return what was turned; one finding for channels turned in several steps, where twice is as it was."""
    findings = list(findings)
    count = Counter(name for f in findings for name in f.channel.split(", "))
    if max(count.values(), default=0) <= 1:
        return findings
    names = [name for name, times in count.items() if times % 2]
    return [_finding(", ".join(names), {})] if names else []


def with_moment(finding: Finding) -> Finding:
    """Return a finding on signs with the aligning moment among the channels that have the other one."""
    turned_alike = [(*names, ALIGNING_MOMENT) for names in finding.alike]
    return _finding(f"{finding.channel}, {ALIGNING_MOMENT}", {}, turned_alike)


@dataclass(frozen=True)
class BesideSae:
    """A side force, and the model's for the given signs and in SAE J670e (slip angle and Fy turned).

    Parameters
    ----------
    recorded, given, sae : ndarray, shape (n,)
        N.
    beside : ndarray, shape (n, k)
        What may be there besides.
    stiffer : ndarray, shape (n,)
        What another slip stiffness changes.
    """

    recorded: Array
    given: Array
    sae: Array
    beside: Array
    stiffer: Array

    @cached_property
    def excluded(self) -> bool:
        """Whether the side force speaks against SAE axes, whatever the slip stiffness is.

        A tire of another stiffness than the file's leaves most at small slip, where camber and ply steer act.
        An offset of the slip takes a part of that, and the given axes seem to be the right ones.
        """
        accounts = (self.beside, np.column_stack([self.beside, self.stiffer]))
        return all(
            _likelier(self.recorded, self.given, self.sae, beside, sized=False) <= -_NOT_TOLD_APART
            for beside in accounts
        )

    @property
    def errors_if_better(self) -> tuple[float, float] | None:
        """RMS difference for the given signs and in SAE axes, N, where these agree better and may hold.

        What agrees better is not told by that: an offset of the slip angle looks like a ply steer to the
        other side.
        """
        left, turned_left = (1.0 - _explained(self.recorded, x) for x in (self.given, self.sae))
        if self.excluded or not turned_left < (1.0 - _AWAY) * left:
            return None
        given, sae = (float(np.sqrt(np.mean((self.recorded - x) ** 2))) for x in (self.given, self.sae))
        return (given, sae) if sae < given else None


def beside_sae(channels: Mapping[str, Array], simulate: Simulate) -> BesideSae | None:
    """Return a side force beside the model's in two axis systems; None for too few samples."""
    if "fy" not in channels or "slip_angle" not in channels:
        return None
    given, sae = (_turned(channels, simulate, "fy", s) for s in ((), tuple(sorted(_SAE))))
    ok = np.isfinite(channels["fy"]) & np.isfinite(given) & np.isfinite(sae)
    if ok.sum() < INDEPENDENT_STRETCHES:
        return None
    beside = _beside(channels, simulate, "fy", given)
    slip = channels["slip_angle"] * (1.0 + _STIFFNESS_OFF)
    stiffer = simulate({**channels, "slip_angle": slip})["fy"] - given
    return BesideSae(channels["fy"][ok], given[ok], sae[ok], beside[ok], stiffer[ok])


def excludes_sae(channels: Mapping[str, Array], simulate: Simulate) -> bool:
    """Whether the side force speaks against SAE J670e, for the given signs."""
    both = beside_sae(channels, simulate)
    return both is not None and both.excluded


def _beside(channels: Mapping[str, Array], simulate: Simulate, force: str, model: Array) -> Array:
    """What the model's force changes by where a sensor is off as far as sensors are, shape (n, 2).

    By an offset of the slip, and by a drift of the force. A drift puts an offset on some sweeps and not on
    others, which a camber thrust or a ply steer to the other side does, too.
    """
    slip, time = SLIP_OF_FORCE[force], channels.get("time")
    there = simulate({**channels, slip: channels[slip] + _SLIP_OFF})[force] if slip in channels else model
    span = 0.0 if time is None else float(np.ptp(time))
    so_far = np.zeros(model.size) if time is None or span == 0.0 else (time - time.min()) / span
    return np.column_stack([there - model, so_far * _OFFSET * float(np.nanmax(np.abs(model)))])


def _turned(channels: Mapping[str, Array], simulate: Simulate, force: str, names: tuple[str, ...]) -> Array:
    """The model's force with some channels turned, as it would be recorded."""
    out = simulate({**channels, **{n: -channels[n] for n in names if n != force}})[force]
    return -out if force in names else out


def _explained(recorded: Array, model: Array) -> float:
    """Share of the force's variance that the model explains with a gain (``_SIGN_GAINS``) and an offset."""
    r, m = recorded - recorded.mean(), model - model.mean()
    size = float(m @ m)
    gain = float(np.clip(m @ r / size, *_SIGN_GAINS)) if size > 0.0 else 0.0
    return 1.0 - float(np.sum((r - gain * m) ** 2)) / float(r @ r)


def _alike(recorded: Array, base: Array, other: Array, beside: Array) -> bool:
    """Whether two conventions explain a force as well as each other."""
    return other is base or abs(_likelier(recorded, base, other, beside, sized=False)) < _NOT_TOLD_APART


def _likelier(recorded: Array, base: Array, other: Array, beside: Array, *, sized: bool = True) -> float:
    """Log evidence by which ``other`` is likelier than ``base``, by what is recorded of their difference.

    ``recorded - base`` is fitted by a gain, an offset, ``beside`` (:func:`_beside`, shape (n, m)) and b times
    the difference: b is 0 if ``base`` is right and 1 if ``other`` is. Gain and offsets are as far off as
    sensors are: with a free one the ply steer of the other side would be an offset. b's error is the
    scatter of the residual over stretches of rows, what these may be off, and the form error. With ``sized``
    nothing is returned (-inf) where a b of any size is likelier than one of exactly 1.
    """
    part = other - base
    x = np.column_stack([base, np.ones(base.size), part, beside])
    size = np.sqrt(np.mean(x**2, axis=0))
    if size[2] < 1e-4 * size[0]:
        return 0.0 if not sized else -np.inf
    size[3:] = np.where(size[3:] > 0.0, size[3:], 1.0)
    x, gap = x / size, recorded - base
    off = np.r_[_GAIN_OFF * size[0], _OFFSET * float(np.max(np.abs(base))), np.inf, size[3:]]
    square = x.T @ x
    left = gap - x @ (np.linalg.pinv(square, rcond=1e-10) @ (x.T @ gap))
    spread = float(np.mean(left**2)) * base.size / INDEPENDENT_STRETCHES
    prior = np.diag(spread / off**2)
    inverse = np.linalg.pinv(square + prior, rcond=1e-10)
    fit = inverse @ (x.T @ gap)
    left = gap - x @ fit
    stretch = np.arange(base.size) * INDEPENDENT_STRETCHES // base.size
    score = np.array([np.bincount(stretch, x[:, k] * left, INDEPENDENT_STRETCHES) for k in range(size.size)])
    scatter = score @ score.T + spread * prior
    error = np.sqrt(max((inverse @ scatter @ inverse)[2, 2], 0.0)) / size[2]
    b = fit[2] / size[2]
    of_file = _OF_FILE * float(np.sqrt(np.mean(left**2))) / size[2]
    variance = error**2 + _FORM**2 + of_file**2
    if sized and (b - 1.0) ** 2 / (2.0 * variance) > max(-0.5 * np.log(variance), 0.0):
        return -np.inf
    return float((2.0 * b - 1.0) / (2.0 * variance))


def _finding(name: str, repaired: dict[str, Array], alike: Iterable[tuple[str, ...]] = ()) -> Finding:
    parameters = {"ratio": (-1.0, 0.0, "times")}
    have = "have" if ", " in name else "has"
    text = f"{name} {have} the other sign"
    alike = tuple(alike)
    if alike:
        sets = (
            " and ".join(s) + (" (SAE axes)" if set(s) - {ALIGNING_MOMENT} == _SAE else "") for s in alike
        )
        same = " or if ".join(sets)
        text += f"; it would look the same if {same} had"
    return Finding("sign_convention", name, text, parameters, repaired, alike=alike, axes=True)


_SAE = {"slip_angle", "fy"}
"""SAE J670e turns these, against ISO W (and the load, my and mz)."""
