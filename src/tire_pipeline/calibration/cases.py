"""Tuning cases: simulated by two rigs that share no equation, and made from real recordings."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.concealed import case_plan, make_case
from tire_pipeline.concealed.real import make_real_case, real_plan
from tire_pipeline.concealed.real.sources import available
from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import fit_magic_formula
from tire_pipeline.mismatch.effects import catalogue

EffectNames = tuple[str, ...]
EXACT = frozenset({"clipping", "stuck_channel", "sign_convention", "unit_error"})
"""Faults that are found without a fit."""
_WEAK = 1.0
"""Weaker effects, in misfits, may be left out of a right answer."""
_SECOND = {
    "inflation pressure": "inflation_pressure",
    "unknown camber": "camber_offset",
    "tread temperature": "temperature",
    "tread wear": "wear",
    "path curvature": "turn_slip",
    "relaxation": "relaxation_length",
    "sliding speed": "speed_dependence",
    "load sensitivity": "load_sensitivity",
    "surface friction": "friction_scale",
    "tread stiffness": "stiffness_scale",
    "carcass stiffness": "stiffness_scale",
    "force offset": "force_offset",
    "force gain": "force_gain",
    "crosstalk": "crosstalk",
    "load crosstalk": "crosstalk",
    "delay": "time_delay",
    "low-pass filter": "low_pass",
    "slip angle offset": "slip_angle_offset",
    "drift": "sensor_drift",
}
"""Causes of the second simulator -> names of the catalogue."""
_CAUSES_LEFT_OUT = ("clipping", "unit error", "quantisation")
_IN_ONE_CHANNEL = ("force offset", "force gain", "crosstalk", "load crosstalk", "drift")
"""Causes of the second simulator that change the one channel that was drawn, be it the moment's."""
_CASE_ROWS = 3000


@dataclass(frozen=True)
class KnownCase:
    """A recording, its tire model, and what it holds.

    Parameters
    ----------
    source : str
        Simulator or family of recordings.
    kind : str
    tire : TireModel
    recording : pandas.DataFrame
    effects : tuple of (str, float)
        Name and RMS over the formula's misfit.
    acceptable : tuple of str
        Names that the recording cannot tell from the truth.
    """

    source: str
    kind: str
    tire: Any
    recording: pd.DataFrame
    effects: tuple[tuple[str, float], ...]
    acceptable: EffectNames = ()

    @property
    def truth(self) -> EffectNames:
        """What it holds, as far as a set of effects can say it."""
        return tuple(sorted(name for name, _ in self._told))

    @property
    def right(self) -> tuple[EffectNames, ...]:
        """All sets that are right."""
        ways = []
        for name, size in self._told:
            instead = [(other,) for other in self.acceptable] if self.kind == "ambiguous" else []
            absent: list[EffectNames] = [()] if size < _WEAK else []
            ways.append([(name,), *instead, *absent])
        return tuple({tuple(sorted(sum(way, ()))) for way in product(*ways)})

    @property
    def unnamed(self) -> tuple[bool, ...]:
        """Whether something unnamed has to be beside the names: either is right where it is weak."""
        if self.kind != "unknown":
            return (False,)
        strongest = max(size for name, size in self.effects if name not in catalogue())
        return (True,) if strongest >= _WEAK else (False, True)

    @property
    def _told(self) -> list[tuple[str, float]]:
        return [each for each in self.effects if each[0] in catalogue() and each[0] not in EXACT]


def plans(
    folder: Path,
    real: dict[int, int],
    first: dict[int, int],
    second: dict[int, int],
    unnamed: dict[int, int],
) -> Iterator[tuple[str, Callable[[], KnownCase]]]:
    """Yield the name of each tuning case, and what makes it.

    Parameters
    ----------
    folder : Path
        Of the real recordings; without them there are simulated cases only.
    real, first, second, unnamed : dict
        Seed -> number of cases. Real ones are made from the sweeps of ``development.csv`` only, those without
        a name by the mechanisms of the open world that are for tuning.
    """
    for seed, count in real.items() if available(folder) else ():
        for number, plan in enumerate(real_plan(count, seed)):
            yield f"{plan.source}_{seed}_{number:03d}", partial(_real, plan, folder)
    for seed, count in first.items():
        for number, (case_seed, kind) in enumerate(case_plan(count, seed)):
            yield f"first_{seed}_{number:03d}", partial(_first, case_seed, kind)
    for seed, count in second.items():
        for number in range(count):
            yield f"second_{seed}_{number:03d}", partial(_second, seed, number)
    for seed, count in unnamed.items():
        for number in range(count):
            yield f"unnamed_{seed}_{number:03d}", partial(_unnamed, seed, number)


