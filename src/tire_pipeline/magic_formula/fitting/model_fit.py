"""From a recording to a tire model, stage by stage."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from tire_pipeline.channels import TANGENTIAL_FORCES
from tire_pipeline.magic_formula.equations.equations_61 import cornering_stiffness
from tire_pipeline.magic_formula.fitting.least_squares.pressure import PRESSURE_SLACK
from tire_pipeline.magic_formula.fitting.output_fit import fit_together
from tire_pipeline.magic_formula.fitting.report.result import FitResult
from tire_pipeline.magic_formula.fitting.report.statistics import relative_rms, residual_table
from tire_pipeline.magic_formula.fitting.report.verdict import PoorFitWarning, poor_outputs
from tire_pipeline.magic_formula.fitting.setup import given
from tire_pipeline.magic_formula.fitting.setup.arguments import check_arguments
from tire_pipeline.magic_formula.fitting.setup.coverage import ONE_PRESSURE, PRESSURE_WITH_LOAD
from tire_pipeline.magic_formula.fitting.setup.lone_points import without_lone_points
from tire_pipeline.magic_formula.fitting.setup.measured import FEWEST_POINTS, columns
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import STAGES, Stage
from tire_pipeline.magic_formula.fitting.setup.typical import FEW_POINTS
from tire_pipeline.magic_formula.fitting.setup.unlike_tires import braked_at_no_slip, unlike_tires
from tire_pipeline.magic_formula.fitting.stage_fit import Options, Outcome, fit_stage
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.coefficients import Coefficients
from tire_pipeline.pages.numbers_in_words import in_digits

_MOST_FITTED_POINTS = 20_000
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
    starts: int = 40,
    loss: str = "soft_l1",
    seed: int = 0,
    together: bool = True,
) -> FitResult:
    """Fit a Magic Formula tire model to measurements.

    Parameters
    ----------
    recording : DataFrame
        Columns by canonical name in SI units: ``normal_load``, some of ``slip_angle``, ``slip_ratio``,
        ``camber``, ``speed``, ``pressure``, and some of ``fx``, ``fy``, ``mx``, ``my``, ``mz``. What is
        missing of the former is taken as 0 (speed and pressure as their nominal values); what is missing of
        the latter is not fitted. Steady state: remove transients first.
    version : str
        The version to fit.
    start : TireModel, optional
        Where to start from; what the data cannot determine keeps its values. Else typical values, and zero.
    nominal_load : float, optional
        ``FNOMIN`` (N); that of ``start``, or the median load to two digits.
    unloaded_radius : float, optional
        ``UNLOADED_RADIUS`` (m); that of ``start``, or the recording's (TYDEX ``OVALLDIA``), or
        ``ASSUMED_RADIUS``, which ``notes`` then says.
    starts : int
        Number of starting points of each stage; the best result is kept.
    loss : str
        A robust loss of :func:`scipy.optimize.least_squares`, or "linear".
    seed : int
        For the starting points.
    together : bool
        Whether all points of an output are fitted at once where its stages, one on top of the other, leave
        clearly more than that would.

    Returns
    -------
    FitResult
        ``.model`` is the TireModel; ``.forces(...)`` is the model's.

    Raises
    ------
    RecordingError
        If there is no load, no force or moment, or there are fewer than ten points; if a column holds text,
        or is there twice. It names the channel and the row.
    DomainError
        If an argument is none that can be used; it names the argument.
    TirValueError
        If ``unloaded_radius`` is no tire's.
    TirVersionError
        If the version is not known.

    Warns
    -----
    PoorFitWarning
        If the fit leaves more than 10% of an output's largest magnitude, its force falls with slip in the
        tire's own convention, or no tire has such a friction, load, pressure or radius; with the likely
        reason. ``poor`` and the summary of the result say so, too.

    Notes
    -----
    The stages: Fy, Fx and Mz at pure slip, then at combined slip, Mx, My (thesis, Appendix A, and Pacejka's
    appendix on the estimation of parameters). The model reproduces the recording's own signs: data in which a
    positive slip angle causes a positive Fy lead to a positive PKY1, and a note.

    See Also
    --------
    FitResult : What it returns.
    tire_pipeline.recordings.read_recording : Measurements from a file.

    Examples
    --------
    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.magic_formula import TireModel
    >>> tire = TireModel.from_coefficients(
    ...     {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}
    ... )
    >>> angles, loads = np.meshgrid(np.linspace(-0.2, 0.2, 41), [2000.0, 4000.0, 6000.0])
    >>> points = pd.DataFrame({"slip_angle": angles.ravel(), "normal_load": loads.ravel()})
    >>> points["fy"] = tire.forces(slip_angle=points["slip_angle"], normal_load=points["normal_load"]).fy
    >>> fit = fit_magic_formula(points, starts=1)
    >>> bool(fit.relative_rms["fy"] < 1e-3)
    True
    """
    check_arguments(start, nominal_load, unloaded_radius, starts, loss, seed)
    points, forces, left_out, said = columns(recording, version)
    base, notes = given.base(recording, version, start, points, nominal_load, unloaded_radius)
    unlike, small = unlike_tires(recording, points, base, start is not None or nominal_load is not None)
    if not unlike and "fx" in forces and not points["slip_ratio"].any():
        braked = braked_at_no_slip(points["normal_load"], forces["fx"])
        unlike = (
            f"{braked}: record the slip of braking and driving, or leave out such rows." if braked else ""
        )
    points["speed"] = given.filled(points["speed"], base["LONGVL"])
    points["pressure"] = given.filled(points["pressure"], base.get("NOMPRES", 0.0))
    model = TireModel.from_coefficients(base, version)
    forces, lone = without_lone_points(points, forces)
    notes += [*said, *lone, *small]
    report = _FitNotes(notes, start is not None)
    options = Options(starts, loss, start is not None, np.random.default_rng(seed), together)
    with threadpool_limits(1):  # many small problems: threads in each only get in each other's way
        simpler = None
        if model.family == 6 and start is None:
            simpler = _as_52(base, points, forces, options).to_version(version)
        model = _stages(model, points, forces, options, report, simpler)
    if model.coefficients.get("PKY1", -1.0) > 0 and "fy" in forces:
        notes.append(
            "a positive slip angle gives a positive Fy: the data are not in ISO axes, nor is the model; turn "
            "the sign of slip_angle, or those of fy and mz, as the rig's manual says, before you use it"
        )
    table, shares = residual_table(model, points, forces), relative_rms(model, points, forces)
    measured = pd.DataFrame({**points, **forces})
    poor = poor_outputs(model, points, forces, shares, report.fitted, start, report.at_bound, unlike)
    for output, text in poor.items():
        warnings.warn(f"{output}: {text}", PoorFitWarning, stacklevel=2)
    return FitResult(
        model,
        report.errors,
        table,
        report.undetermined,
        notes,
        shares,
        measured,
        poor,
        sorted({*forces, *left_out} - report.fitted),
    )


def _stages(
    model: TireModel,
    points: Mapping[str, np.ndarray],
    forces: Mapping[str, np.ndarray],
    options: Options,
    report: _FitNotes,
    simpler: TireModel | None,
) -> TireModel:
    """Go through the outputs, each on top of those before: stage by stage, then all stages together."""
    for output, stages in groupby(STAGES, key=lambda stage: stage.output):
        done: list[tuple[Stage, Outcome]] = []
        rows: list[int] = []
        for stage in stages:
            names = stage.over(model.family)
            if output not in forces:
                report.leave(f"no {output.capitalize()} measured", names)
                continue
            chosen = given.choose(stage, points, forces[output])
            if chosen.size < FEWEST_POINTS and output in TANGENTIAL_FORCES:
                both, said = given.from_combined(stage, points, forces[output])
                if both.size >= FEWEST_POINTS:
                    chosen = np.union1d(chosen, both)
                    report.notes.append(said)
            if chosen.size < FEWEST_POINTS:
                why = "no" if chosen.size == 0 else f"only {chosen.size} points of"
                report.leave(f"{why} {_POINTS_OF[stage.points]}", names)
                continue
            outcome = _one_stage(stage, names, _thinned(chosen), model, points, forces, options, simpler)
            model = _with(model, outcome)
            done.append((stage, outcome))
            rows.append(outcome.problem.measured.size)
        outcomes = [outcome for _, outcome in done]
        if len(done) > 1 and options.together:
            chosen = _thinned(np.flatnonzero(np.isfinite(forces[output])))
            here = {name: x[chosen] for name, x in points.items()}
            measured = forces[output][chosen]
            seeds, bar = _seeds(simpler, output, here, measured)
            outcomes = fit_together(outcomes, model, here, measured, options, seeds, bar)
        for (stage, _), outcome, number in zip(done, outcomes, rows, strict=True):
            model = _with(model, outcome)
            report.add(stage, outcome, number)
    return model


def _one_stage(
    stage: Stage,
    names: Sequence[str],
    chosen: np.ndarray,
    model: TireModel,
    points: Mapping[str, np.ndarray],
    forces: Mapping[str, np.ndarray],
    options: Options,
    simpler: TireModel | None,
) -> Outcome:
    """Fit a stage to its rows."""
    ranges = {name: x[chosen] for name, x in points.items()}
    if stage.braking_alone:
        chosen = np.union1d(chosen, given.braking_alone(points, forces[stage.output], chosen.size))
    here = {name: x[chosen] for name, x in points.items()}
    if stage.points in ("lateral", "longitudinal"):
        other = "slip_ratio" if stage.points == "lateral" else "slip_angle"
        here[other] *= float(given.stands_off_zero(other, here, np.full(chosen.size, True)))
    measured = forces[stage.output][chosen]
    seeds, bar = _seeds(simpler, stage.output, here, measured)
    return fit_stage(stage, names, model, here, measured, ranges, options, seeds, bar)


def _seeds(
    simpler: TireModel | None, output: str, here: Mapping[str, Any], measured: np.ndarray
) -> tuple[list[TireModel], float]:
    """Return a simpler formula's model to start from, and the RMS that it leaves, with a little more."""
    if simpler is None:
        return [], np.inf
    found = simpler.forces(**here, limits="ignore", outputs=(output,))
    left = float(np.sqrt(np.mean((getattr(found, output) - measured) ** 2)))
    return [_camber_shift_moved(simpler)], 1.01 * left


