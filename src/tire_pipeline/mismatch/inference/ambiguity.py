"""Which other effects would look the same in this recording: by the angle between what they do."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.gates import unsure
from tire_pipeline.mismatch.inference.refit import Fit, refit
from tire_pipeline.mismatch.inference.search import Search, gain_of, objective, prune, with_shapes
from tire_pipeline.mismatch.model.candidates import Variant, screening_columns
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import simulate

Array = np.ndarray
_NEAREST, _FAR = 4, 0.35
"""So many effects are fitted in the place of an accepted one, and none that is further apart."""
_MOST = 2


@dataclass(frozen=True)
class Rival:
    """An effect that could stand in for an accepted one.

    Parameters
    ----------
    name : str
    apart : float
        Share of the accepted effect's part that the rival cannot imitate (squared sine of the
        angle between them, in the metric of the noise).
    log_evidence : float
        How much likelier the accepted effect should be, from that angle and its size.
    lost : float
        How much likelier it is, both fitted.
    unsure : float
        Evidence that the accepted effect's own form may get wrong.
    dearer : float
        How much of ``lost`` is the price of its further parameters: a reason to name it second, none to
        exclude it.
    untold : float
        Log evidence that counts for nothing, because the channel that would tell the two apart does not vary:
        what the forms of both get wrong.
    """

    name: str
    apart: float
    log_evidence: float
    lost: float
    unsure: float = 0.0
    dearer: float = 0.0
    untold: float = 0.0

    @property
    def possible(self) -> bool:
        """Whether the recording cannot exclude it: by the angle and its size, or being nearly as likely."""
        if self.lost < max(settings.ODDS, self.untold):
            return True
        by_design = (
            self.log_evidence < settings.AMBIGUITY_LOG_EVIDENCE or self.apart < settings.AMBIGUITY_SHARE
        )
        near = settings.AMBIGUITY_LOG_EVIDENCE if self.unsure > 0.0 else settings.TIE
        least = max(near, settings.AMBIGUITY_LOST * self.log_evidence, self.unsure)
        return by_design and self.lost - self.dearer < least


def rivals(search: Search, index: int) -> list[Rival]:
    """Compare effect number ``index`` of the accepted set with all others, nearest first.

    By a system with the shapes of the other accepted effects.
    """
    fit, data = search.fit, search.data
    changes = fit.changes
    rest = fit.others(index)
    others = [v for j, v in enumerate(fit.variants) if j != index]
    whole, without = simulate(data, changes), simulate(data, rest)
    part = {o: whole[o] - without[o] for o in data.outputs}
    system = with_shapes(search, search.system, rest)
    size = system.reduce(system.sums(part))[2]
    best: dict[str, tuple[float, Variant]] = {}
    for v in search.variants:
        if v.name in fit.names:
            continue
        columns = screening_columns(data, rest, v)
        if columns[data.outputs[0]].shape[1] == 0:
            continue
        info, score, _ = system.reduce(system.sums(part, columns))
        explained = _explained(info, score)
        apart = float(np.clip(1.0 - explained / max(size, 1e-12), 0.0, 1.0))
        if v.name not in best or apart < best[v.name][0]:
            best[v.name] = (apart, v)
    empty = objective(system, rest)
    own = gain_of(search, fit.judged_by(system), empty)
    out = []
    untold = {name: share * own for name in best if (share := _untold(data, fit.names[index], name))}
    for rank, (name, (_, v)) in enumerate(sorted(best.items(), key=lambda t: t[1][0])):
        if name not in untold and (rank >= _NEAREST or best[name][0] > _FAR):
            continue
        trial = prune(search, refit(search.system, [*others, v]))
        trial = trial.judged_by(system)
        apart = _apart(search, system, trial, part, size, name)
        log_evidence = 0.5 * apart * size / search.inflation
        lost = own - gain_of(search, trial, empty)
        dearer = search.price * max(trial.parameters - fit.parameters, 0)
        doubt = unsure(search, index, name)
        out.append(Rival(name, apart, log_evidence, lost, doubt, dearer, untold.get(name, 0.0)))
    return sorted(out, key=lambda r: r.apart)


def alternatives(near: list[Rival]) -> tuple[str, ...]:
    """Return the names of the possible rivals, the likeliest first, at most two: more would be no answer."""
    return tuple(r.name for r in sorted(near, key=lambda r: r.lost) if r.possible)[:_MOST]


def _untold(data: Data, name: str, other: str) -> float:
    """Share of the evidence between two effects that counts for nothing, by the channel that would tell.

    None of it if the channel varies. If it stands still, what their forms get wrong. If it was not recorded,
    one of them follows a channel that is imagined.
    """
    channel = catalogue()[name].told_by.get(other) or catalogue()[other].told_by.get(name)
    if channel is None or data.varies(channel):
        return 0.0
    return settings.SHAPE_SHARE if channel in data.present else settings.IMAGINED_SHARE


def _apart(
    search: Search, system: System, trial: Fit, part: dict[str, Array], size: float, name: str
) -> float:
    """Share of a part that the rival's fitted form, with its derivatives, does not span."""
    data = search.data
    i = trial.names.index(name)
    whole = simulate(data, trial.changes)
    without = simulate(data, trial.others(i))
    own = [k for k, (j, _) in enumerate(trial.labels) if j == i]
    columns = {o: np.column_stack([whole[o] - without[o], trial.columns[o][:, own]]) for o in data.outputs}
    info, score, _ = system.reduce(system.sums(part, columns))
    return float(np.clip(1.0 - _explained(info, score) / max(size, 1e-12), 0.0, 1.0))


def _explained(info: Array, score: Array) -> float:
    scale = np.sqrt(np.maximum(np.diag(info), 1e-300))
    m = info / scale[:, None] / scale[None, :]
    s = score / scale
    return float(s @ np.linalg.lstsq(m + 1e-9 * np.eye(s.size), s, rcond=1e-9)[0])


def experiment(name: str, names: list[str]) -> str:
    """Return what to record to separate an effect from its rivals."""
    effect = catalogue()[name]
    reasons = []
    for other in names:
        why = effect.looks_like.get(other) or catalogue()[other].looks_like.get(name)
        if why:
            reasons.append(why)
    because = f" ({'; '.join(reasons)})" if reasons else ""
    return f"To separate {name} from {', '.join(names)}: {effect.experiment}{because}."
