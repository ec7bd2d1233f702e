"""Fit the mixed model to the scores, one after the other."""

from __future__ import annotations

import numpy as np

from tire_pipeline.progress import track
from tire_pipeline.translation.curves.space import CurveSpace
from tire_pipeline.translation.population.category_spread import FEWEST_SHARED
from tire_pipeline.translation.population.evidence import log_odds_of_block
from tire_pipeline.translation.population.fit_space import Cells
from tire_pipeline.translation.population.mixed_effects import Design, Fitted, fit_mixed_effects
from tire_pipeline.translation.population.model import POPULATION
from tire_pipeline.translation.population.protocols.search import CLEAR

VARIANCE_GUESS = {
    "level": 100.0,
    "metadata": 0.1,
    "size": 0.05,
    "category": 0.1,
    "category_metadata": 0.01,
    "protocol": 0.03,
    POPULATION: 0.03,
    "category_kind": 0.01,
    "class": 0.5,
    "category_class": 0.01,
    "tire": 0.1,
}
"""Where the search for the variances begins, in units of a score's own variance."""

TIRE_CATEGORY_SHARE = {"shape": 2.0, "aligning": 9.0}
"""Variance of what one tire does in one category alone, over that of the noise, if no tire tells, by part.
The shape of a curve depends on what else was fitted; stiffness and friction hardly do."""

_OTHER_SHARE = 0.5

_POOLED_VARIANCES = ("category", "category_metadata", "category_kind", "category_class")
_POOLED_WIDTH = 1.0
_PRIOR_WIDTH = 3.0

CLASS_PARTS = {
    "cornering stiffness": 0,
    "lateral friction": 1,
    "slip stiffness": 2,
    "longitudinal friction": 1,
}
"""The parts whose scores tell classes of tires apart, and the property that each is of. Within a class
properties are taken to differ independently of each other: what links them is the class (latent
class analysis)."""


def makes_differ(design: Design, cells: Cells, space: CurveSpace, scale: np.ndarray) -> bool:
    """Whether suppliers' tires differ in stiffness or friction, and not only how suppliers measure them.

    It must be as clear as a change of protocol. Where tires are alike, or may be, all of them tell the bias,
    and not only those that several categories measured.

    Parameters
    ----------
    design : Design
        With the block :data:`.model.POPULATION` at its end.
    cells, space, scale
        As for :func:`fit_score`.
    """
    end = sum(block.shape[1] for block in design.blocks.values())
    place = slice(end - design.blocks[POPULATION].shape[1], end)
    telling = np.concatenate([np.arange(s.start, s.stop) for s in (space.slices[n] for n in CLASS_PARTS)])
    odds = 0.0
    for k in track(telling, "looking whether suppliers' tires differ"):
        fitted = fit_score(design, cells, space, scale, k, VARIANCE_GUESS)
        odds += log_odds_of_block(fitted, POPULATION, place)
    return odds > np.log(CLEAR / (1.0 - CLEAR))


def of_part(space: CurveSpace, k: int, values: dict[str, float], other: float) -> float:
    """Value of the part that score ``k`` belongs to, by a word of its name."""
    part = next(name for name, place in space.slices.items() if place.start <= k < place.stop)
    return next((value for word, value in values.items() if word in part), other)


def fit_scores(design: Design, cells: Cells, space: CurveSpace, scale: np.ndarray) -> tuple[Fitted, ...]:
    """Fit every score twice: the second time the size of the bias is expected as it was found in all of them.

    Six categories tell little about the variance of their effects on one score; all scores together do, but
    for those that tell nothing.
    """
    numbers = track(range(scale.size), "fitting each property of the curves")
    first = [fit_score(design, cells, space, scale, k, VARIANCE_GUESS) for k in numbers]
    noise = space.noise / scale**2
    tells = noise < 1.0  # of a score's own variance: others have noise alone, or were copied into all files
    tells |= not tells.any()
    common = {
        name: float(np.exp(np.mean(np.log(np.array([f.variances[name] for f in first]) / noise)[tells])))
        for name in _POOLED_VARIANCES
        if name in first[0].variances
    }
    guesses = [{**VARIANCE_GUESS, **{name: common[name] * one for name in common}} for one in noise]
    again = track(guesses, "fitting each with what all have in common")
    return tuple(
        fit_score(design, cells, space, scale, k, guess, tuple(common)) for k, guess in enumerate(again)
    )


def fit_score(
    design: Design,
    cells: Cells,
    space: CurveSpace,
    scale: np.ndarray,
    k: int,
    guess: dict[str, float],
    pooled: tuple[str, ...] = (),
    alone_known: bool = False,
) -> Fitted:
    """Fit one score.

    ``alone_known``: what a tire does in one category only is taken by its share of the noise.
    """
    noise = float(space.noise[k] / scale[k] ** 2)
    alone = of_part(space, k, TIRE_CATEGORY_SHARE, _OTHER_SHARE) * noise
    guess = {**guess, "tire_category": alone}
    estimated = design.tire.shape[1] >= FEWEST_SHARED and not alone_known
    return fit_mixed_effects(
        design,
        cells.scores[:, k] / scale[k],
        noise=noise,
        guess=guess,
        width={name: _POOLED_WIDTH if name in pooled else _PRIOR_WIDTH for name in guess},
        tire_category=None if estimated else alone,
    )
