"""The search's input: the residual, and the likelihood in which it was weighed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tire_pipeline.mismatch.model.channels import least_spread
from tire_pipeline.mismatch.unnamed_physics.language.grammar import SymbolTable
from tire_pipeline.mismatch.unnamed_physics.language.symbols import CHANNEL, NominalValues

Array = np.ndarray
Outputs = Mapping[str, Array]

PRIOR_SIZE = 0.05
"""Standard deviation of what a term does, root mean square over the largest force."""
_HELD_CHANNELS = "gLvp"
"""Symbols of the channels that a schedule holds while it sweeps a slip."""


@dataclass(frozen=True)
class Unexplained:
    """The unexplained residual and how it is weighed: the only input of the search for unnamed physics.

    Parameters
    ----------
    table : SymbolTable
        Symbols that an equation may use.
    nominal : NominalValues
    moves : frozenset of str
        Channels that vary, ``time`` if there is a time line, and ``way`` if with it the way rolled is known.
    rest : mapping of ndarray, shape (n,)
        Output -> recorded force without what the model and the named effects give, N.
    largest : mapping of float
        Output -> largest force, N.
    block : ndarray of int, shape (n,)
        Sweep of each sample.
    order : ndarray of int, shape (n,)
        Rows in the order in which ``whiten`` returns them.
    whiten : callable
        Output, columns (n, k) in N -> the same with unit white noise, in ``order``.
    nuisance : mapping of ndarray, shape (n, q)
        Columns of what may be wrong without anything being left out, whitened, in ``order``.
    sizes : sequence of mapping of ndarray, shape (q,)
        Prior standard deviations of their coefficients: alternatives, the engine's own first.
    inflation : float
        Whitened samples that make one independent one.
    settled : bool
        Whether that number stands; else it is learnt beside the best terms.
    together : ndarray of int, shape (n,), optional
        Samples of one number are held out together; sweeps if left out.
    """

    table: SymbolTable
    nominal: NominalValues
    moves: frozenset[str]
    rest: Outputs
    largest: Mapping[str, float]
    block: Array
    order: Array
    whiten: Callable[[str, Array], Array]
    nuisance: Outputs
    sizes: Sequence[Outputs]
    inflation: float
    settled: bool = False
    together: Array | None = None

    @property
    def outputs(self) -> tuple[str, ...]:
        """Forces that were recorded."""
        return tuple(self.rest)


def by_condition(problem: Unexplained) -> Unexplained:
    """Return the same with whole operating conditions held out: all sweeps at one load, speed, camber ...

    What fits the sweeps of one condition also predicts its other sweeps, whatever it depends on. Only at a
    condition that was not seen does a false driver show. Where there is one condition only, sweeps are held
    out.
    """
    count = int(problem.block.max()) + 1
    level = np.zeros((count, len(_HELD_CHANNELS)))
    for j, symbol in enumerate(_HELD_CHANNELS):
        if CHANNEL[symbol] in problem.moves:
            x = problem.table.columns[symbol] / least_spread(CHANNEL[symbol], problem.table.columns[symbol])
            level[:, j] = [np.median(x[problem.block == b]) for b in range(count)]
    first: list[int] = []
    condition = np.zeros(count, int)
    for b in range(count):
        near = [k for k, a in enumerate(first) if np.max(np.abs(level[b] - level[a])) < 1.0]
        condition[b] = near[0] if near else len(first)
        first += [] if near else [b]
    return replace(problem, together=condition[problem.block]) if len(first) > 1 else problem


def of_force(problem: Unexplained, output: str) -> Unexplained:
    """Return the same of one force alone."""
    return replace(
        problem,
        rest={output: problem.rest[output]},
        nuisance={output: problem.nuisance[output]},
        sizes=[{output: size[output]} for size in problem.sizes],
    )
