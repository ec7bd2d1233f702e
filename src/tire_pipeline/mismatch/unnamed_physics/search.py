"""From a residual to a proved equation, with its drivers, alternatives and ideas."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from tire_pipeline.channels import ALIGNING_MOMENT, FORCE_OF_SLIP, SLIP_AND_LOAD, TANGENTIAL_FORCES
from tire_pipeline.mismatch.inference.analysis import Analysis, with_fit
from tire_pipeline.mismatch.inference.linearised_set import Fit
from tire_pipeline.mismatch.inference.sets.answer import SetAnswer
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.model.channels import CLASSES, one_sided, span, white_noise
from tire_pipeline.mismatch.model.residual import residual, rms
from tire_pipeline.mismatch.proof.left_out import each_left_out
from tire_pipeline.mismatch.proof.never_worse import size_over_largest
from tire_pipeline.mismatch.unnamed_physics.against_names import Acting, NamesToBeat
from tire_pipeline.mismatch.unnamed_physics.choose import ChosenModels, choose
from tire_pipeline.mismatch.unnamed_physics.chosen_equation import (
    LISTED,
    ChosenEquation,
    alternatives,
    drivers_with_evidence,
    equations,
    intervals,
    ruled_out,
)
from tire_pipeline.mismatch.unnamed_physics.evidence import MOST_TERMS, Model
from tire_pipeline.mismatch.unnamed_physics.found import (
    CoefficientInterval,
    UnnamedPhysics,
    UnnamedReport,
)
from tire_pipeline.mismatch.unnamed_physics.ideas import matching
from tire_pipeline.mismatch.unnamed_physics.language.grammar import parse
from tire_pipeline.mismatch.unnamed_physics.language.symbols import CHANNEL, held_within
from tire_pipeline.mismatch.unnamed_physics.library import WAY, Term
from tire_pipeline.mismatch.unnamed_physics.problems.forces_residual import USUAL_MISFIT, coarsely, problem_of
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import Unexplained, by_condition, of_force
from tire_pipeline.mismatch.unnamed_physics.products import Columns
from tire_pipeline.mismatch.unnamed_physics.prove import (
    Proven,
    best_of,
    ceiling,
    forces_of,
    proven,
    surely_less,
)
from tire_pipeline.mismatch.unnamed_physics.where_it_holds import (
    distance,
    part_that_later_sweeps_confirm,
    way_through_play,
)

Array = np.ndarray
_Looked = tuple[Columns, ChosenModels, list[Proven]]
_MISFIT_IS_NOT = 0.5
"""Of an error squared, what one equation may leave: a misfit has many causes, and is not mostly of one."""
_ONE_SIDED = "the recording turns to one side, and no equation from it can be trusted on the other"
_NOT_PROVED = "no equation makes sweeps better that neither its choice nor its fit has seen"


def unnamed_physics(analysis: Analysis, *, plainly: bool = False) -> UnnamedReport:
    """Look for an equation of the unexplained residual, and prove it.

    Parameters
    ----------
    analysis : Analysis
        After the analysis. Where nothing is named, its noise and misfit are learnt here.
    plainly : bool
        Ask for more, because the residual might be the formula's usual misfit: the terms have to beat its
        flexible form in every size that the recording allows, so there is no coarse view, and they have to
        predict operating conditions that were not seen.
    """
    if not analysis.fit.names:
        analysis = with_fit(analysis, analysis.fit)
    problem = problem_of(analysis)
    if plainly:
        return find(by_condition(problem))
    return find(problem, coarsely(problem, analysis))


def unnamed_moment(problem: Unexplained, *, plainly: bool) -> UnnamedReport:
    """Look for an equation of the aligning moment's error, and prove it.

    Parameters
    ----------
    problem : Unexplained
        Of the moment.
    plainly : bool
        Ask for more, because the error might be the formula's usual misfit: the terms have to predict
        operating conditions that were not seen, and to remove most of the squared error there.
    """
    found = find(by_condition(problem) if plainly else problem)
    before, after, _ = found.unseen.get(ALIGNING_MOMENT, (1.0, 1.0, 1.0))
    if plainly and after**2 > _MISFIT_IS_NOT * before**2:
        return found.refused("it leaves most of an error that may be the formula's misfit")
    return found


def instead_of_names(analysis: Analysis, sets: Enumerated, answer: SetAnswer) -> UnnamedReport | None:
    """Return an equation that is likelier than the named effects and predicts unseen sweeps better, if any.

    An effect of the catalogue often resembles a part of what has no name, and then the posterior names it:
    it weighs no equation. Here an equation alone has to be likelier in the same likelihood than all sets that
    hold names. And chosen and fitted without some operating conditions, it has to leave surely less there
    than the named effects fitted without the same ones. The names stay if they leave less with an equation of
    their own residual: so a true cause keeps its name where something unnamed acts, too.

    Parameters
    ----------
    analysis : Analysis
        With the set that is named.
    sets : Enumerated
    answer : SetAnswer
    """
    columns = Columns(by_condition(problem_of(with_fit(analysis, Fit([], [])))))
    names = each_left_out(analysis, analysis.fit, together=columns.fold_of_sweep)
    found, left = _better(columns, NamesToBeat(names, sets, answer))
    if found is None or _stay(analysis, names, left):
        return None
    return replace(found, instead_of=tuple(analysis.fit.names))


def _stay(analysis: Analysis, names: Mapping[str, Array], alone: Mapping[str, Array]) -> bool:
    """Whether named effects and an equation of what they leave, N, leave less than an equation alone."""
    problem = by_condition(problem_of(analysis))
    proofs = proven(Columns(problem))
    added = proofs[best_of(proofs)].added
    beside = {o: left - added.get(o, 0.0) for o, left in names.items()}
    return size_over_largest(beside, problem.largest) < size_over_largest(alone, problem.largest)


def find_better(problem: Unexplained, rival: NamesToBeat) -> UnnamedReport | None:
    """The same against any rival."""
    return _better(Columns(problem), rival)[0]


def _better(columns: Columns, rival: NamesToBeat) -> tuple[UnnamedReport | None, dict[str, Array]]:
    """Return what is better than a rival, and what it leaves on unseen sweeps, N."""
    problem, choice = columns.problem, choose(columns)
    models = [m for k in range(MOST_TERMS) if (m := choice.best(k + 1)) is not None]
    if not any(
        surely_less(problem, rival.left, _left(problem, forces_of(columns, choice, m.terms)))
        and rival.less_likely_than([Acting(columns, [choice.terms[i] for i in m.terms], problem.outputs, m)])
        for m in models
    ):
        return None, {}  # not even where it was fitted
    parts = _parts([(columns, choice, proven(columns))])
    left = _left(problem, _added(parts))
    found = _reported(problem, parts)
    acting = [Acting(p.columns, p.terms, p.outputs, p.model) for p in parts if p.model is not None]
    if not surely_less(problem, rival.left, left) or not rival.less_likely_than(acting):
        return None, {}
    if found.physics is None or found.physics.of_one_recording:
        return None, {}  # an equation in time, or the way rolled, ends with its recording; a name does not
    return found, left


def _left(problem: Unexplained, added: Mapping[str, Array]) -> dict[str, Array]:
    """The residual after some forces are added, N."""
    return {o: rest - added.get(o, 0.0) for o, rest in problem.rest.items()}


def more_than_usual(analysis: Analysis) -> bool:
    """Whether the residual is larger than a fitted formula usually leaves, although nothing is significant.

    What repeats or changes slowly may pass for coloured noise, and what follows a channel for the formula's
    misfit. The noise here is that of neighbouring samples alone, and has to be left as much again.
    """
    for o, rest in residual(analysis.data, analysis.fit.changes).items():
        least = max(USUAL_MISFIT * analysis.largest[o], np.sqrt(2.0) * white_noise(rest))
        if float(np.sqrt(np.mean(rest**2))) > least:
            return True
    return False


def _one_sided(problem: Unexplained) -> bool:
    """Whether the slip angle goes to one side only, or nearly."""
    return "slip_angle" in problem.moves and one_sided(problem.table.columns["s"])


def find(*views: Unexplained) -> UnnamedReport:
    """The same from what any engine leaves.

    Parameters
    ----------
    views : Unexplained
        One recording, weighed in one way or in several. The one is taken whose choice does best on sweeps
        that it has not seen.
    """
    return _reported(views[0], _parts([_look(problem) for problem in views]))


def _reported(problem: Unexplained, parts: Sequence[ChosenEquation]) -> UnnamedReport:
    """Report what was found, with its equations if they are proved."""
    first = parts[0]
    shown = [(tuple(sorted(k)), p) for k, p in list(first.posterior.items())[:LISTED]]
    each = drivers_with_evidence(parts)
    if first.model is None:
        return UnnamedReport(None, "nothing in the library is worth its length", drivers=each, sets=shown)
    one_sided = _one_sided(problem)
    physics = _physics(problem, parts) if first.proof.holds and not one_sided else None
    terms = [t for p in parts for t in p.terms]
    return UnnamedReport(
        physics=physics,
        why_not="" if physics is not None else _ONE_SIDED if one_sided else _NOT_PROVED,
        drivers=each,
        independent_of={} if physics is None else ruled_out(parts),
        sets=shown,
        where=_where(terms),
        coefficients=[pair for p in parts for pair in p.coefficients],
        evidence=sum(p.model.evidence for p in parts if p.model is not None),
        alternatives=[other for p in parts for other in alternatives(p)],
        unseen={o: error for p in parts for o, error in _unseen(p).items()},
        better=min(p.proof.better for p in parts),
        sweeps=first.proof.sweeps,
        p_value=max(p.proof.p_value for p in parts),
        ideas=matching(frozenset[str]().union(*(p.drivers for p in parts)), terms),
        curve=_curve(first.columns, first.choice, first.model),
        later=min((_confirmed_later(p) for p in parts if "path" in p.drivers), default=1.0),
    )


def _confirmed_later(part: ChosenEquation) -> float:
    problem, outputs = part.columns.problem, part.outputs
    terms = [
        {o: column[o] for o in outputs} for t in part.terms if (column := part.columns.of(t)) is not None
    ]
    rest = {o: problem.rest[o] for o in outputs}
    return part_that_later_sweeps_confirm(terms, rest, problem.largest, problem.block)


def _parts(looked: Sequence[_Looked]) -> list[ChosenEquation]:
    """Look for one equation of all forces, then for an own one of each force that it does not make better.

    What acts on one force alone must not give way to a form that another force asks for.
    """
    whole, problem = _best_part(looked), looked[0][0].problem
    left = [o for o in problem.outputs if o not in whole.proof.outputs]
    if len(problem.outputs) == 1 or not left:
        return [whole]
    own = [_best_part([_look(of_force(problem, o))]) for o in left]
    kept = [part for part in (whole, *own) if part.model is not None and part.proof.holds]
    return kept or [whole]


def _added(parts: Sequence[ChosenEquation]) -> dict[str, Array]:
    """What is added to each force on unseen sweeps, N."""
    return {o: force for part in parts for o, force in part.proof.added.items()}


def _best_part(looked: Sequence[_Looked]) -> ChosenEquation:
    """Return the choice that does best on sweeps that it has not seen."""
    proofs = [proof for _, _, of_view in looked for proof in of_view]
    which = best_of(proofs)
    columns, choice, _ = looked[which // MOST_TERMS]
    if not proofs[which].holds:
        columns, choice, _ = next((each for each in looked if each[1].models), looked[0])
    return ChosenEquation(columns, choice, choice.best(which % MOST_TERMS + 1), proofs[which])


def _look(problem: Unexplained) -> _Looked:
    """Choose with all sweeps, and without each fold."""
    columns = Columns(problem)
    return columns, choose(columns), proven(columns)


def _physics(problem: Unexplained, parts: Sequence[ChosenEquation]) -> UnnamedPhysics | None:
    texts: dict[str, str] = {}
    sizes: dict[str, list[CoefficientInterval]] = {}
    for part in parts:
        if part.model is not None:
            texts |= equations(part.choice, part.model, part.proof.outputs)
            sizes |= intervals(part)
    if not texts:
        return None
    acts = ", ".join(dict.fromkeys(WAY[t.way].acts_on for p in parts for t in p.terms))
    drivers = tuple(sorted(frozenset[str]().union(*(p.drivers for p in parts))))
    plays = [way_through_play(f, problem.table) for p in parts for t in p.terms for f in t.factors]
    ranges = {**_ranges(problem, texts), **_together(parts), **dict(filter(None, plays))}
    return UnnamedPhysics(texts, drivers, acts, ranges, problem.nominal, sizes)


def _ranges(problem: Unexplained, texts: Mapping[str, str]) -> dict[str, tuple[float, float]]:
    """Return where an equation was seen to hold: what it names, and the slips and the load.

    The forces in it depend on slip and load. At a load that was not recorded nothing says that it holds.
    """
    used = frozenset[str]().union(*(parse(text).symbols for text in texts.values()))
    of_forces = {s for s in CHANNEL if CHANNEL[s] in FORCE_OF_SLIP and CHANNEL[s] in problem.moves} | {"L"}
    found = {}
    seen = used | of_forces | ({"t"} if "way" in used else set())
    for symbol in sorted(s for s in seen if s in CHANNEL):
        x = problem.table.columns[symbol]
        low, high = (x.min(), x.max()) if symbol == "t" else span(x)
        short = 0.5 * max(held_within(symbol, x) - (high - low), 0.0)
        found[symbol] = (float(low - short), float(high + short))
    return found


def _together(parts: Sequence[ChosenEquation]) -> dict[str, tuple[float, float]]:
    """Return how far the terms of each force were out together."""
    found = {}
    for part in parts:
        columns = [(term, part.columns.of(term) or {}) for term in part.terms]
        for o in part.proof.outputs:
            seen = distance({t.text(o): of[o] for t, of in columns if t.text(o) and o in of})
            if seen is not None:
                found[seen[0]] = (0.0, seen[1])
    return found


def _where(terms: list[Term]) -> str:
    """Whether it turns with slip and load, as a tire does, or with the clock, the way or a channel."""
    drivers = frozenset[str]().union(*(t.drivers for t in terms))
    kinds = {f.kind for t in terms for f in t.factors}
    if "path" in kinds:
        return "rig or wheel: it turns with the way rolled"
    if "time" in drivers:
        return "rig or surface: it goes with the clock"
    of_tire = set(SLIP_AND_LOAD)
    if all(d.removeprefix("memory of ") in of_tire | set(TANGENTIAL_FORCES) for d in drivers):
        return "tire or its mounting: it turns with slip and load"
    return f"it follows {', '.join(sorted(d for d in drivers if d not in of_tire))}"


def _unseen(part: ChosenEquation) -> dict[str, tuple[float, float, float]]:
    problem, predicted = part.columns.problem, part.proof.predicted
    most = ceiling(part.columns, part.terms)
    return {
        o: (rms(problem.rest[o]), rms(problem.rest[o] - predicted[o]), rms(problem.rest[o] - most[o]))
        for o in problem.outputs
    }


def _curve(columns: Columns, choice: ChosenModels, model: Model) -> dict[str, object]:
    """Means of the residual and of the fitted form over the equation's first factor."""
    problem = columns.problem
    forces = forces_of(columns, choice, model.terms)
    output = max(forces, key=lambda o: float(np.mean(forces[o] ** 2)))
    term = choice.terms[model.terms[0]]
    label = term.factors[-1].written if term.factors else WAY[term.way].base[output]
    x = columns.part(label)
    base = columns.part(WAY[term.way].base[output]) if output in WAY[term.way].base else None
    if x is None or base is None:
        return {}
    sign = np.sign(base)
    edges = np.unique(np.quantile(x, np.linspace(0.0, 1.0, CLASSES + 1)))
    if edges.size < 3:
        return {}
    at = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, edges.size - 2)
    count = np.maximum(np.bincount(at, minlength=edges.size - 1), 1)

    def mean(values: Array) -> list[float]:
        return [float(v) for v in np.bincount(at, values, edges.size - 1) / count]

    return {
        "output": output,
        "label": label,
        "x": mean(x),
        "left": mean(problem.rest[output] * sign),
        "fitted": mean(forces[output] * sign),
    }
