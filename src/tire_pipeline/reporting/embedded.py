"""Data inside a page: compressed, and encoded so that it cannot close an element."""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

_BASE64_BYTES = 3
"""So many bytes become four letters, whatever follows."""
LEVELS = 1000
"""Steps from zero to the largest value of a curve: finer than a screen shows."""


def packed_json(value: Any) -> str:
    """Compress a JSON value (zlib, base64); browsers open it by ``DecompressionStream("deflate")``."""
    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return packed_bytes(text.encode("utf-8"))


def packed_bytes(content: bytes) -> str:
    """Compress bytes (zlib, base64)."""
    return base64.b64encode(zlib.compress(content, 9)).decode("ascii")


def packed_json_list(values: Iterable[Any]) -> Iterator[str]:
    """JSON of what :func:`packed_json` makes of a list, in pieces: not all of the list is in memory."""
    pack, left = zlib.compressobj(9), b""
    yield '"'
    for piece in json_list(values, ensure_ascii=False):
        left += pack.compress(piece.encode("utf-8"))
        whole = len(left) - len(left) % _BASE64_BYTES
        yield base64.b64encode(left[:whole]).decode("ascii")
        left = left[whole:]
    yield base64.b64encode(left + pack.flush()).decode("ascii")
    yield '"'


def json_list(values: Iterable[Any], *, ensure_ascii: bool = True) -> Iterator[str]:
    """JSON of a list in pieces, an entry each."""
    before = "["
    for value in values:
        yield before + json.dumps(value, separators=(",", ":"), ensure_ascii=ensure_ascii, allow_nan=False)
        before = ","
    yield "[]" if before == "[" else "]"


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
    return "".join(_element(name, [_json(value)]))


def data_element_in_pieces(name: str, entries: Mapping[str, Any]) -> Iterator[str]:
    """The same of an object, in pieces. A value that is an iterator gives the pieces of its own JSON."""

    def content() -> Iterator[str]:
        before = "{"
        for key, value in entries.items():
            yield f"{before}{_json(key)}:"
            yield from value if isinstance(value, Iterator) else [_json(value)]
            before = ","
        yield "}"

    yield from _element(name, content())


def _element(name: str, content: Iterable[str]) -> Iterator[str]:
    yield f'<script type="application/json" id="{name}">'
    for piece in content:
        for each in "<>&":
            piece = piece.replace(each, f"\\u{ord(each):04x}")
        yield piece
    yield "</script>"


def _json(value: Any) -> str:
    return json.dumps(value, separators=(",", ":"), allow_nan=False)