def _with(model: TireModel, outcome: Outcome) -> TireModel:
    """Return the model with what a stage found."""
    kept = {n: v for group in outcome.kept.values() for n, v in group.items() if v != 0.0}
    return model.replace(**outcome.values, **kept)


def _as_52(
    base: Mapping[str, float],
    points: Mapping[str, np.ndarray],
    forces: Mapping[str, np.ndarray],
    options: Options,
) -> TireModel:
    """Return the fit of 5.2, from which one of 6.x starts: it has to be as good."""
    plain = TireModel.from_coefficients(
        {n: v for n, v in base.items() if n not in ("NOMPRES", "INFLPRES")}, "5.2"
    )
    return _stages(plain, points, forces, options, _FitNotes([], False), None).replace(
        **{n: base[n] for n in ("NOMPRES", "INFLPRES")}
    )


def _camber_shift_moved(model: TireModel) -> TireModel:
    """Return a 6.x model from 5.2 with PHY3 moved into PKY6: the same shift at the nominal load."""
    if not {"PHY3", "PKY1", "PKY2"} <= set(model.coefficients):
        return model
    p: Any = Coefficients(*model.packed.tolist())
    stiffness = float(cornering_stiffness(p, 0.0, p.FNOMIN, 0.0, p.FNOMIN, 1.0)) / p.FNOMIN
    return model.replace(PHY3=0.0, PKY6=p.PKY6 + p.PHY3 * stiffness)


