"""The residual above the noise after the effects: where, how large, and an unnamed form."""

from __future__ import annotations

import warnings
from collections.abc import Mapping

import numpy as np

from tire_pipeline.channels import SLIP_AND_LOAD
from tire_pipeline.mismatch.discrepancy.gaussian_form import GaussianForm, gaussian_form
from tire_pipeline.mismatch.discrepancy.noise import estimate_noise
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.sets.answer import LEVEL, SetAnswer
from tire_pipeline.mismatch.model.residual import residual, rms
from tire_pipeline.mismatch.proof.locate import locate
from tire_pipeline.mismatch.proof.measured import Remainder

Array = np.ndarray
_MOST_REMAINDER_TERMS = 5


def remainder(
    analysis: Analysis,
    answer: SetAnswer,
    usual: tuple[float, float],
    largest: Mapping[str, float],
    noise: Mapping[str, float],
) -> Remainder:
    """Measure what neither the effects nor a misfit of the usual size explains.

    It counts if the posterior says that something unnamed is likelier than not.

    Parameters
    ----------
    analysis : Analysis
    answer : SetAnswer
    usual : (float, float)
        Sizes of the error that fitted models usually leave, over the largest force.
    largest : mapping of float
        Largest force of each output by which the answer's errors are measured, N.
    noise : mapping of float
        Output -> RMS of the recording's noise, N.
    """
    data, fit = analysis.data, analysis.fit
    rest = residual(data, fit.changes)
    sensor = estimate_noise(data, rest)
    size = {}
    for o, r in rest.items():
        floor = min(sensor[o].floor, noise[o])
        size[o] = float(np.sqrt(max(float(np.mean(r**2)) - floor**2, 0.0)))
    significant = answer.agreement < LEVEL and (answer.unnamed > LEVEL or not answer.sets)
    located = locate(data, rest, analysis.noise, analysis.block) if significant else []
    form = sparse_form(analysis) if significant else ""
    gaussian = gaussian_forms(analysis, size) if significant else []
    whole = {o: rms(r) / largest[o] for o, r in rest.items()}
    capped = {o: min(left, whole[o]) for o, left in answer.left.items()}  # few samples leave its size open
    unusual = {o: left for o, left in capped.items() if left > usual[1]}
    return Remainder(size, located, form, significant, answer.unnamed, gaussian, unusual, usual)


def gaussian_forms(analysis: Analysis, size: dict[str, float]) -> list[GaussianForm]:
    """Return a Gaussian process for each output that has something left, the largest first."""
    rest = residual(analysis.data, analysis.fit.changes)
    order = sorted(size, key=lambda o: -size[o])
    wanted = [o for o in order if o == order[0] or size[o] > 0.5 * analysis.noise[o].floor]
    forms = [
        gaussian_form(analysis.data, rest[o], o, analysis.block, analysis.noise[o].floor) for o in wanted
    ]
    return [f for f in forms if f is not None]


def sparse_form(analysis: Analysis) -> str:
    """Return a sparse equation (PySINDy's sequentially thresholded least squares) for the remainder."""
    import pysindy

    data, fit = analysis.data, analysis.fit
    rest = residual(data, fit.changes)
    names = [n for n in (*SLIP_AND_LOAD, "speed") if data.varies(n)]
    columns, labels = [], []
    for n in names:
        x = data.smooth(n)
        scale = float(np.max(np.abs(x))) or 1.0
        columns.append(x / scale)
        labels.append(f"({n}/{scale:.3g})")
        if data.time is not None and n in ("slip_angle", "slip_ratio", "normal_load"):
            rate = np.gradient(x, data.time)
            size = float(np.quantile(np.abs(rate), 0.99)) or 1.0
            columns.append(np.clip(rate / size, -1.5, 1.5))
            labels.append(f"(d{n}/dt/{size:.3g})")
    if not columns:
        return ""
    step = max(1, data.size // 4000)
    x = np.column_stack(columns)[::step]
    library = pysindy.PolynomialLibrary(degree=2)
    features = np.asarray(library.fit_transform(x))
    terms = library.get_feature_names(labels)
    lines = []
    for o in data.outputs:
        found = _few_terms(features, rest[o][::step])
        text = " ".join(f"{c:+.3g} {t}".removesuffix(" 1") for c, t in zip(found, terms, strict=True) if c)
        if text:
            lines.append(f"{o} left = {text} N")
    return "; ".join(lines)


def _few_terms(features: Array, y: Array) -> Array:
    """Coefficients by thresholded least squares, the threshold raised until few terms are left."""
    import pysindy

    threshold = 0.25 * float(np.std(y))
    for _ in range(12):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            optimizer = pysindy.STLSQ(threshold=threshold, alpha=1e-3)
            optimizer.fit(features, y[:, None])
        found = np.ravel(optimizer.coef_)
        if np.count_nonzero(found) <= _MOST_REMAINDER_TERMS:
            break
        threshold *= 1.6
    return found
