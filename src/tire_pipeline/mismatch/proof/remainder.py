"""What is left above the noise after the effects: where, how large, and an unnamed form."""

from __future__ import annotations

import warnings

import numpy as np

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.gaussian_form import gaussian_form
from tire_pipeline.mismatch.discrepancy.noise import estimate_noise
from tire_pipeline.mismatch.inference.refit import residual
from tire_pipeline.mismatch.inference.search import Search, with_shapes
from tire_pipeline.mismatch.proof.locate import locate
from tire_pipeline.mismatch.report.result import GaussianForm, Remainder

Array = np.ndarray
_MOST_TERMS = 5


def remainder(search: Search) -> Remainder:
    """Measure what neither the effects nor a misfit of the usual size explains."""
    data, fit = search.data, search.fit
    left = white_left(search)
    statistic, nats = excess(search, left)
    rest = residual(data, fit.changes)
    sensor = estimate_noise(data, rest)  # what changes slowly is noise to the search, but not a sensor's
    size = {}
    for o, r in rest.items():
        floor = min(sensor[o].floor, search.noise[o].floor)
        size[o] = float(np.sqrt(max(float(np.mean(r**2)) - floor**2, 0.0)))
    share = max(size[o] / search.largest[o] for o in data.outputs)
    stated = any(f"{o}_std" in data.channels for o in data.outputs)
    above = not stated or any(size[o] > 0.5 * search.noise[o].floor for o in data.outputs)
    much = statistic > settings.REMAINDER_LIMIT and nats > settings.REMAINDER_NATS
    significant = (above and much) or share > settings.REMAINDER_SHARE
    plain = {o: left[o] * search.noise[o].sigma for o in data.outputs}
    located = locate(data, plain, search.noise, search.block) if significant else []
    form = sparse_form(search) if significant else ""
    gaussian = gaussian_forms(search, size) if significant else []
    return Remainder(size, located, form, bool(significant), statistic, nats, gaussian)


def white_left(search: Search) -> dict[str, Array]:
    """Return the whitened residual beside the effects, their form errors and nearly free coefficients."""
    fit = search.fit
    system = with_shapes(search, search.loose, fit.changes)
    return system.left(residual(search.data, fit.changes), fit.columns if fit.labels else None)


def gaussian_forms(search: Search, size: dict[str, float]) -> list[GaussianForm]:
    """Return a Gaussian process for each output that has something left, the largest first."""
    rest = residual(search.data, search.fit.changes)
    order = sorted(size, key=lambda o: -size[o])
    wanted = [o for o in order if o == order[0] or size[o] > 0.5 * search.noise[o].floor]
    forms = [gaussian_form(search.data, rest[o], o, search.block, search.noise[o].floor) for o in wanted]
    return [f for f in forms if f is not None]


def excess(search: Search, left: dict[str, Array]) -> tuple[float, float]:
    """Return how much power whitened residuals have beyond white noise, and what that is worth in log
    evidence.

    At each scale the samples are summed over windows; the mean square of the sums over that of
    noise as the search takes it (white, of the same robust size, times ``inflation``) is 1 for noise. The
    worst output and scale count.

    Where the recording states its uncertainty (``fy_std``, as :func:`axle_recording` does) neighbours share
    a filter and unknowns that are constant over a drive: slow changes are no evidence there, and only
    power beyond what is stated counts.
    """
    worst, nats = 1.0, 0.0
    for o, white in left.items():
        if f"{o}_std" in search.data.channels:
            ratio = float(np.mean(np.minimum(white**2, 25.0)))
            worst = max(worst, ratio)
            if ratio > 1.0:
                count = white.size / search.inflation
                nats = max(nats, 0.5 * count * (ratio - 1.0 - np.log(ratio)))
            continue
        size = float(np.median(white**2) / 0.4549)
        x = white / np.sqrt(max(size, 1e-12))
        for width in (1, 5, 12, 25, 60):
            n = x.size // width
            if n < 30:
                continue
            sums = x[: n * width].reshape(n, width).sum(axis=1) / np.sqrt(width)
            ratio = float(np.mean(np.minimum(sums**2, 25.0))) / search.inflation
            worst = max(worst, ratio)
            if ratio > 1.0:
                nats = max(nats, 0.5 * n * (ratio - 1.0 - np.log(ratio)))
    return worst, nats


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
