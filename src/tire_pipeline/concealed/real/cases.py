"""Cases made from real recordings, and their answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from tire_pipeline.concealed.cases import effect_size
from tire_pipeline.concealed.cases.clean_run import model_forces, rms
from tire_pipeline.concealed.cases.make import Case
from tire_pipeline.concealed.cases.sealed_answers import Answer, EffectTruth
from tire_pipeline.concealed.cases.windows_and_regimes import regimes, windows
from tire_pipeline.concealed.real.layout import Layout, at_rate, draw_layout, fitted, rows
from tire_pipeline.concealed.real.plan import RealPlan, draw_effects
from tire_pipeline.concealed.real.put_in import (
    INSERTED_EFFECTS,
    Details,
    RecordedSession,
    draw_details,
    friction_work,
    put_in,
    way_rolled_by,
)
from tire_pipeline.concealed.real.sources import UNLOADED_RADIUS, Pool, Sweep, pool
from tire_pipeline.errors import DomainError, RecordingError
from tire_pipeline.magic_formula import TireModel

AGREES = 1.3
"""A model knows what it is shown if it leaves at most so much of the best formula's misfit on these rows.
Known before any effect is added; other draws are taken again."""

MOST_MISFIT = 0.05
"""Largest misfit of the formula, on what is shown and what is held out, as a share of the largest force:
above it no formula was found."""

EFFECT = (0.5, 6.0)
"""RMS of an effect over the misfit."""

MOST_CASE_ROWS = 7000
RATES: Mapping[str, tuple[float, ...]] = {"calspan": (10.0, 20.0, 50.0, 100.0), "dart": (5.0, 10.0, 20.0)}
NEEDED_CHANNELS: Mapping[str, tuple[str, ...]] = {
    "camber_offset": ("camber",),
    "temperature": ("tread_temperature",),
    **dict.fromkeys(("relaxation_length", "speed_dependence", "wear", "nonuniformity"), ("speed",)),
}
"""Channels that the recording keeps beside slip angle, load and force, so that the effect can be named."""

_SEVERAL_LOADS = 1.2
"""Largest over smallest load from which an offset of the load is no gain of it."""

ATTEMPTS = 200


@dataclass(frozen=True)
class RealAnswer(Answer):
    """What a case from a real recording conceals.

    Attributes
    ----------
    source : str
        Of the recording.
    hidden : tuple of str
        Effects that the model was not fitted to; the others were put in.
    rate : float or None
        Samples a second.
    fit, shown, held_out : tuple of str
        SHA-256 of the sweeps.
    """

    source: str = ""
    hidden: tuple[str, ...] = ()
    rate: float | None = None
    fit: tuple[str, ...] = ()
    shown: tuple[str, ...] = ()
    held_out: tuple[str, ...] = ()


class _UnfitSweeps(Exception):
    """This draw gives no case of the wanted kind."""


@dataclass(frozen=True)
class _RealBench:
    """Sweeps, model and formula of one draw, before anything is added."""

    layout: Layout
    tire: TireModel
    raw: pd.DataFrame
    raw_held: pd.DataFrame
    rate: float | None
    picked: bool
    misfit: float
    session: RecordedSession

    def shown(self, frame: pd.DataFrame) -> pd.DataFrame:
        """Rows of a run as they are recorded."""
        return at_rate(frame, self.rate, picked=self.picked)

    def effect(self, strengths: Mapping[str, float], details: Mapping[str, Details]) -> np.ndarray:
        """What put-in effects add to recorded less modelled side force, shape (n,), N."""
        changed = self.shown(put_in(self.raw, strengths, self.session, details))
        return _left(self.tire, changed) - _left(self.tire, self.shown(self.raw))


def make_real_case(plan: RealPlan, folder: Path, which: Pool = "sealed") -> tuple[Case, RealAnswer]:
    """Make one case and its answer.

    Parameters
    ----------
    plan : RealPlan
    folder : Path
        Of the recordings.
    which : {"sealed", "development"}
        Sweeps that it may be made from.

    Raises
    ------
    DomainError
        No draw gives a case of this kind.
    """
    chosen = pool(folder, plan.source, which)
    for stream in plan.stream().spawn(ATTEMPTS):
        try:
            return _attempt(np.random.default_rng(stream), plan, chosen)
        except (_UnfitSweeps, RecordingError):  # too few points for a formula: the next draw has more
            continue
    raise DomainError(
        f"no case of kind {plan.kind!r} from {plan.source} with seed {plan.seed} in {ATTEMPTS} draws",
        todo="take another seed, or look at which sweeps are there",
    )


def _attempt(rng: np.random.Generator, plan: RealPlan, chosen: Sequence[Sweep]) -> tuple[Case, RealAnswer]:
    choice = draw_effects(rng, plan)
    bench = _set_up(rng, chosen, choice.hidden, choice.put_in)
    time = bench.raw["time"].to_numpy() if "time" in bench.raw else np.linspace(0.0, 1.0, len(bench.raw))
    details = {name: draw_details(name, rng, time) for name in choice.put_in}
    strengths: dict[str, float] = {}
    for name in choice.put_in:
        strengths[name] = _scale(rng, bench, name, details)
    frame = bench.shown(put_in(bench.raw, strengths, bench.session, details))
    clean_held = bench.shown(bench.raw_held)
    held = bench.shown(put_in(bench.raw_held, strengths, bench.session, details))
    truths = [_hidden_truth(bench, name, choice.hidden) for name in choice.hidden]
    if not all(EFFECT[0] <= truth.over_misfit <= EFFECT[1] for truth in truths):
        raise _UnfitSweeps
    truths += [_put_in_truth(bench, name, strengths, details) for name in choice.put_in]
    kept = [c for c in ("time", "slip_angle", "normal_load", "fy", *bench.layout.channels) if c in frame]
    case = Case(plan.case_id, bench.tire, frame[kept], held[kept])
    best = bench.session.formula if choice.hidden else bench.tire
    answer = RealAnswer(
        case_id=plan.case_id,
        kind=choice.kind,
        effects=tuple(truths),
        acceptable=choice.acceptable,
        missing_channels=tuple(c for c in bench.layout.shown[0].frame if c not in kept),
        blocks=(),
        focus=(),
        largest_force=bench.session.largest,
        misfit=bench.misfit,
        noise=bench.misfit,
        oracle={
            "fy": {"rms_before": rms(_left(bench.tire, held)), "rms_oracle": rms(_left(best, clean_held))}
        },
        source=plan.source,
        hidden=choice.hidden,
        rate=bench.rate,
        fit=tuple(s.sha256 for s in bench.layout.fit),
        shown=tuple(s.sha256 for s in bench.layout.shown),
        held_out=tuple(s.sha256 for s in bench.layout.held_out),
    )
    return case, answer


def _set_up(
    rng: np.random.Generator, chosen: Sequence[Sweep], hidden: tuple[str, ...], effects: Sequence[str]
) -> _RealBench:
    layout = draw_layout(rng, chosen, hidden, [c for name in effects for c in NEEDED_CHANNELS.get(name, ())])
    if layout is None:
        raise _UnfitSweeps
    raw, raw_held = rows(layout.shown, None), rows(layout.held_out, None)
    if "camber_offset" in effects and np.ptp(raw["camber"]) < 0.01:
        raise _UnfitSweeps
    if "load_offset" in effects and raw["normal_load"].max() < _SEVERAL_LOADS * raw["normal_load"].min():
        raise _UnfitSweeps
    picked = any(INSERTED_EFFECTS[name].whole for name in effects) or bool(rng.random() < 0.3)
    rate = _rate(rng, layout, raw, effects)
    tire, formula = fitted(layout.fit), fitted((*layout.shown, *layout.held_out))
    # Too few steady points overfit: there the formula is that of all points of the case.
    best = formula if layout.shown[0].source == "tydex" else fitted(layout.shown)
    shown = at_rate(raw, rate, picked=picked)
    misfit = rms(_left(best, shown))
    session = _session(formula, layout, raw)
    known = at_rate(rows(layout.fit, None), rate, picked=picked) if hidden else shown
    if rms(_left(tire, known)) > AGREES * max(misfit, rms(_left(formula, known))):
        raise _UnfitSweeps
    held = rms(_left(formula if hidden else tire, raw_held))
    if max(misfit, held) > MOST_MISFIT * session.largest:
        raise _UnfitSweeps
    return _RealBench(layout, tire, raw, raw_held, rate, picked, misfit, session)


def _rate(
    rng: np.random.Generator, layout: Layout, raw: pd.DataFrame, effects: Sequence[str]
) -> float | None:
    source = layout.shown[0].source
    if source not in RATES:
        return None
    least = 50.0 if "nonuniformity" in effects else 0.0
    allowed = [r for r in RATES[source] if r >= least and len(raw) * r / 100.0 <= MOST_CASE_ROWS]
    if not allowed:
        raise _UnfitSweeps
    return float(rng.choice(allowed))


def _session(formula: TireModel, layout: Layout, raw: pd.DataFrame) -> RecordedSession:
    timed = "time" in raw
    work, clock = friction_work(raw), raw["time"].to_numpy() if timed else np.arange(len(raw))
    return RecordedSession(
        formula=formula,
        start=float(raw["time"].iloc[0]) if timed else 0.0,
        end=float(raw["time"].iloc[-1]) if timed else 1.0,
        load=float(raw["normal_load"].median()),
        speed=float(raw["speed"].median()) if "speed" in raw else 1.0,
        temperature=float(raw["tread_temperature"].mean()) if "tread_temperature" in raw else 0.0,
        work=max(float(work[-1]), 1e-9),
        largest=float(raw["fy"].abs().max()),
        opposing=float(np.sign(np.corrcoef(raw["slip_angle"], raw["fy"])[0, 1])) or 1.0,
        radius=UNLOADED_RADIUS[layout.shown[0].source],
        done=(clock, work),
        rolled=(clock, way_rolled_by(raw)),
    )


def _scale(rng: np.random.Generator, bench: _RealBench, name: str, details: Mapping[str, Details]) -> float:
    """Draw how strong an effect shall be, in misfits, and find its strength."""
    inserted = INSERTED_EFFECTS[name]
    if not inserted.scaled:
        if rms(bench.effect({name: 1.0}, details)) < EFFECT[0] * bench.misfit:
            raise _UnfitSweeps
        return 1.0
    wanted = effect_size.draw_ratio(rng, *EFFECT)
    sign = details[name].sign if inserted.signed else 1.0
    unit = {"force": bench.session.largest, "radius": bench.session.radius}.get(inserted.share_of, 1.0)

    def measure(x: float) -> float:
        return rms(bench.effect({name: sign * x}, details)) / bench.misfit

    found, got = effect_size.find_strength(
        measure, wanted, unit * inserted.guess, (unit * inserted.low, unit * inserted.high)
    )
    if not EFFECT[0] <= got <= EFFECT[1]:
        raise _UnfitSweeps
    return sign * found


def _put_in_truth(
    bench: _RealBench, name: str, strengths: Mapping[str, float], details: Mapping[str, Details]
) -> EffectTruth:
    effect = bench.effect({name: strengths[name]}, details)
    drawn = details[name]
    return _truth(
        bench,
        name,
        strengths[name],
        effect,
        {"channel": drawn.channel, "factor": drawn.factor, "moment": drawn.moment},
    )


def _hidden_truth(bench: _RealBench, name: str, hidden: tuple[str, ...]) -> EffectTruth:
    """What the best formula knows of these rows and the model does not, at the rows that have it."""
    shown = bench.shown(bench.raw)
    effect = model_forces(bench.session.formula, shown)[:, 1] - model_forces(bench.tire, shown)[:, 1]
    if len(hidden) > 1:
        base = bench.layout.fit[0]
        other = {
            "camber": shown["camber"] - base.camber,
            "inflation_pressure": shown["pressure"] - base.pressure,
        }
        limit = {"camber": 0.01, "inflation_pressure": 5e3}
        effect = np.where(np.abs(other[name]) > limit[name], effect, 0.0)
    return _truth(bench, name, 1.0, effect, {})


def _truth(
    bench: _RealBench, name: str, size: float, effect: np.ndarray, details: Mapping[str, object]
) -> EffectTruth:
    shown = bench.shown(bench.raw)
    timed = "time" in shown and len(shown) > 10
    total = rms(effect)
    return EffectTruth(
        name=name,
        kind=INSERTED_EFFECTS[name].kind if name in INSERTED_EFFECTS else "physics",
        strength=size,
        rms=total,
        over_misfit=total / bench.misfit,
        over_noise=total / bench.misfit,
        output="fy",
        when=windows(effect, shown["time"].to_numpy(), bench.misfit) if timed else (),
        where=regimes(effect, shown),
        details=details,
    )


def _left(tire: TireModel, frame: pd.DataFrame) -> np.ndarray:
    return frame["fy"].to_numpy() - model_forces(tire, frame)[:, 1]
