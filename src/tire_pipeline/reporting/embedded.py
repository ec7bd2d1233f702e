"""Data inside a page: compressed, and encoded so that it cannot close an element."""

from __future__ import annotations

import base64
import json
import zlib
from typing import Any

import numpy as np

LEVELS = 1000
"""Steps from zero to the largest value of a curve: finer than a screen shows."""


def packed_json(value: Any) -> str:
    """Compress a JSON value (zlib, base64); browsers open it by ``DecompressionStream("deflate")``."""
    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return packed_bytes(text.encode("utf-8"))


def packed_bytes(content: bytes) -> str:
    """Compress bytes (zlib, base64)."""
    return base64.b64encode(zlib.compress(content, 9)).decode("ascii")


def quantised(curves: np.ndarray, scale: np.ndarray) -> bytes:
    """Quantise curves, for :func:`packed_bytes`.

    Parameters
    ----------
    curves : ndarray, shape (..., s)
        NaN counts as 0.
    scale : ndarray, shape (...)
        Largest size of the values of each curve.

    Returns
    -------
    bytes
        Second differences along the last axis of ``curves / scale`` in steps of 1 / ``LEVELS``, as int16: all
        low bytes, then all high ones. The first two values stand as they are, and as first difference.
    """
    steps = np.nan_to_num(curves / np.where(scale > 0, scale, 1.0)[..., None]) * LEVELS
    values = np.rint(steps).astype(np.int64)
    for _ in range(2):
        values = np.diff(values, axis=-1, prepend=0)
    flat = values.astype("<i2").reshape(-1).view(np.uint8).reshape(-1, 2)
    return flat.T.tobytes()


def data_element(name: str, value: Any) -> str:
    """JSON as the content of ``<script type="application/json">``: no ``<``, ``>`` or ``&`` stands in it."""
    text = json.dumps(value, separators=(",", ":"), allow_nan=False)
    for each in "<>&":
        text = text.replace(each, f"\\u{ord(each):04x}")
    return f'<script type="application/json" id="{name}">{text}</script>'
