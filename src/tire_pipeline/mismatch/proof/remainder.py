"""The noise, and the residual above it after the effects: where, how large, and a Gaussian process for it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tire_pipeline.mismatch.discrepancy.gaussian_form import GaussianForm, gaussian_form
from tire_pipeline.mismatch.discrepancy.noise import estimate_noise, refined
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.sets.answer import LEVEL, SetAnswer
from tire_pipeline.mismatch.model.channels import white_noise
from tire_pipeline.mismatch.model.residual import residual, rms
from tire_pipeline.mismatch.proof.locate import locate
from tire_pipeline.mismatch.proof.measured import Remainder

Array = np.ndarray
_DEVIATION_SUFFIX = "_std"


def unexplained(answer: SetAnswer) -> bool:
    """Whether the posterior says that something unnamed is likelier than not."""
    return answer.agreement < LEVEL and (answer.unnamed > LEVEL or not answer.sets)


def unusual(
    analysis: Analysis, answer: SetAnswer, usual: float, largest: Mapping[str, float]
) -> dict[str, float]:
    """Return what is left of each output, over its largest force, where fitted models usually leave less.

    What differs from one sample to the next is noise, and no model leaves less of it.

    Parameters
    ----------
    analysis : Analysis
    answer : SetAnswer
    usual : float
        What fitted models leave at most, over the largest force.
    largest : mapping of float
        Largest force of each output by which the answer's errors are measured, N.
    """
    rest, in_time = residual(analysis.data, analysis.fit.changes), analysis.data.time is not None
    whole = {o: rms(r) / largest[o] for o, r in rest.items()}
    capped = {o: min(left, whole[o]) for o, left in answer.left.items()}  # few samples leave its size open
    noise = {o: white_noise(r) / largest[o] if in_time else 0.0 for o, r in rest.items()}
    return {o: left for o, left in capped.items() if left**2 - noise[o] ** 2 > usual**2}


def remainder(
    analysis: Analysis,
    answer: SetAnswer,
    usual: tuple[float, float],
    largest: Mapping[str, float],
) -> tuple[Remainder, dict[str, float]]:
    """Measure what neither the effects nor a misfit of the usual size explains; and the noise, N.

    Parameters
    ----------
    analysis : Analysis
    answer : SetAnswer
    usual : (float, float)
        Sizes of the error that fitted models usually leave, over the largest force.
    largest : mapping of float
        As for :func:`unusual`.
    """
    data, fit = analysis.data, analysis.fit
    significant, more = unexplained(answer), unusual(analysis, answer, usual[1], largest)
    noise = noise_floors(analysis, settled=not (significant or more))
    rest = residual(data, fit.changes)
    size = {o: float(np.sqrt(max(rms(r) ** 2 - noise[o] ** 2, 0.0))) for o, r in rest.items()}
    located = locate(data, rest, analysis.noise, analysis.block) if significant else []
    gaussian = gaussian_forms(analysis, size) if significant else []
    return Remainder(size, located, significant, answer.unnamed, gaussian, more, usual), noise


def gaussian_forms(analysis: Analysis, size: dict[str, float]) -> list[GaussianForm]:
    """Return a Gaussian process for each output that has something left, the largest first."""
    rest = residual(analysis.data, analysis.fit.changes)
    order = sorted(size, key=lambda o: -size[o])
    wanted = [o for o in order if o == order[0] or size[o] > 0.5 * analysis.noise[o].floor]
    forms = [
        gaussian_form(analysis.data, rest[o], o, analysis.block, analysis.noise[o].floor) for o in wanted
    ]
    return [f for f in forms if f is not None]


def noise_floors(analysis: Analysis, *, settled: bool) -> dict[str, float]:
    """Return the RMS of the noise of each output, N: at most what a smooth misfit leaves of the residual.

    Noise may be slow, and so may physics without a name. Where the residual is not settled, noise is
    therefore no more than what differs between neighbouring samples.

    A recording may state how uncertain its channels are (``fy_std``, ``slip_angle_std``). Samples are weighed
    by it, but it is no noise: much of it is the same throughout a drive, such as an axle mass or the place of
    a marker, and what of it changes is in the samples already.

    Parameters
    ----------
    analysis : Analysis
        With the set that is named.
    settled : bool
        Whether the residual is explained, or of a size that fitted models usually leave.
    """
    data, fit = analysis.data, analysis.fit
    rest = residual(data, fit.changes)
    smooth = analysis.system.fitted(rest, fit.columns if fit.labels else None)
    calm = {o: r - analysis.columns[o] @ smooth[o] for o, r in rest.items()}
    noise = analysis.noise
    if any(n.endswith(_DEVIATION_SUFFIX) for n in data.channels):
        seen = estimate_noise(data, calm, stated=False)
        noise = {o: refined(data, n, calm[o]) for o, n in seen.items()}
    floors = {o: min(n.floor, rms(calm[o]), rms(rest[o])) for o, n in noise.items()}
    if settled:
        return floors
    return {o: min(floors[o], n.floor) for o, n in estimate_noise(data, rest).items()}