def _thinned(rows: np.ndarray) -> np.ndarray:
    """Return no more rows than a stage needs, evenly spread."""
    if rows.size <= _MOST_FITTED_POINTS:
        return rows
    return rows[np.linspace(0, rows.size - 1, _MOST_FITTED_POINTS).round().astype(int)]


class _FitNotes:
    """What the stages have to say, gathered."""

    def __init__(self, notes: list[str], from_start: bool) -> None:
        self.notes = notes
        self.from_start = from_start
        self.errors: dict[str, float] = {}
        self.undetermined: list[str] = []
        self.fitted: set[str] = set()
        self.at_bound: list[str] = []
        self._together: dict[tuple[str, str], tuple[int, list[str]]] = {}

    def leave(self, reason: str, names: Sequence[str], at: Mapping[str, float] | None = None) -> None:
        """Note coefficients that are not fitted, and where they stay if not at 0 or at their start."""
        typical = {} if self.from_start else {n: at[n] for n in names if at and at[n] != 0.0}
        rest = [n for n in names if n not in typical]
        where = f" kept at {'their start values' if self.from_start else '0'}"
        if rest and not typical:
            self._leave_together(reason, rest, where)
            return
        parts = [f"{', '.join(rest)}{where}"] if rest else []
        parts += [f"{n} kept at {value:g}" for n, value in typical.items()]
        self.undetermined.append(f"{reason}: {', '.join(parts)}")

    def _leave_together(self, reason: str, names: Sequence[str], where: str) -> None:
        """Note coefficients beside those that another stage left at the same value for the same reason."""
        if (reason, where) not in self._together:
            self._together[reason, where] = (len(self.undetermined), [])
            self.undetermined.append("")
        place, every = self._together[reason, where]
        every += names
        self.undetermined[place] = f"{reason}: {', '.join(every)}{where}"

    def add(self, stage: Stage, outcome: Outcome, rows: int) -> None:
        """Note what a stage has found."""
        self.fitted.add(stage.output)
        self.errors.update(zip(outcome.values, outcome.fit.errors.tolist(), strict=True))
        for reason, kept in outcome.kept.items():
            self.leave(reason, list(kept), kept)
        towards = "the start model" if self.from_start else "typical values"
        for reason, names in outcome.released.items():
            self.undetermined.append(
                f"{reason}: {', '.join(names)} held near {towards}, except where the points demand otherwise"
                + _unlike_tires(outcome, names)
                + _said_of_pressure(outcome, reason)
            )
        drawn = [n for n in outcome.fit.open if not any(n in group for group in outcome.released.values())]
        if drawn:
            self.undetermined.append(
                f"{stage.title} says little about {', '.join(drawn)}: held near {towards}"
            )
        self.at_bound += outcome.fit.at_bound
        if outcome.fit.at_bound:
            self.notes.append(
                f"{stage.title}: {', '.join(outcome.fit.at_bound)} ended at the bound of what tires have"
            )
        if rows < FEW_POINTS * len(outcome.values):
            self.notes.append(
                f"{stage.title}: {rows} points are few for {len(outcome.values)} coefficients, "
                f"which are drawn to {towards}"
            )


def _said_of_pressure(outcome: Outcome, reason: str) -> str:
    """Say what coefficients of pressure are worth that the recorded pressures cannot determine."""
    if not outcome.without_pressure or reason not in (ONE_PRESSURE, PRESSURE_WITH_LOAD):
        return ""
    worth, most = (in_digits(100.0 * x) for x in (outcome.without_pressure, PRESSURE_SLACK))
    return (
        f". Typical values would leave {worth}% more than the least, these leave {most}% more: they stand "
        "for whatever changed along with the pressure; a fit without the column pressure keeps typical values"
    )


def _unlike_tires(outcome: Outcome, names: Sequence[str]) -> str:
    """Name coefficients that the ranges cannot determine and that are farther off than tires differ."""
    drawn = outcome.problem.pull
    rows = zip(outcome.problem.names, drawn.centre.tolist(), drawn.spread.tolist(), strict=True)
    far = [
        f"{name} = {outcome.values[name]:.3g} (tires: {centre:.2g} ± {spread:.2g})"
        for name, centre, spread in rows
        if name in names and abs(outcome.values[name] - centre) > spread
    ]
    where = "the model holds only at the slips, loads, cambers, pressures and speeds that were recorded"
    return f". {', '.join(far)}: {where}" if far else ""
