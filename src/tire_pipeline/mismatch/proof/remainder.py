"""What is left above the noise after the effects: where, how large, and an unnamed form."""

from __future__ import annotations

import warnings

import numpy as np

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.gaussian_form import GaussianForm, gaussian_form
from tire_pipeline.mismatch.discrepancy.noise import estimate_noise
from tire_pipeline.mismatch.inference.restart import excess, white_left
from tire_pipeline.mismatch.inference.search import Search
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.locate import locate
from tire_pipeline.mismatch.proof.measured import Remainder

Array = np.ndarray
_MOST_TERMS = 5


def remainder(search: Search) -> Remainder:
    """Measure what neither the effects nor a misfit of the usual size explains."""
    data, fit = search.data, search.fit
    left = white_left(search)
    statistic, log_evidence = excess(search, left)
    rest = residual(data, fit.changes)
    sensor = estimate_noise(data, rest)  # what changes slowly is noise to the search, but not a sensor's
    size = {}
    for o, r in rest.items():
        floor = min(sensor[o].floor, search.noise[o].floor)
        size[o] = float(np.sqrt(max(float(np.mean(r**2)) - floor**2, 0.0)))
    share = max(size[o] / search.largest[o] for o in data.outputs)
    stated = any(f"{o}_std" in data.channels for o in data.outputs)
    above = not stated or any(size[o] > 0.5 * search.noise[o].floor for o in data.outputs)
    much = statistic > settings.REMAINDER_LIMIT and log_evidence > settings.REMAINDER_LOG_EVIDENCE
    significant = (above and much) or share > settings.REMAINDER_SHARE
    plain = {o: left[o] * search.noise[o].sigma for o in data.outputs}
    located = locate(data, plain, search.noise, search.block) if significant else []
    form = sparse_form(search) if significant else ""
    gaussian = gaussian_forms(search, size) if significant else []
    return Remainder(size, located, form, bool(significant), statistic, log_evidence, gaussian)


def gaussian_forms(search: Search, size: dict[str, float]) -> list[GaussianForm]:
    """Return a Gaussian process for each output that has something left, the largest first."""
    rest = residual(search.data, search.fit.changes)
    order = sorted(size, key=lambda o: -size[o])
    wanted = [o for o in order if o == order[0] or size[o] > 0.5 * search.noise[o].floor]
    forms = [gaussian_form(search.data, rest[o], o, search.block, search.noise[o].floor) for o in wanted]
    return [f for f in forms if f is not None]


def sparse_form(search: Search) -> str:
    """Return a sparse equation (PySINDy's sequentially thresholded least squares) for the remainder."""
    import pysindy

    data, fit = search.data, search.fit
    rest = residual(data, fit.changes)
    names = [n for n in ("slip_angle", "slip_ratio", "camber", "normal_load", "speed") if data.varies(n)]
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
        if np.count_nonzero(found) <= _MOST_TERMS:
            break
        threshold *= 1.6
    return found
