"""Cases: a tire model, what the rig recorded, and a held-out run; the answer comes beside them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
import pandas as pd

from tire_pipeline.concealed.brush_rig import artefacts
from tire_pipeline.concealed.brush_rig.constants import TireConstants, draw_constants, without_cooling
from tire_pipeline.concealed.brush_rig.recorded_run import (
    RIG_FORCES,
    BrushRig,
    SensorNoise,
    add_noise,
    draw_noise,
)
from tire_pipeline.concealed.brush_rig.schedule import CasePlan, draw_plan, make_schedule
from tire_pipeline.concealed.cases import effect_size
from tire_pipeline.concealed.cases.clean_run import fit_clean, model_forces, residual, rms
from tire_pipeline.concealed.cases.drawn_effects import KIND_SHARES, Choice, choose
from tire_pipeline.concealed.cases.sealed_answers import Answer, EffectTruth
from tire_pipeline.concealed.cases.windows_and_regimes import regimes, windows
from tire_pipeline.concealed.effect_names import AMBIGUOUS_SETS, ARTEFACTS, CASE_KINDS, HEAT_OR_WEAR, PHYSICS
from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import TireModel

PAUSE = 60.0
"""Time between the recording and the held-out run, s: the tire is replaced by a new, cold one."""

WARMING = (25.0, 60.0)
"""How much a tire that keeps its heat warms in a recording, K."""


@dataclass(frozen=True)
class CaseSettings:
    """How cases are made.

    Attributes
    ----------
    rate : float
        Samples a second.
    n_bristles : int
        Bristles along the contact.
    misfit : (float, float)
        RMS misfit of the model where nothing is missing, as a share of the largest force.
    effect : (float, float)
        RMS of an effect over that misfit.
    rows : (int, int)
        Shortest and longest recording.
    attempts : int
        How often tire and rig are drawn again when the above cannot be met.
    """

    rate: float = 50.0
    n_bristles: int = 24
    misfit: tuple[float, float] = (0.004, 0.010)
    effect: tuple[float, float] = (0.5, 6.0)
    rows: tuple[int, int] = (1000, 17000)
    attempts: int = 60


@dataclass(frozen=True)
class Case:
    """What a user would have, and a held-out run that ``explain_mismatch`` never gets.

    Attributes
    ----------
    case_id : str
        Says nothing about the content.
    tire : TireModel
        Fitted to a clean run.
    recording, held_out : pandas.DataFrame
        ``time`` s, slip_angle rad, slip_ratio, camber rad, normal_load N, speed m/s, pressure Pa,
        tread_temperature degC (absent from some), turn_slip 1/m (only where the rig turns), fx, fy
        N. The held-out run is a second session with a new, cold tire of the same kind; the rig's
        clock goes on.
    """

    case_id: str
    tire: TireModel
    recording: pd.DataFrame = field(repr=False)
    held_out: pd.DataFrame = field(repr=False)


class _Unfit(Exception):
    """The draw cannot give a case of the wanted kind; draw again."""


@dataclass(frozen=True)
class _Bench:
    """A drawn tire on a drawn rig with its fitted model, before any effect."""

    rig: BrushRig
    plan: CasePlan
    tire: TireModel
    schedule: pd.DataFrame
    clean: pd.DataFrame
    clean_residual: np.ndarray
    misfit: float

    def effect(self, strengths: Mapping[str, float]) -> np.ndarray:
        """What effects add to recorded less modelled force, shape (n, 2), N."""
        physical = {k: v for k, v in strengths.items() if k not in ARTEFACTS}
        frame = self.rig.run(self.schedule, physical) if physical else self.clean
        frame = self.rig.with_artefacts(frame, strengths)
        return residual(self.tire, frame) - self.clean_residual


def make_case(seed: int, kind: str, settings: CaseSettings | None = None) -> tuple[Case, Answer]:
    """Make one case and its answer.

    Parameters
    ----------
    seed : int
    kind : str
        One of ``effect_names.KINDS``.
    settings : CaseSettings, optional

    Returns
    -------
    case : Case
    answer : Answer
        To be sealed; the same seed and kind always give the same two.

    Raises
    ------
    DomainError
        For an unknown kind.
    """
    if kind not in CASE_KINDS:
        raise DomainError(f"kind {kind!r} is not known", todo=f"use one of {', '.join(CASE_KINDS)}")
    settings = settings or CaseSettings()
    root = np.random.SeedSequence([seed, CASE_KINDS.index(kind)])
    streams = root.spawn(settings.attempts + 1)
    choice = choose(np.random.default_rng(streams[0]), kind)
    for stream in streams[1:]:
        rng = np.random.default_rng(stream)
        try:
            return _attempt(rng, choice, kind, f"case_{seed:010d}", settings)
        except _Unfit:
            continue
    raise DomainError(f"no case of kind {kind!r} with {choice.effects} in {settings.attempts} draws")


def case_plan(n: int, seed: int) -> list[tuple[int, str]]:
    """Seeds and kinds of a set of cases, shuffled: what :func:`make_cases` makes.

    Parameters
    ----------
    n : int
        How many.
    seed : int
    """
    rng = np.random.default_rng(seed)
    kinds = [kind for kind, share in KIND_SHARES.items() for _ in range(round(share * n))]
    kinds = (kinds + ["single"] * n)[:n]
    order = rng.permutation(n)
    seeds = rng.choice(10**9, size=n, replace=False)
    return [(int(seeds[i]), kinds[order[i]]) for i in range(n)]


def make_cases(n: int, seed: int, settings: CaseSettings | None = None) -> Iterator[tuple[Case, Answer]]:
    """Yield ``n`` cases with their answers, in the proportions of ``choice.SHARES``."""
    for case_seed, kind in case_plan(n, seed):
        yield make_case(case_seed, kind, settings)


def _attempt(
    rng: np.random.Generator, choice: Choice, kind: str, case_id: str, settings: CaseSettings
) -> tuple[Case, Answer]:
    bench = _set_up(rng, choice, settings)
    strengths: dict[str, float] = {}
    for name in choice.effects:
        strengths[name] = _scale(rng, bench, name, settings)
    noise = draw_noise(rng, bench.rig.constants, max(bench.rig.largest.values()))
    recording, frame = _record(rng, bench, bench.schedule, strengths, noise, 0.0)
    start = float(bench.schedule["time"].iloc[-1]) + PAUSE
    held_schedule, _ = make_schedule(bench.plan, rng, rate=settings.rate, held_out=True)
    held_out, held_frame = _record(rng, bench, held_schedule, strengths, noise, start)
    noise_part = residual(bench.tire, recording) - residual(bench.tire, frame)
    missing = _missing(choice, bench.plan)
    case = Case(
        case_id,
        bench.tire,
        recording.drop(columns=list(missing)),
        held_out.drop(columns=list(missing)),
    )
    answer = Answer(
        case_id=case_id,
        kind=kind,
        effects=tuple(_truth(bench, name, strengths, noise_part) for name in choice.effects),
        acceptable=AMBIGUOUS_SETS[choice.ambiguous]
        if kind == "ambiguous" and choice.ambiguous is not None
        else (),
        missing_channels=tuple(c for c in missing if c != "turn_slip"),
        blocks=bench.plan.blocks,
        focus=choice.focus,
        largest_force=max(bench.rig.largest.values()),
        misfit=bench.misfit,
        noise=rms(noise_part),
        oracle=_oracle(bench, held_schedule, held_out, held_frame, start),
    )
    return case, answer


def _set_up(rng: np.random.Generator, choice: Choice, settings: CaseSettings) -> _Bench:
    """Draw tire, rig and schedule, and fit the model to the clean run."""
    constants = draw_constants(rng)
    plan = draw_plan(
        rng,
        choice.focus,
        ambiguous=choice.ambiguous,
        nominal_load=constants.nominal_load,
        speed=constants.nominal_speed,
        pressure=constants.nominal_pressure,
    )
    schedule, _ = make_schedule(plan, rng, rate=settings.rate)
    if not settings.rows[0] <= len(schedule) <= settings.rows[1]:
        raise _Unfit
    if "camber_offset" in choice.effects and constants.camber_gain < 0.3:
        raise _Unfit
    end = float(schedule["time"].iloc[-1])
    rig = _draw_rig(rng, constants, plan, choice, end, settings)
    if choice.ambiguous == HEAT_OR_WEAR:
        rig = _keeping_heat(rng, rig, schedule)
    clean = rig.run(schedule, {})
    rig = _scaled_to(rig, clean)
    largest = max(rig.largest.values())
    tire, poor = fit_clean(rig, plan, noise=0.002 * largest, rng=rng)
    if poor > 2.0 * settings.misfit[1] * largest:
        raise _Unfit
    left = residual(tire, clean)
    misfit = rms(left)
    if not settings.misfit[0] <= misfit / largest <= settings.misfit[1]:
        raise _Unfit
    return _Bench(rig, plan, tire, schedule, clean, left, misfit)


def _draw_rig(
    rng: np.random.Generator,
    constants: TireConstants,
    plan: CasePlan,
    choice: Choice,
    end: float,
    settings: CaseSettings,
) -> BrushRig:
    """Draw the rig of a tire for a schedule of so many seconds; its largest forces are not known yet."""
    return BrushRig(
        constants=replace(constants, surface_time=end * float(rng.uniform(0.3, 0.7))),
        character=rng.random(4),
        slip_sign=float(rng.choice([-1.0, 1.0], p=[0.35, 0.65])),
        details={
            name: artefacts.draw_details(
                name, rng, end, braking="brake" in plan.blocks, cambered="camber" in plan.blocks
            )
            for name in choice.effects
            if name in ARTEFACTS
        },
        largest={"fx": 0.0, "fy": 0.0},
        n_bristles=settings.n_bristles,
    )


def _scaled_to(rig: BrushRig, clean: pd.DataFrame) -> BrushRig:
    """Return the rig with the wear and the largest forces of its clean run."""
    wear = float(clean["wear"].iloc[-1])
    return replace(
        rig,
        constants=replace(rig.constants, wear_energy=rig.constants.wear_energy * wear),
        largest={f: float(clean[f].abs().max()) for f in RIG_FORCES},
    )


def _keeping_heat(rng: np.random.Generator, rig: BrushRig, schedule: pd.DataFrame) -> BrushRig:
    """Return the rig with a tire that does not cool and warms by a drawn number of degrees."""
    unit = replace(rig, constants=without_cooling(rig.constants, 1e4))
    temperature = unit.run(schedule, {})["tread_temperature"].to_numpy()
    warmer = float(temperature[-1] - temperature[0])
    capacity = 1e4 * warmer / float(rng.uniform(*WARMING))
    return replace(rig, constants=without_cooling(rig.constants, capacity))


def _scale(rng: np.random.Generator, bench: _Bench, name: str, settings: CaseSettings) -> float:
    """Draw how strong an effect shall be and find the simulator's strength for it."""
    if name in artefacts.UNSCALED:
        if rms(bench.effect({name: 1.0})) < settings.effect[0] * bench.misfit:
            raise _Unfit
        return 1.0
    wanted = effect_size.draw_ratio(rng, *settings.effect)
    sign = float(rng.choice([-1.0, 1.0])) if name in effect_size.SIGNED else 1.0
    low, high = effect_size.STRENGTH_LIMITS[name]
    if name == "combined_slip":
        base = bench.rig.constants.coupling
        sign = 1.0 if base < 0.5 else sign
        high = min(high, base if sign < 0 else 1.3 - base)
        if high <= low:
            raise _Unfit

    def measure(x: float) -> float:
        return rms(bench.effect({name: sign * x})) / bench.misfit

    guess = min(max(effect_size.STRENGTH_GUESS[name], low), high)
    found, got = effect_size.find_strength(measure, wanted, guess, (low, high))
    if not settings.effect[0] <= got <= settings.effect[1]:
        raise _Unfit
    return sign * found


