"""State of one explanation: noise, misfit, and the set of effects that is named."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field, replace

import numpy as np

from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.discrepancy.noise import ForceNoise, estimate_noise, refined
from tire_pipeline.mismatch.discrepancy.nuisance.columns import Sizes, largest_force, make_nuisance
from tire_pipeline.mismatch.discrepancy.nuisance.sizes import PATH_SHARES, SHARES, nuisance_scale
from tire_pipeline.mismatch.inference.linearised_set import Fit
from tire_pipeline.mismatch.model.blocks import sweeps
from tire_pipeline.mismatch.model.candidates import Variant, variants
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
_LAGS_OF_COLOUR = 12
"""Samples over which a whitened residual may be alike."""


@dataclass(frozen=True)
class Analysis:
    """One recording, and how its samples are weighed.

    Parameters
    ----------
    data : Data
    noise : dict of ForceNoise
    block : ndarray of int, shape (n,)
        Sweep of each sample.
    columns : dict of ndarray, shape (n, q)
        Nuisance columns, N: changes of coefficients, and the formula's misfit.
    sizes : dict of Sizes
        How many of these columns are coefficients and how many misfit.
    system : System
        Sums of whitened products.
    misfit, path : float
        Likeliest sizes of the misfit, and of its difference between rising and falling slip, over the largest
        force.
    inflation : float
        How many whitened samples count as one independent sample.
    variants : list of Variant
        All forms of all effects that this recording can show.
    absent : dict of str
        Effect -> why it cannot be looked for.
    largest : dict of float
        Largest force of each output, N.
    fit : Fit
        The set that is named.
    """

    data: Data
    noise: dict[str, ForceNoise]
    block: Array
    columns: dict[str, Array]
    sizes: dict[str, Sizes]
    system: System
    misfit: float
    path: float
    inflation: float
    variants: list[Variant]
    absent: dict[str, str]
    largest: dict[str, float]
    fit: Fit = field(default_factory=lambda: Fit([], []))


def analyse(data: Data, without: Collection[str] = ()) -> Analysis:
    """Estimate noise and misfit, and set up the sums.

    Parameters
    ----------
    data : Data
    without : collection of str
        Effects that are not looked for, as if the catalogue lacked them.
    """
    rest = residual(data, [])
    noise = estimate_noise(data, rest)
    block = sweeps(data)
    found, absent = variants(data)
    found = [v for v in found if v.name not in without]
    absent |= dict.fromkeys(without, "it was taken out of the catalogue")
    nuisance = make_nuisance(data)
    scale = nuisance_scale(nuisance.sizes, SHARES[0], PATH_SHARES[0])
    first = Analysis(
        data=data,
        noise=noise,
        block=block,
        columns=nuisance.columns,
        sizes=nuisance.sizes,
        system=System(data, noise, block, nuisance.columns, scale),
        misfit=SHARES[-1],
        path=PATH_SHARES[0],
        inflation=1.0,
        variants=found,
        absent=absent,
        largest={o: largest_force(data, o) for o in data.outputs},
    )
    return with_fit(first, first.fit)


def with_fit(analysis: Analysis, fit: Fit) -> Analysis:
    """Return the analysis with another set named: its residual gives noise and misfit."""
    weighed = _rescaled(replace(analysis, fit=fit))
    data, rest = weighed.data, residual(weighed.data, fit.changes)
    c = weighed.system.fitted(rest, fit.columns if fit.labels else None)
    calm = {o: r - weighed.columns[o] @ c[o] for o, r in rest.items()}
    noise = {o: refined(data, n, calm[o]) for o, n in estimate_noise(data, calm).items()}
    system = System(data, noise, weighed.block, weighed.columns, weighed.system.scale)
    return _rescaled(replace(weighed, noise=noise, system=system))


def _rescaled(analysis: Analysis) -> Analysis:
    """Give the flexible form its likeliest size, given the residual of the named effects."""
    base = analysis.system
    rest = residual(analysis.data, analysis.fit.changes)
    sums = base.sums(rest)
    depends = any(size.path for size in analysis.sizes.values())
    trials = []
    for share in SHARES:
        for path in PATH_SHARES if depends else PATH_SHARES[:1]:
            trial = base.rescaled(nuisance_scale(analysis.sizes, share, path))
            trials.append((trial.reduce(sums)[2], trial.log_determinant(), share, path))
    inflation, out = analysis.inflation, analysis
    for _ in range(2):  # the size depends on the inflation, and the other way round
        _, share, path = max((-0.5 * left / inflation - 0.5 * det, s, p) for left, det, s, p in trials)
        system = base.rescaled(nuisance_scale(analysis.sizes, share, path))
        left = system.left(rest, analysis.fit.columns or None)
        inflation = inflation_of(left, in_time=analysis.data.time is not None)
        out = replace(analysis, system=system, misfit=share, path=path, inflation=inflation)
    return out


def inflation_of(left: dict[str, Array], *, in_time: bool) -> float:
    """How many whitened samples count as one: the size and correlation that the noise model missed.

    The size is the mean square, not a robust one: residuals of real rigs have longer tails than normal noise,
    and each sample counts by its square.

    Parameters
    ----------
    left : dict of ndarray, shape (n,)
        Whitened residual of each output, in the order of time.
    in_time : bool
        Whether neighbouring samples are neighbours in time.
    """
    total, weight = 0.0, 0.0
    for x in left.values():
        power, colour = float(np.mean(x**2)), 1.0
        if in_time:
            for k in range(1, _LAGS_OF_COLOUR + 1):
                value = float(np.mean(x[k:] * x[:-k])) / max(power, 1e-12)
                if value * np.sqrt(x.size) < 1.0:  # no more than white noise has
                    break
                colour += 2.0 * value
        total += max(power, 0.5) * colour
        weight += 1.0
    return float(np.clip(total / weight, 1.0, 1.0 + 2.0 * _LAGS_OF_COLOUR))
