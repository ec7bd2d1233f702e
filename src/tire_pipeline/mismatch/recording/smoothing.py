"""Sensor noise off the model's inputs: wavelets that are smaller than the noise shrink.

Noise of a slip channel goes through the model into the residual and, worse, into the columns of dynamic
effects: a delay of the wrong sign would explain some of it (errors in variables). Wavelets of all widths
follow what moves, a sweep that turns as well as a slow drift, and noise is the same in all of them: Donoho
and Johnstone, Ideal spatial adaptation by wavelet shrinkage, Biometrika 81 (1994) 425; a large one keeps its
size: Gao, Wavelet shrinkage denoising using the non-negative garrote, J. Comput. Graph. Stat. 7 (1998) 469.
"""

from __future__ import annotations

import numpy as np
import pywt
import scipy

Array = np.ndarray
_WAVELET = pywt.Wavelet("sym8")
_BEYOND_THE_ENDS = "antireflect"
"""A sweep goes on in its direction beyond the ends of a piece."""
_NOISE_ONLY = 1.5
"""A channel that spreads no wider than so many times its noise stands still."""


def denoise(x: Array, start: Array) -> Array:
    """Return the channel without its sensor noise.

    Parameters
    ----------
    x : ndarray, shape (n,)
    start : ndarray of bool, shape (n,)
        First samples of uninterrupted pieces.

    Returns
    -------
    ndarray, shape (n,)
        The mean where there is nothing but noise. Unchanged where pieces are too short for two levels of
        wavelets, or if the channel has no noise (a set point, or a channel held at a slower rate).
    """
    firsts = np.flatnonzero(start)
    pieces = [slice(*ends) for ends in zip(firsts, np.append(firsts[1:], x.size), strict=True)]
    long = [p for p in pieces if pywt.dwt_max_level(p.stop - p.start, _WAVELET) > 1]
    levels = [pywt.wavedec(x[piece], _WAVELET, _BEYOND_THE_ENDS) for piece in long]
    sigma = _noise(levels)
    if sigma <= np.finfo(float).eps * float(np.abs(x).max(initial=0.0)):
        return x
    if np.std(x) < _NOISE_ONLY * sigma:
        return np.full_like(x, np.mean(x))
    out = x.copy()
    for piece, (slowest, *faster) in zip(long, levels, strict=True):
        chance = sigma * np.sqrt(2.0 * np.log(x[piece].size))  # the largest of as many by chance
        kept = [slowest, *(pywt.threshold(level, chance, "garrote") for level in faster)]
        out[piece] = pywt.waverec(kept, _WAVELET, _BEYOND_THE_ENDS)[: x[piece].size]
    return out


def _noise(levels: list[list[Array]]) -> float:
    """Size of the noise, by the median wavelet of the second level; zero for a set point.

    Filters of sensors take more off the first level, of neighbouring samples.
    """
    if not levels:
        return 0.0
    second = np.concatenate([each[-2] for each in levels])
    return float(np.median(np.abs(second))) / scipy.stats.halfnorm.median()
