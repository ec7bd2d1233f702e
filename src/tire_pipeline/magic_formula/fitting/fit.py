"""From a recording to a tire model, stage by stage."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.coefficients import INDEX, family_of
from tire_pipeline.magic_formula.fitting import stages
from tire_pipeline.magic_formula.fitting.coverage import open_coefficients
from tire_pipeline.magic_formula.fitting.result import FitResult
from tire_pipeline.magic_formula.fitting.solve import Problem, StageFit, solve
from tire_pipeline.magic_formula.fitting.stages import STAGES, Stage
from tire_pipeline.magic_formula.fitting.starts import (
    bounds_of,
    first_values,
    kept_value,
    starting_points,
    typical_values,
)
from tire_pipeline.magic_formula.fitting.statistics import relative_rms, residual_table
from tire_pipeline.magic_formula.fitting.typical import pull
from tire_pipeline.magic_formula.model import TireModel

_INPUTS = ("slip_angle", "slip_ratio", "camber", "normal_load", "speed", "pressure")
_MOST_POINTS = 20_000
_FEWEST_POINTS = 10
_MOST_REMOVED = 12
_POINTS_OF = {
    "lateral": "pure lateral slip",
    "longitudinal": "pure longitudinal slip",
    "combined": "combined slip",
    "all": "points",
}


def fit_magic_formula(
    recording: pd.DataFrame,
    version: str = "5.2",
    start: TireModel | None = None,
    *,
    nominal_load: float | None = None,
    unloaded_radius: float | None = None,
    starts: int = 4,
    loss: str = "soft_l1",
    seed: int = 0,
) -> FitResult:
    """Fit a Magic Formula tire model to measurements.

    Parameters
    ----------
    recording : DataFrame
        Columns by canonical name in SI units: ``normal_load``, some of ``slip_angle``, ``slip_ratio``,
        ``camber``, ``speed``, ``pressure``, and some of ``fx``, ``fy``, ``mx``, ``my``, ``mz``. What is
        missing of the former is taken as 0 (speed and pressure as their nominal values); what is missing of
        the latter is not fitted. Steady state: transients have to be left out before.
    version : str
        The version to fit.
    start : TireModel, optional
        Where to start from; what the data cannot determine keeps its values. Else typical values, and zero.
    nominal_load : float, optional
        ``FNOMIN`` (N); that of ``start``, or the median load to two digits.
    unloaded_radius : float, optional
        ``UNLOADED_RADIUS`` (m); that of ``start``, or the recording's (TYDEX ``OVALLDIA``), or 0.3.
    starts : int
        Number of starting points of each stage; the best result is kept.
    loss : str
        A robust loss of :func:`scipy.optimize.least_squares`, or "linear".
    seed : int
        For the starting points.

    Returns
    -------
    FitResult
        ``.model`` is the TireModel; ``.forces(...)`` is the model's.

    Raises
    ------
    RecordingError
        If there is no load, no force or moment, or there are fewer than ten points.

    Notes
    -----
    The stages: Fy, Fx and Mz at pure slip, then at combined slip, Mx, My (thesis, Appendix A, and Pacejka's
    appendix on the estimation of parameters). The model reproduces the recording's own signs: data in which a
    positive slip angle gives a positive Fy give a positive PKY1, and a note.
    """
    family = family_of(version)
    points, forces = _columns(recording, start)
    base, notes = _base(recording, version, start, points, nominal_load, unloaded_radius)
    points["speed"] = _filled(points["speed"], base["LONGVL"])
    points["pressure"] = _filled(points["pressure"], base.get("NOMPRES", 0.0))
    model = TireModel.from_coefficients(base, version)
    report = _Report("0" if start is None else "their start values", notes)
    rng = np.random.default_rng(seed)
    for stage in STAGES:
        names = stage.over(family)
        if stage.output not in forces:
            report.leave(f"no {stage.output} measured", names)
            continue
        chosen = _choose(stage, points, forces[stage.output])
        if chosen.size < max(_FEWEST_POINTS, len(names)):
            why = "no" if chosen.size == 0 else f"only {chosen.size} points of"
            report.leave(f"{why} {_POINTS_OF[stage.points]}", names)
            continue
        if chosen.size > _MOST_POINTS:
            chosen = np.sort(rng.choice(chosen, _MOST_POINTS, replace=False))
        here = {name: x[chosen] for name, x in points.items()}
        if stage.points in ("lateral", "longitudinal"):
            here["slip_ratio" if stage.points == "lateral" else "slip_angle"] *= 0.0
        left_out = open_coefficients(names, here, base["FNOMIN"])
        closed = {name for group in left_out.values() for name in group}
        typical = {n: kept_value(n, model, True) for n in sorted(closed)}
        model = model.replace(**{n: value for n, value in typical.items() if value != 0.0})
        for reason, group in left_out.items():
            report.leave(reason, group, typical if start is None else None)
        active = [name for name in names if name not in closed]
        if stage.braking_alone:
            chosen = np.union1d(chosen, _braking_alone(points, forces[stage.output], chosen.size))
            here = {name: x[chosen] for name, x in points.items()}
        measured = forces[stage.output][chosen]
        with threadpool_limits(1):  # many small problems: threads in each only get in each other's way
            values, fit, removed = _fit_stage(
                stage, model, active, here, measured, starts, loss, rng, start is not None
            )
        kept = {n: kept_value(n, model, start is not None) for n in removed}
        model = model.replace(**values, **{n: value for n, value in kept.items() if value != 0.0})
        report.add(stage, values, fit, kept if start is None else dict.fromkeys(removed, 0.0))
        if fit.drawn:
            towards = "what tires are like" if start is None else "the start model"
            report.notes.append(
                f"{stage.title}: {measured.size} points are few for {len(values)} coefficients, "
                f"which are drawn towards {towards}"
            )
    if model.coefficients.get("PKY1", -1.0) > 0 and "fy" in forces:
        notes.append(
            "a positive slip angle gives a positive Fy: the data are not in ISO axes, nor is the model"
        )
    table, shares = residual_table(model, points, forces), relative_rms(model, points, forces)
    return FitResult(model, report.errors, table, report.undetermined, notes, shares)


class _Report:
    """What the stages have to say, gathered."""

    def __init__(self, kept: str, notes: list[str]) -> None:
        self.kept = kept
        self.notes = notes
        self.errors: dict[str, float] = {}
        self.undetermined: list[str] = []

    def leave(self, reason: str, names: Sequence[str], at: Mapping[str, float] | None = None) -> None:
        """Note coefficients that are not fitted, and where they stay if not at 0 or at their start."""
        typical = {n: at[n] for n in names if at and at[n] != 0.0}
        zero = [n for n in names if n not in typical]
        parts = [f"{', '.join(zero)} kept at {self.kept}"] if zero else []
        parts += [f"{n} kept at {value:g}" for n, value in typical.items()]
        self.undetermined.append(f"{reason}: {', '.join(parts)}")

    def add(
        self, stage: Stage, values: Mapping[str, float], fit: StageFit, removed: Mapping[str, float]
    ) -> None:
        """Note what a stage has found."""
        self.errors.update(zip(values, fit.errors.tolist(), strict=True))
        if removed:
            self.leave(f"{stage.title} does not depend on them enough", list(removed), removed)
        if fit.at_bound:
            self.notes.append(f"{stage.title}: {', '.join(fit.at_bound)} at the bound")


def _columns(
    recording: pd.DataFrame, start: TireModel | None
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    if "normal_load" not in recording:
        raise RecordingError("there is no normal_load", todo="name the load's column normal_load, in newtons")
    wanted = [name for name in ("fx", "fy", "mx", "my", "mz") if name in recording]
    if not wanted:
        raise RecordingError("there is no force or moment to fit", todo="name them fx, fy, mx, my, mz")
    load = recording["normal_load"].to_numpy(dtype=float)
    good = np.isfinite(load) & (load > 0)
    points = {}
    for name in _INPUTS:
        missing = np.nan if name in ("speed", "pressure") else 0.0
        column = recording[name].to_numpy(dtype=float) if name in recording else np.full(load.size, missing)
        if name in recording:
            good &= np.isfinite(column)
        points[name] = column
    if int(good.sum()) < _FEWEST_POINTS:
        raise RecordingError(
            f"only {int(good.sum())} points have a positive load and finite slips",
            todo=f"give at least {_FEWEST_POINTS}",
        )
    forces = {name: recording[name].to_numpy(dtype=float)[good] for name in wanted}
    kept = {
        name: value
        for name, value in forces.items()
        if np.isfinite(value).any() and np.nanmax(np.abs(value)) > 0
    }
    return {name: x[good].copy() for name, x in points.items()}, kept


def _base(
    recording: pd.DataFrame,
    version: str,
    start: TireModel | None,
    points: Mapping[str, np.ndarray],
    nominal_load: float | None,
    unloaded_radius: float | None,
) -> tuple[dict[str, float], list[str]]:
    """Return the coefficients that are known before any fit, and what was assumed."""
    notes: list[str] = []
    base: dict[str, float] = {}
    if start is not None:
        begin = start.to_version(version)
        begin = begin if nominal_load is None else begin.nominal_load_changed(nominal_load)
        base.update(begin.coefficients)
    median = float(np.median(points["normal_load"]))
    if nominal_load is None:
        nominal_load = base.get("FNOMIN", float(f"{median:.2g}"))
        if start is None:
            notes.append(f"FNOMIN = {nominal_load:g} N is the median load to two digits")
    base["FNOMIN"] = float(nominal_load)
    if unloaded_radius is None and "UNLOADED_RADIUS" not in base:
        unloaded_radius = _radius_of(recording)
        if unloaded_radius is None:
            unloaded_radius = 0.3
            notes.append("UNLOADED_RADIUS = 0.3 m is assumed; the moments' coefficients are relative to it")
    if unloaded_radius is not None:
        base["UNLOADED_RADIUS"] = float(unloaded_radius)
    base.setdefault("LONGVL", _median(points["speed"], 16.7))
    if family_of(version) == 6:
        base.setdefault("NOMPRES", _median(points["pressure"], 220_000.0))
        base.setdefault("INFLPRES", base["NOMPRES"])
    return base, notes


def _radius_of(recording: pd.DataFrame) -> float | None:
    constants = recording.attrs.get("constants", {})
    entry = constants.get("OVALLDIA") if isinstance(constants, Mapping) else None
    if not isinstance(entry, Mapping) or not isinstance(entry.get("value"), int | float):
        return None
    factor = {"mm": 1e-3, "m": 1.0, "cm": 1e-2, "inch": 0.0254}.get(str(entry.get("unit")))
    return None if factor is None else 0.5 * factor * float(entry["value"])


def _median(x: np.ndarray, otherwise: float) -> float:
    finite = x[np.isfinite(x)]
    return float(np.median(finite)) if finite.size else otherwise


def _filled(x: np.ndarray, value: float) -> np.ndarray:
    return np.where(np.isfinite(x), x, value)


def _choose(stage: Stage, points: Mapping[str, np.ndarray], measured: np.ndarray) -> np.ndarray:
    rolling, straight = _pure(points)
    which = np.isfinite(measured)
    if stage.points == "lateral":
        which &= rolling
    elif stage.points == "longitudinal":
        which &= straight
        if not (which & ~rolling).any():
            which &= False
    elif stage.points == "combined":
        which &= ~rolling & ~straight
    return np.flatnonzero(which)


def _pure(points: Mapping[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Which points roll freely, and which have no slip angle."""
    rolling = np.abs(points["slip_ratio"]) <= stages.PURE_SLIP_RATIO
    return rolling, np.abs(points["slip_angle"]) <= stages.PURE_SLIP_ANGLE


