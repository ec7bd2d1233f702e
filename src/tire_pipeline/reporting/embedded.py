"""Data inside a page: compressed, as text that can end no element; and what is allowed to run there."""

from __future__ import annotations

import base64
import hashlib
import json
import unicodedata
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


def visible(text: object) -> str:
    """Give a text from a file as it can be shown: control and direction characters by their code points."""
    return "".join(
        f"⟨U+{ord(each):04X}⟩" if unicodedata.category(each) in _UNSEEN and each != "\n" else each
        for each in str(text)
    )


_UNSEEN = ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp")


def data_element(name: str, value: Any) -> str:
    """JSON as the content of ``<script type="application/json">``: no ``<``, ``>`` or ``&`` stands in it."""
    text = json.dumps(value, separators=(",", ":"), allow_nan=False)
    for each in "<>&":
        text = text.replace(each, f"\\u{ord(each):04x}")
    return f'<script type="application/json" id="{name}">{text}</script>'


def source_hash(text: str) -> str:
    """Hash of a script or style as a content security policy names it."""
    digest = hashlib.sha256(text.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(digest).decode('ascii')}'"


def policy(script: str, style: str) -> str:
    """Allow one script and one style, and nothing else from anywhere."""
    return (
        f"default-src 'none'; script-src {source_hash(script)}; style-src {source_hash(style)}; "
        "base-uri 'none'; form-action 'none'"
    )
