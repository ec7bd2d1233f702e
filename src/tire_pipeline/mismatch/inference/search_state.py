"""What a search knows of one recording: noise, misfit, accepted effects; and how its weights are set."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.discrepancy.noise import Noise, estimate_noise, refined
from tire_pipeline.mismatch.discrepancy.nuisance import Sizes, largest_force, make_nuisance
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.refit import Fit
from tire_pipeline.mismatch.model.blocks import sweeps
from tire_pipeline.mismatch.model.candidates import Variant, variants
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.residual import residual

if TYPE_CHECKING:
    from tire_pipeline.mismatch.inference.doubts import Doubt
    from tire_pipeline.mismatch.inference.gates import Gates

Array = np.ndarray


@dataclass
class Search:
    """State of a search over one recording."""

    data: Data
    noise: dict[str, Noise]
    block: Array
    system: System
    loose: System
    inflation: float
    variants: list[Variant]
    absent: dict[str, str]
    largest: dict[str, float]
    misfit: float
    fit: Fit
    frozen: System = None  # type: ignore[assignment]
    columns: dict[str, Array] = field(default_factory=dict)
    sizes: dict[str, Sizes] = field(default_factory=dict)
    path: float = 0.0
    first_noise: dict[str, Noise] = field(default_factory=dict)
    gates: list[Gates] = field(default_factory=list)
    screened: dict[str, float] = field(default_factory=dict)
    refused: dict[str, str] = field(default_factory=dict)
    nearly: set[str] = field(default_factory=set)
    first: list[tuple[float, Variant]] = field(default_factory=list)
    unnamed: str = ""
    withdrawn: list[str] = field(default_factory=list)
    doubted: dict[int, Fit] = field(default_factory=dict)
    likelier: frozenset[str] = frozenset()
    doubts: list[Doubt] = field(default_factory=list)
    log: list[str] = field(default_factory=list)

    @property
    def price(self) -> float:
        """Log evidence that one more parameter costs."""
        rows = self.data.size * len(self.data.outputs)
        return 0.5 * float(np.log(max(rows / self.inflation, 8.0)))


def begin(data: Data, without: Collection[str] = ()) -> Search:
    """Estimate noise and misfit, and set up the sums.

    Parameters
    ----------
    data : Data
    without : collection of str
        Effects that are not looked for, as if the catalogue lacked them.
    """
    rest = {o: data.recorded[o] - data.base[o] for o in data.outputs}
    noise = estimate_noise(data, rest)
    block = sweeps(data)
    found, absent = variants(data)
    found = [v for v in found if v.name not in without]
    absent |= dict.fromkeys(without, "it was taken out of the catalogue")
    search = Search(
        data=data,
        noise=noise,
        block=block,
        system=None,  # type: ignore[arg-type]
        loose=None,  # type: ignore[arg-type]
        inflation=1.0,
        variants=found,
        absent=absent,
        largest={o: largest_force(data, o) for o in data.outputs},
        misfit=settings.MISFIT_SHARES[-1],
        fit=Fit([], []),
    )
    _assemble(search)
    return search


def _assemble(search: Search) -> None:
    """Build the nuisance columns, and the system with noise estimated without what they explain."""
    nuisance = make_nuisance(search.data)
    search.columns, search.sizes = nuisance.columns, nuisance.sizes
    _weigh(search)
    search.noise = search.first_noise = noise_beside(search)
    _weigh(search)


def nuisance_scale(
    sizes: dict[str, Sizes], share: float, path: float, factor: float = 1.0, memory: float | None = None
) -> dict[str, Array]:
    """Prior standard deviations of the nuisance columns for a size of the flexible form.

    Parameters
    ----------
    sizes : dict
        For each output the numbers of columns.
    share : float
        Size of the flexible form, over the largest force.
    path : float
        Size of its dependence on the way to a point, over the largest force.
    factor : float
        On what the coefficients may move.
    memory : float, optional
        How far friction may follow the power of the last seconds; as far as ``path`` if left out.
    """
    part = min(settings.COEFFICIENT_PART * share, settings.COEFFICIENT_MOST)
    move = factor * max(settings.COEFFICIENT_SHARE, part)
    scales = [move, share, path, path if memory is None else memory, settings.FAST_SHARE]
    return {o: np.repeat(scales, size) for o, size in sizes.items()}


def _weigh(search: Search) -> None:
    """Whiten by the noise as it is known now."""
    start = nuisance_scale(search.sizes, settings.MISFIT_SHARES[0], settings.PATH_SHARES[0])
    search.system = System(search.data, search.noise, search.block, search.columns, start)
    rescale(search)


def renoise(search: Search) -> None:
    """Take what the accepted effects show not to be noise off it, and set the weights again.

    Only a noise that is plainly smaller is taken: what effects leave may not pass for noise. Beside an effect
    that counts as noise until it is in, any that is smaller: it has another colour then, too.
    """
    now = noise_beside(search)
    share = 1.0 if of_noise(search.fit.names) else settings.CALMER
    most = {o: share * n.floor for o, n in search.first_noise.items()}
    chosen = {o: n if n.floor < most[o] else search.first_noise[o] for o, n in now.items()}
    if all(chosen[o] is search.noise[o] for o in chosen):
        rescale(search)
        return
    search.noise = chosen
    _weigh(search)


def of_noise(names: Iterable[str]) -> bool:
    """Whether one of some effects counts as noise until it is in."""
    return any(catalogue()[name].as_noise for name in names)


def noise_beside(search: Search) -> dict[str, Noise]:
    """Estimate the noise from what effects and nuisance leave: what they explain is not noise."""
    rest = residual(search.data, search.fit.changes)
    c = search.loose.fitted(rest, search.fit.columns if search.fit.labels else None)
    calm = {o: r - search.columns[o] @ c[o] for o, r in rest.items()}
    first = estimate_noise(search.data, calm)
    return {o: refined(search.data, n, calm[o]) for o, n in first.items()}


def beside(search: Search, fit: Fit) -> Search:
    """Return the search as it would be with a set in: the misfit's sizes learnt from what the set leaves.

    What an effect does must not pass for misfit while the effect itself is judged.
    """
    out = replace(search, fit=fit)
    rescale(out)
    return out


def log_likelihood(search: Search, changes: Sequence[Change], inflation: float) -> float:
    """Log marginal likelihood of a set of effects as it stands, with the sizes that a search has learnt."""
    left = search.system.reduce(search.system.sums(residual(search.data, changes)))[2]
    return -0.5 * left / inflation - 0.5 * search.system.log_determinant()


def rescale(search: Search) -> None:
    """Take the likeliest size of the flexible form for what the accepted effects leave."""
    base = search.system
    sums = base.sums(residual(search.data, search.fit.changes))
    depends_on_path = any(size.path for size in search.sizes.values())
    paths = settings.PATH_SHARES if depends_on_path else settings.PATH_SHARES[:1]
    trials = []
    for share in settings.MISFIT_SHARES:
        for path in paths:
            trial = base.rescaled(nuisance_scale(search.sizes, share, path))
            trials.append((trial.reduce(sums)[2], trial.log_determinant(), share, path))
    for _ in range(2):  # the size depends on the inflation, and the other way round
        weighed = [
            (-0.5 * left / search.inflation - 0.5 * determinant, share, path)
            for left, determinant, share, path in trials
        ]
        best = max([(-np.inf, settings.MISFIT_SHARES[0], paths[0]), *weighed])
        before = (search.misfit, search.path, search.inflation)
        _, search.misfit, search.path = best
        search.system = base.rescaled(nuisance_scale(search.sizes, *best[1:]))
        at_least = max(search.misfit, settings.LOOSE_SHARE)
        free = (settings.PATH_SHARES[-1], settings.LOOSE, settings.LOOSE_MEMORY)
        search.loose = base.rescaled(nuisance_scale(search.sizes, at_least, *free))
        search.frozen = base.rescaled(nuisance_scale(search.sizes, *best[1:], 1e-3))
        search.inflation = _inflation(search)
        if before[:2] == best[1:] and abs(before[2] / search.inflation - 1.0) < 0.2:
            break


def _inflation(search: Search) -> float:
    """How many whitened samples make one independent one, of what is left beside loose coefficients."""
    left = search.loose.left(residual(search.data, search.fit.changes), search.fit.columns or None)
    return inflation_of(left, in_time=search.data.time is not None)


def inflation_of(left: dict[str, Array], *, in_time: bool) -> float:
    """How many whitened samples make one independent one: size and colour that the noise model missed.

    The size is that of the power, not of the middle: what real rigs leave has longer tails than normal noise,
    and each sample counts by its square.

    Parameters
    ----------
    left : dict of ndarray, shape (n,)
        Whitened residual of each output, in the order of time.
    in_time : bool
        Whether neighbours are neighbours in time.
    """
    total, weight = 0.0, 0.0
    for white in left.values():
        size = float(np.median(white**2) / 0.4549)
        x = np.clip(white, -4.0 * np.sqrt(size), 4.0 * np.sqrt(size))
        colour = 1.0
        if in_time:
            lags = [float(np.mean(x[k:] * x[:-k])) / max(float(np.mean(x**2)), 1e-12) for k in range(1, 13)]
            for value in lags:
                if value < 0.02:
                    break
                colour += 2.0 * value
        total += max(float(np.mean(x**2)), 0.5) * colour
        weight += 1.0
    return float(np.clip(total / weight, 1.0, 25.0))
