"""Columns of the effects: the change of the recording if a parameter changes a little."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tire_pipeline.mismatch.effects import Effect, catalogue
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate

Array = np.ndarray


@dataclass(frozen=True)
class Variant:
    """One form of one effect: where it starts and which parameters float."""

    name: str
    start: Mapping[str, float]
    free: tuple[str, ...]

    @property
    def effect(self) -> Effect:
        """The effect's description."""
        return catalogue()[self.name]


def variants(data: Data, names: Sequence[str] | None = None) -> tuple[list[Variant], dict[str, str]]:
    """Return all forms of all effects that this recording can show, and why others cannot be looked for."""
    out: list[Variant] = []
    absent: dict[str, str] = {}
    for name, effect in catalogue().items():
        if names is not None and name not in names:
            continue
        why = effect.absent(data)
        if why is not None:
            absent[name] = why
            continue
        for start in effect.starts(data):
            free = tuple(p for p in effect.free(data, start) if _acts(data, effect, p))
            if free:
                out.append(Variant(name, _within(effect, start), free))
    return out, absent


def _within(effect: Effect, start: Mapping[str, float]) -> dict[str, float]:
    """Return a start within the effect's bounds: five samples are no delay where 20 s lie between two."""
    bounds = {p.name: (p.low, p.high) for p in effect.parameters}
    return {n: float(np.clip(x, *bounds[n])) if n in bounds else x for n, x in start.items()}


def _acts(data: Data, effect: Effect, name: str) -> bool:
    parameter = effect.parameter(name)
    return parameter.output is None or parameter.output in data.outputs


def derivatives(
    data: Data,
    changes: Sequence[Change],
    index: int,
    free: Sequence[str],
    here: dict[str, Array] | None = None,
) -> Iterator[tuple[str, dict[str, Array]]]:
    """Yield d force / d parameter for the floating parameters of ``changes[index]``.

    Parameters
    ----------
    data : Data
    changes : sequence of (name, parameters)
        The effects that are in, with the parameters at which to differentiate.
    index : int
    free : sequence of str
    here : dict of ndarray, optional
        Forces with ``changes``, if they are known.
    """
    name, values = changes[index]
    here = simulate(data, changes) if here is None else here
    effect = catalogue()[name]
    for parameter in effect.parameters:
        if parameter.name not in free:
            continue
        at = values[parameter.name]
        h = parameter.step
        moved = dict(values)
        moved[parameter.name] = at + h if at + h <= parameter.high else at - h
        there = simulate(data, [*changes[:index], (name, moved), *changes[index + 1 :]])
        change = moved[parameter.name] - at
        yield parameter.name, {o: (there[o] - here[o]) / change for o in data.outputs}


def screening_columns(
    data: Data, changes: Sequence[Change], variant: Variant, now: dict[str, Array] | None = None
) -> dict[str, Array]:
    """Return the columns with which a form is screened, shape (n, k) for each output.

    At a start where the effect is absent these are the derivatives; elsewhere the whole difference
    that the start makes comes first.
    """
    now = simulate(data, changes) if now is None else now
    with_it = [*changes, (variant.name, dict(variant.start))]
    whole = simulate(data, with_it)
    parts: list[dict[str, Array]] = []
    size = {o: float(np.sqrt(np.mean((whole[o] - now[o]) ** 2))) for o in data.outputs}
    force = {o: float(np.sqrt(np.mean(now[o] ** 2))) for o in data.outputs}
    if any(size[o] > 1e-7 * max(force.values()) for o in data.outputs):
        parts.append({o: whole[o] - now[o] for o in data.outputs})
    free = [n for n in variant.free if n not in variant.effect.scanned]
    for name, column in derivatives(data, with_it, len(changes), free, whole):
        step = variant.effect.parameter(name).step
        parts.append({o: c * step for o, c in column.items()})
    if not parts:
        return {o: np.zeros((data.size, 0)) for o in data.outputs}
    return {o: np.column_stack([p[o] for p in parts]) for o in data.outputs}