def _braking_alone(points: Mapping[str, np.ndarray], fy: np.ndarray, most: int) -> np.ndarray:
    """Return points at pure longitudinal slip, spread over the recording.

    They show the side force that braking or driving makes (RVY1 to RVY6). Combined slip measured at a few
    slip angles leaves it open between them.
    """
    rolling, straight = _pure(points)
    rows = np.flatnonzero(np.isfinite(fy) & straight & ~rolling)
    return rows[:: max(1, -(-rows.size // most))]


def _fit_stage(
    stage: Stage,
    model: TireModel,
    active: list[str],
    here: Mapping[str, np.ndarray],
    measured: np.ndarray,
    starts: int,
    loss: str,
    rng: np.random.Generator,
    from_start: bool,
) -> tuple[dict[str, float], StageFit, list[str]]:
    """Fit a stage; drop, one by one, the coefficients that the data leave open."""
    typical = typical_values(active, model, from_start)
    first = dict(typical) if from_start else first_values(stage, typical, here, measured)
    if "PKY1" in typical:
        typical["PKY1"] = float(np.copysign(typical["PKY1"], first["PKY1"]))
    vector = model.packed.copy()
    for name in active:
        vector[INDEX[name]] = first[name]
    rows = [np.ascontiguousarray(here[name]) for name in _INPUTS]
    removed: list[str] = []
    number = starts
    while True:
        names = [name for name in active if name not in removed]
        bounds = bounds_of(names, first)
        drawn = pull(names, typical, measured)
        problem = Problem(vector, model.family, stage.output, names, rows, measured, drawn)
        fit = solve(problem, bounds, starting_points(names, first, bounds, number, rng), loss)
        if not fit.open or len(removed) >= _MOST_REMOVED or len(names) == 1:
            break
        ranges = (bounds[1] - bounds[0])[[names.index(name) for name in fit.open]]
        sizes = np.nan_to_num(fit.errors[[names.index(name) for name in fit.open]] / ranges, nan=np.inf)
        worst = fit.open[int(np.argmax(sizes))]
        removed.append(worst)
        vector[INDEX[worst]] = first[worst] = kept_value(worst, model, from_start)
        first.update({n: float(v) for n, v in zip(names, fit.values, strict=True) if n != worst})
        number = 1
    return dict(zip(names, fit.values.tolist(), strict=True)), fit, removed