def _record(
    rng: np.random.Generator,
    bench: _Bench,
    schedule: pd.DataFrame,
    strengths: Mapping[str, float],
    noise: SensorNoise,
    time0: float,
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Run and record; returns the recording, and the same without noise."""
    physical = {k: v for k, v in strengths.items() if k not in ARTEFACTS}
    frame = bench.rig.run(schedule, physical, time0=time0).drop(columns="wear")
    return (
        bench.rig.with_artefacts(add_noise(frame, noise, rng), strengths),
        bench.rig.with_artefacts(frame, strengths),
    )


def _missing(choice: Choice, plan: CasePlan) -> tuple[str, ...]:
    hidden = ("tread_temperature",) if choice.hide_temperature else ()
    return hidden if "turn" in plan.blocks else (*hidden, "turn_slip")


def _truth(bench: _Bench, name: str, strengths: Mapping[str, float], noise_part: np.ndarray) -> EffectTruth:
    """Measure one effect by itself in the recording."""
    effect = bench.effect({name: strengths[name]})
    output = int(np.argmax(np.mean(effect**2, axis=0)))
    floor = rms(noise_part[:, output])
    size = rms(effect)
    details: dict[str, object] = {}
    if name in bench.rig.details:
        drawn = bench.rig.details[name]
        details = {"channel": drawn.channel, "factor": drawn.factor}
        if name == "stuck_channel":
            details["interval"] = list(drawn.interval)
    if name == "surface_change":
        details["moment"] = bench.rig.constants.surface_time
    family = "physics" if name in PHYSICS else "artefact" if name in ARTEFACTS else "unknown"
    return EffectTruth(
        name=name,
        kind=family,
        strength=float(strengths[name]),
        rms=size,
        over_misfit=size / bench.misfit,
        over_noise=size / rms(noise_part),
        output=RIG_FORCES[output],
        when=windows(effect[:, output], bench.schedule["time"].to_numpy(), floor),
        where=regimes(effect[:, output], bench.clean),
        details=details,
    )


def _oracle(
    bench: _Bench,
    schedule: pd.DataFrame,
    held_out: pd.DataFrame,
    held_frame: pd.DataFrame,
    time0: float,
) -> dict[str, dict[str, float]]:
    """Error on the held-out run of the model as it is, and of one with the true effects added.

    The oracle's error is the recorded noise and the model's misfit without effects.
    """
    clean = bench.rig.run(schedule, {}, time0=time0)
    before = residual(bench.tire, held_out)
    noise_part = before - residual(bench.tire, held_frame)
    best = noise_part + residual(bench.tire, clean)
    return {
        force: {
            "rms_before": rms(before[:, i]),
            "rms_oracle": rms(best[:, i]),
        }
        for i, force in enumerate(RIG_FORCES)
    }


__all__ = [
    "Case",
    "CaseSettings",
    "case_plan",
    "make_case",
    "make_cases",
    "model_forces",
]