def _real(plan: Any, folder: Path) -> KnownCase:
    return _known(plan.source, *make_real_case(plan, folder, "development"))


def _first(seed: int, kind: str) -> KnownCase:
    return _known("first", *make_case(seed, kind))


def _known(source: str, case: Any, answer: Any) -> KnownCase:
    effects = tuple((e.name, float(e.over_misfit)) for e in answer.effects)
    return KnownCase(source, answer.kind, case.tire, case.recording, effects, tuple(answer.acceptable))


def _second(seed: int, number: int) -> KnownCase:
    """A case of the second simulator, with a formula fitted to its references; half have nothing missing."""
    from tire_pipeline.concealed.second import CAUSES, draw_case  # loads scipy.signal

    names = [cause for cause in CAUSES if cause not in _CAUSES_LEFT_OUT]
    rng = np.random.default_rng([seed, number])
    several = rng.random() >= 0.3
    wanted = tuple(rng.choice(names, size=1 if rng.random() < 0.75 else 2, replace=False))
    case = draw_case(rng, wanted if several else "nothing", rows=_CASE_ROWS)
    points = pd.concat([table.iloc[::8] for table in case.references], ignore_index=True)
    tire = fit_magic_formula(
        points,
        nominal_load=case.truth.tire.nominal_load,
        unloaded_radius=case.truth.tire.radius,
        starts=2,
        loss="linear",
    ).model
    pairs = zip(case.truth.causes, _sizes_in_forces(case.truth), strict=True)
    effects = tuple((_SECOND.get(cause, "unknown"), size) for cause, size in pairs if size > 0.0)
    return KnownCase("second", _kind(effects), tire, case.recording, effects)


def _sizes_in_forces(truth: Any) -> list[float]:
    """Return how large each cause of the second simulator is in Fx and Fy, in misfits; 0 if only Mz shows it.

    Its own strengths are of the force or moment that shows a cause most, and the explanation looks at no
    moment. Of two causes that both show, each has the part that both together have.
    """
    from tire_pipeline.concealed.second.strength import reached  # loads scipy.signal

    change = (truth.recording_with - truth.recording_without).T
    in_forces, largest = reached(change[:2], truth.unit[:2]), reached(change, truth.unit)
    pairs = list(zip(truth.causes, truth.parameters, strict=True))
    shows = [cause not in _IN_ONE_CHANNEL or p["channel"] != "mz" for cause, p in pairs]
    if sum(shows) <= 1:
        return [in_forces if here else 0.0 for here in shows]
    return [float(size) * in_forces / largest for size in truth.strengths]


def _unnamed(seed: int, number: int) -> KnownCase:
    """A case of the second simulator with a mechanism that is in no catalogue."""
    from tire_pipeline.concealed.open_world.tuning import MECHANISMS  # loads scipy.signal
    from tire_pipeline.concealed.second.strength import reached
    from tire_pipeline.concealed.unnamed.cases import draw_open_case

    try:
        case = draw_open_case(seed * 1000 + number, [MECHANISMS[number % len(MECHANISMS)]], rows=_CASE_ROWS)
    except ValueError as error:
        raise DomainError(str(error), todo="take another seed") from error
    beside = tuple((_SECOND[cause], 0.0) for cause in case.named)
    shown = [each.change[: len(case.recording), :2].T for each in case.added]
    sizes = [reached(change, case.unit[:2]) for change in shown]
    effects = (*beside, *(("unknown", size) for size in sizes if size > 0.0))
    return KnownCase("unnamed", _kind(effects), case.tire, case.recording, effects)


def _kind(effects: tuple[tuple[str, float], ...]) -> str:
    """Return the kind of a case of the second simulator."""
    if any(name == "unknown" for name, _ in effects):
        return "unknown"
    return "single" if effects else "nothing"
