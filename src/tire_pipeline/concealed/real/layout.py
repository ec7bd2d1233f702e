"""Which sweeps a case's model is fitted to, which are shown and which are held out.

Physics is hidden by what the model is *not* fitted to: a camber, a pressure, all loads but one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import pandas as pd

from tire_pipeline.concealed.real.sources import UNLOADED_RADIUS, Sweep
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.magic_formula.fitting.report.valid_ranges import with_measured_ranges

HIDDEN_CHANNELS = ("camber", "inflation_pressure", "load_sensitivity")
"""Names of what can be hidden from a model by the choice of its sweeps."""

FIT_RATE = 10.0
"""Samples a second that a formula is fitted to, Hz (means of the recorded ones)."""

ONE_SURFACE = "rubber_floor_ramps/"
"""Drives of one day on one surface; what was changed before the others is not known."""

LAYOUT_LEVEL = 0.1
"""Loads that differ by less than this share are one load."""


@dataclass(frozen=True)
class Layout:
    """Sweeps of one case, and what its model does not know.

    Attributes
    ----------
    fit, shown, held_out : tuple of Sweep
    hidden : tuple of str
        Names of the physics that the choice hides.
    channels : tuple of str
        Channels beside slip angle, load and force that the recording keeps.
    """

    fit: tuple[Sweep, ...]
    shown: tuple[Sweep, ...]
    held_out: tuple[Sweep, ...]
    hidden: tuple[str, ...]
    channels: tuple[str, ...]


def draw_layout(
    rng: np.random.Generator, pool: Sequence[Sweep], hidden: tuple[str, ...], needed: Sequence[str]
) -> Layout | None:
    """Draw the sweeps of a case; None if this draw has none to fit, to show or to hold out.

    Parameters
    ----------
    rng : numpy.random.Generator
    pool : sequence of Sweep
        Of one source.
    hidden : tuple of str
        Of ``HIDDEN_CHANNELS``; empty where the model shall know all that it is shown.
    needed : sequence of str
        Channels that must stay in the recording.
    """
    known, unknown = _levels(rng, pool, hidden)
    if len(known) < (1 if hidden else 3) or (hidden and len(unknown) < 2):
        return None
    if hidden:
        fit = known
        shown = [*_some(rng, known, 1), *_some(rng, unknown, 1, leave=_left_out(unknown))]
    else:
        fit = _some(rng, known, 2)
        shown = _some(rng, known, 2, leave=_left_out(known))
    shown = [s for s in pool if s in shown]  # in the order of their recording
    rest = tuple(s for s in pool if (s in known or s in unknown) and s not in shown)
    moved = {name for name in ("camber", "pressure") if len(_of(name, (*shown, *fit))) > 1}
    keep = [
        name
        for name, chance in (("camber", 0.4), ("pressure", 0.7), ("tread_temperature", 0.55), ("speed", 0.9))
        if rng.random() < chance or name in moved or name in needed
    ]
    there = set(shown[0].frame)
    return Layout(tuple(fit), tuple(shown), rest, hidden, tuple(c for c in keep if c in there))


def _left_out(chosen: Sequence[Sweep]) -> int:
    """How many are held out at least: one sweep, or a fifth of steady points."""
    return 1 if "time" in chosen[0].frame else len(chosen) // 5


def _levels(
    rng: np.random.Generator, pool: Sequence[Sweep], hidden: tuple[str, ...]
) -> tuple[list[Sweep], list[Sweep]]:
    """Sweeps at conditions that the model knows, and those at the hidden ones."""
    if pool[0].source == "tydex":
        flat = [s for s in pool if s.camber == 0.0]
        if hidden:
            return flat, [s for s in pool if s.camber != 0.0]
        return (flat if rng.random() < 0.3 else list(pool)), []
    if pool[0].source == "dart":
        return [s for s in pool if s.name.startswith(ONE_SURFACE)], []
    cambers, pressures = sorted(_of("camber", pool)), sorted(_of("pressure", pool))
    base = (float(rng.choice(cambers)), float(rng.choice(pressures)))
    if "camber" in hidden:
        base = (0.0, base[1])
    wanted = {base}
    if "camber" in hidden or (not hidden and rng.random() < 0.4):
        wanted |= {(c, p) for c in cambers for _, p in wanted}
    if "inflation_pressure" in hidden or (not hidden and rng.random() < 0.3):
        wanted |= {(c, p) for c, _ in wanted for p in pressures}
    chosen = [s for s in pool if (s.camber, s.pressure) in wanted]
    if not hidden:
        return chosen, []
    known = [s for s in chosen if (s.camber, s.pressure) == base]
    if "load_sensitivity" in hidden:
        at = float(rng.choice([s.load for s in known]))
        known = [s for s in known if abs(s.load / at - 1.0) < LAYOUT_LEVEL]
    return known, [s for s in chosen if s not in known]


def _of(name: str, chosen: Sequence[Sweep]) -> set[float]:
    return {value for s in chosen if np.isfinite(value := getattr(s, name))}


def _some(rng: np.random.Generator, chosen: Sequence[Sweep], least: int, *, leave: int = 0) -> list[Sweep]:
    """A random part of the sweeps, in their order: at least ``least``, all but ``leave`` at most."""
    most = len(chosen) - leave
    if most < least:
        return list(chosen[:most])
    low = max(least, round(0.5 * len(chosen)))
    count = int(rng.integers(min(low, most), most + 1))
    return [chosen[i] for i in sorted(rng.choice(len(chosen), size=count, replace=False))]


def rows(chosen: Sequence[Sweep], rate: float | None, *, picked: bool = False) -> pd.DataFrame:
    """Rows of sweeps one after the other, at a rate; ``piece`` numbers the sweeps.

    Parameters
    ----------
    chosen : sequence of Sweep
    rate : float or None
        Hz; None for the recording's own.
    picked : bool
        Every so many samples instead of their means.
    """
    frames = [s.frame.assign(piece=number) for number, s in enumerate(chosen)]
    return at_rate(pd.concat(frames, ignore_index=True), rate, picked=picked)


def at_rate(frame: pd.DataFrame, rate: float | None, *, picked: bool = False) -> pd.DataFrame:
    """The same at fewer samples a second, piece by piece."""
    if rate is None or "time" not in frame:
        return frame
    out = []
    for _, piece in frame.groupby("piece", sort=False):
        every = max(round(1.0 / (float(np.median(np.diff(piece["time"]))) * rate)), 1)
        full = len(piece) // every * every
        if picked or every == 1:
            out.append(piece.iloc[:full:every])
        else:
            values = piece.iloc[:full].to_numpy(dtype=float).reshape(-1, every, piece.shape[1]).mean(axis=1)
            out.append(pd.DataFrame(values, columns=piece.columns))
    return pd.concat(out, ignore_index=True)


def fitted(chosen: Sequence[Sweep]) -> TireModel:
    """The formula fitted to whole sweeps: MF 5.2, or 6.1 where they have several pressures."""
    return _fitted(tuple(sorted(set(chosen), key=lambda s: s.sha256)))


@lru_cache(maxsize=4096)
def _fitted(chosen: tuple[Sweep, ...]) -> TireModel:
    frame = rows(chosen, FIT_RATE)
    channels = ["slip_angle", "normal_load", "fy"]
    channels += [name for name in ("camber", "pressure") if len(_of(name, chosen)) > 1]
    version = "6.1" if "pressure" in channels else "5.2"
    result = fit_magic_formula(frame[channels], version, unloaded_radius=UNLOADED_RADIUS[chosen[0].source])
    model = with_measured_ranges(result.model, result.measured)
    if "speed" in frame:
        model = model.replace(LONGVL=round(float(frame["speed"].mean()), 3))
    return model
