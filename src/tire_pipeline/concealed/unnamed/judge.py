"""What an explanation of an open-world case is worth: names, drivers, equation, held-out error."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import ALIGNING_MOMENT, PLANE_FORCES, SLIP_AND_LOAD, TANGENTIAL_FORCES
from tire_pipeline.concealed.cases.clean_run import model_forces
from tire_pipeline.concealed.open_world.mechanism import Mechanism
from tire_pipeline.concealed.unnamed.cases import CATALOGUE_NAMES, OpenCase
from tire_pipeline.mismatch.report.result import MismatchReport
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedReport
from tire_pipeline.mismatch.unnamed_physics.language.grammar import (
    EquationError,
    SymbolTable,
    evaluate,
    parse,
)

_MOVED_TOGETHER = 0.95
"""Correlation (size) from which on two channels count as moved together by the schedule."""
_DRAWN_POINTS = 200
_CLOSE = 0.01
_SHOWS = 0.2
"""Least share of the squared held-out error that the true change removes, so that it can be judged."""
_ROUNDING = 1e-9
_SLOW_CHANNELS = ("camber", "normal_load", "speed", "pressure", "tread_temperature", "time")


def squared(case: OpenCase, predicted: pd.DataFrame) -> dict[str, float]:
    """Mean squared error on the held-out rows, by force, N^2."""
    return {f: float(np.mean((case.held_out[f] - predicted[f]) ** 2)) for f in TANGENTIAL_FORCES}


def removed(
    before: Mapping[str, float], after: Mapping[str, float], oracle: Mapping[str, float]
) -> tuple[float, float]:
    """Share of the squared error that goes, of what the true change removes, and that share itself.

    Both forces together, each over its error before. NaN where the true change removes too little to judge.
    """
    total = float(sum(1.0 - oracle[f] / before[f] for f in TANGENTIAL_FORCES))
    gone = float(sum(1.0 - after[f] / before[f] for f in TANGENTIAL_FORCES))
    return (gone / total if total >= _SHOWS else float("nan")), total


def worse(before: Mapping[str, float], after: Mapping[str, float]) -> bool:
    """Whether the squared error of a force grows by more than rounding."""
    return any(after[f] > before[f] * (1.0 + _ROUNDING) for f in after)


def oracle_of(case: OpenCase) -> tuple[dict[str, float], dict[str, float]]:
    """Squared errors of the model as it came, and with the true change of all that was put in."""
    plain = pd.DataFrame(model_forces(case.tire, case.held_out), columns=list(TANGENTIAL_FORCES))
    change = (case.held_with - case.held_without)[:, :2]
    return squared(case, plain), squared(case, plain + change)


def same_channels(case: OpenCase) -> dict[str, str]:
    """Slow channel -> the first of those that the schedule moves together with it."""
    live = [c for c in _SLOW_CHANNELS if c in case.recording and float(np.std(case.recording[c])) > 0.0]
    together = np.abs(np.corrcoef(case.recording[live].to_numpy().T)) > _MOVED_TOGETHER
    return {c: live[int(np.argmax(together[i]))] for i, c in enumerate(live)}


def moment_removed(case: OpenCase, predicted: pd.DataFrame) -> tuple[float, bool]:
    """Share of the aligning moment's squared error that goes, and whether it becomes worse.

    Of what the true change removes; NaN where that removes too little to judge, or where no moment is
    predicted.
    """
    name = ALIGNING_MOMENT
    if name not in predicted:
        return float("nan"), False
    inputs = {c: case.held_out[c].to_numpy() for c in SLIP_AND_LOAD}
    plain = case.tire.forces(**inputs, limits="ignore", outputs=(name,)).mz
    change = (case.held_with - case.held_without)[:, PLANE_FORCES.index(name)]
    recorded = case.held_out[name].to_numpy()
    before, after, oracle = (
        float(np.mean((recorded - x) ** 2)) for x in (plain, predicted[name].to_numpy(), plain + change)
    )
    possible = 1.0 - oracle / before
    share = (1.0 - after / before) / possible if possible >= _SHOWS else float("nan")
    return share, worse({name: before}, {name: after})


def drivers_right(found: Sequence[str], true: Sequence[str], same: Mapping[str, str]) -> tuple[bool, bool]:
    """Whether the drivers are the true ones and none more, and whether they share one with them."""

    def merged(names: Sequence[str]) -> set[str]:
        return {same.get(n, n) for n in names}

    return merged(found) == merged(true), bool(merged(found) & merged(true))


def equation_right(found: UnnamedReport, mechanism: Mechanism, nominal: Any) -> bool:
    """Whether one of the three first equations is the true one but for its size: 200 points, to 1%."""
    if not mechanism.expressions:
        return False
    rng = np.random.default_rng(0)
    true, ours = _points(rng, nominal, found)
    first = [found.physics.equations] if found.physics is not None else []
    for equations in [*first, *(a.equations for a in found.alternatives)][:3]:
        acting = [f for f in PLANE_FORCES if f in mechanism.expressions]
        if acting and all(
            f in equations and _alike(equations[f], mechanism.expressions[f], true, ours) for f in acting
        ):
            return True
    return False


def _points(
    rng: np.random.Generator, nominal: Any, found: UnnamedReport
) -> tuple[dict[str, Any], SymbolTable]:
    """The same 200 points in the symbols of the mechanism and of the equation."""

    def between(low: float, high: float) -> np.ndarray:
        return rng.uniform(low, high, _DRAWN_POINTS)

    own = found.physics.nominal if found.physics is not None else nominal
    at = {"s": between(-0.15, 0.15), "k": between(-0.1, 0.1), "g": between(-0.05, 0.05)}
    load, speed, pressure, warm = between(0.4, 2.0), between(0.5, 1.7), between(0.8, 1.2), between(-1.0, 1.0)
    forces = {f: between(-5000.0, 5000.0) for f in TANGENTIAL_FORCES} | {
        ALIGNING_MOMENT: between(-100.0, 100.0)
    }
    true = {
        **at,
        **forces,
        "L": load,
        "v": speed,
        "p": pressure,
        "h": warm,
        "c": 1.0,
    }
    true |= {"F0": nominal.load, "R0": nominal.radius}
    ours = {
        **at,
        **forces,
        "L": load * nominal.load / getattr(own, "F0", nominal.load),
        "v": speed * nominal.speed / getattr(own, "V0", nominal.speed),
        "p": pressure * nominal.pressure / getattr(own, "P0", nominal.pressure),
        "h": warm + (nominal.temperature - getattr(own, "T0", nominal.temperature)) / 20.0,
        "F0": np.full(_DRAWN_POINTS, nominal.load),
        "R0": np.full(_DRAWN_POINTS, nominal.radius),
    }
    start = np.zeros(_DRAWN_POINTS, bool)
    start[0] = True
    return true, SymbolTable(ours, np.zeros(_DRAWN_POINTS), np.zeros(_DRAWN_POINTS), start)


def _alike(text: str, expression: str, true: Mapping[str, Any], ours: SymbolTable) -> bool:
    """Whether two equations are one, but for a factor: at 200 points to 1% of the larger."""
    import sympy

    tree = parse(text)
    if any(word in text for word in ("lag", "play", "highest")) or tree.symbols - set(ours.columns):
        return False
    symbols = sorted(true)
    named = {s: sympy.Symbol(s) for s in symbols}
    function = sympy.lambdify(list(named.values()), sympy.sympify(expression, locals=named), "numpy")
    try:
        y = np.broadcast_to(function(*(true[s] for s in symbols)), (_DRAWN_POINTS,)).astype(float)
        x = evaluate(tree, ours)
    except EquationError:
        return False
    factor = float(x @ y) / max(float(x @ x), 1e-300)
    return bool(np.max(np.abs(y - factor * x)) <= _CLOSE * np.max(np.abs(y)))


def judged(case: OpenCase, mechanisms: Sequence[Mechanism], report: MismatchReport) -> dict[str, Any]:
    """One row of the table."""
    before, oracle = oracle_of(case)
    predicted = report.corrected.predict(case.held_out)
    after, (of_moment, moment_worse) = squared(case, predicted), moment_removed(case, predicted)
    share, possible = removed(before, after, oracle)
    names = tuple(e.name for e in report.effects)
    allowed = {CATALOGUE_NAMES[n] for n in case.named}
    false = any(allowed.isdisjoint(e.names) for e in report.effects)
    found = report.unnamed
    true = tuple(dict.fromkeys(d for m in mechanisms for d in m.drivers))
    said = found.physics.depends_on if found is not None and found.physics is not None else ()
    exact, some = drivers_right(said, true, same_channels(case))
    return {
        "mechanism": " + ".join(m.name for m in mechanisms),
        "beside": ", ".join(case.named),
        "strength": max(a.strength for a in case.added),
        "in_grammar": all(m.expressions for m in mechanisms),
        "verdict": report.verdict,
        "names": " ".join(names),
        "false_name": false,
        "equation": "; ".join(found.physics.equations.values()) if found and found.physics else "",
        "true_drivers": ", ".join(true),
        "drivers": ", ".join(said),
        "drivers_right": exact,
        "driver_shared": some,
        "equation_right": found is not None
        and len(mechanisms) == 1
        and equation_right(found, mechanisms[0], case.nominal),
        "possible": possible,
        "removed": share,
        "removed_moment": of_moment,
        "worse": worse(before, after),
        "worse_moment": moment_worse,
        "oracle_worse": worse(before, oracle),
        "rms_before": float(np.sqrt(before["fy"])),
        "rms_after": float(np.sqrt(after["fy"])),
        "rms_oracle": float(np.sqrt(oracle["fy"])),
    }
