"""Checks the elements of a MAT 5 file before a parser trusts it.

scipy's compiled parts look the type of an element up without asking whether there is such a type, and go into
nested cells as deep as the file says: a damaged file can crash the process there. So every element must be of
a known type, lie inside of the file, and hold what its array's class asks for (MATLAB's "MAT-File Format",
Level 5: an element is type, length, data; a matrix is flags, dimensions, name, and elements by class).
"""

from __future__ import annotations

import math
import struct
import zlib
from pathlib import Path

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.readers.limits import check_expansion

_HEADER_BYTES = 128
_COMPRESSED, _MATRIX = 15, 14
_BYTES_OF_TYPE = {1: 1, 2: 1, 3: 2, 4: 2, 5: 4, 6: 4, 7: 4, 9: 8, 12: 8, 13: 8, 16: 1, 17: 2, 18: 4}
_NAME_TYPES = (1, 16)
_INTEGERS = (5, 6)
_LETTERS = (1, 2, 3, 4, 16, 17, 18)
_CELL_ARRAY, _STRUCT, _OBJECT, _CHAR, _SPARSE, _FUNCTION, _OPAQUE = 1, 2, 3, 4, 5, 16, 17
_NUMBER_ARRAYS = range(6, 16)
_COMPLEX = 1 << 11
_DEEPEST_ARRAYS = 32
_MOST_DIMENSIONS = 32


def check_elements(path: Path) -> None:
    """Raise if the file is no whole MAT 5 file.

    Raises
    ------
    RecordingError
        A damaged element, one that is cut off, or content that is far larger than the file.
    """
    content = memoryview(path.read_bytes())
    order = {b"IM": "<", b"MI": ">"}.get(bytes(content[126:128]))
    at, unpacked = _HEADER_BYTES, 0
    try:
        if order is None:
            raise RecordingError("its byte order is unknown")
        while at < len(content):
            kind, length = _words(content, at, order)
            data = content[at + 8 : at + 8 + length]
            if len(data) < length:
                raise RecordingError("it is cut off")
            if kind == _COMPRESSED:
                data = memoryview(_unpacked(path, data, unpacked))
                unpacked += len(data)
                kind, _ = _words(data, 0, order)
                data = data[8:]
            if kind != _MATRIX:
                raise RecordingError(f"an element of type {kind} at byte {at}")
            _Matrix(data, order).check()
            at += 8 + length
    except RecordingError as error:
        if error.where is not None:
            raise
        raise RecordingError(f"damaged .mat file: {error.what}", where=str(path)) from error


def _words(content: memoryview, at: int, order: str) -> tuple[int, int]:
    if len(content) < at + 8:
        raise RecordingError("it is cut off")
    first, second = struct.unpack_from(f"{order}II", content, at)
    return first, second


def _unpacked(path: Path, data: memoryview, before: int) -> bytes:
    """The content of a compressed element; never more than is allowed, and one byte."""
    packed = zlib.decompressobj()
    most = 1 << 20
    parts, size, left = [], 0, bytes(data)
    try:
        while left and not packed.eof:
            parts.append(packed.decompress(left, most))
            size += len(parts[-1])
            check_expansion(path, float(before + size))
            left = packed.unconsumed_tail
        parts.append(packed.flush())
    except zlib.error as error:
        raise RecordingError(f"a compressed element cannot be unpacked ({error})") from error
    if not packed.eof:
        raise RecordingError("a compressed element is cut off")
    return b"".join(parts)


class _Matrix:
    """Walks through one matrix as the parser will: element after element."""

    def __init__(self, data: memoryview, order: str) -> None:
        self.data, self.order, self.at = data, order, 0

    def check(self, depth: int = 0) -> None:
        """Flags, dimensions and name, then what the class asks for."""
        if depth > _DEEPEST_ARRAYS:
            raise RecordingError(f"arrays within arrays, over {_DEEPEST_ARRAYS} deep")
        flags = self._numbers((6,), "flags")
        if len(flags) != 2:
            raise RecordingError("the flags of an array are damaged")
        kind, values = flags[0] & 0xFF, 2 if flags[0] & _COMPLEX else 1
        if kind == _OPAQUE:
            for _ in range(3):
                self._element(_NAME_TYPES, "name")
            self._inner(1, depth)
            return
        shape = self._numbers(_INTEGERS, "dimensions")
        if not 0 < len(shape) <= _MOST_DIMENSIONS or min(shape) < 0:
            raise RecordingError("the dimensions of an array are damaged")
        self._element(_NAME_TYPES, "name")
        self._content(kind, math.prod(shape), values, depth)

    def _content(self, kind: int, count: int, values: int, depth: int) -> None:
        if kind in _NUMBER_ARRAYS:
            for _ in range(values):
                size, length = self._element(tuple(_BYTES_OF_TYPE), "numbers")[1:]
                if length != size * count:
                    raise RecordingError(f"{length} bytes for {count} numbers of {size} bytes")
        elif kind == _CHAR:
            self._element(_LETTERS, "text")
        elif kind == _SPARSE:
            for _ in range(2 + values):
                self._element(tuple(_BYTES_OF_TYPE), "sparse numbers")
        elif kind == _CELL_ARRAY:
            self._inner(count, depth)
        elif kind in (_STRUCT, _OBJECT):
            if kind == _OBJECT:
                self._element(_NAME_TYPES, "class name")
            width = self._numbers((5,), "length of the field names")
            if len(width) != 1 or width[0] < 1:
                raise RecordingError("the field names of a struct are damaged")
            names = self._element(_NAME_TYPES, "field names")[2]
            self._inner(count * (names // width[0]), depth)
        elif kind == _FUNCTION:
            self._inner(1, depth)
        else:
            raise RecordingError(f"an array of class {kind}")

    def _inner(self, count: int, depth: int) -> None:
        """Matrices one after the other; an empty one has a length of 0 and nothing inside."""
        if 8 * count > len(self.data) - self.at:
            raise RecordingError(f"{count} arrays in {len(self.data) - self.at} bytes")
        for _ in range(count):
            kind, length = _words(self.data, self.at, self.order)
            if kind != _MATRIX:
                raise RecordingError(f"an element of type {kind} where an array is expected")
            self.at += 8
            if length:
                self.check(depth + 1)

    def _element(self, kinds: tuple[int, ...], what: str) -> tuple[int, int, int]:
        """Start, size of a value, and length of the next element's data; the next after it is due then."""
        first, length = _words(self.data, self.at, self.order)
        start, end = self.at + 8, self.at + 8 + (length + 7) // 8 * 8
        if first >> 16:  # up to four bytes may stand in the tag
            first, length = first & 0xFFFF, first >> 16
            start, end = self.at + 4, self.at + 8
            if length > 4:
                raise RecordingError(f"the {what} of an array are damaged")
        if first not in kinds and not (length == 0 and first in _BYTES_OF_TYPE):
            raise RecordingError(f"the {what} of an array are of type {first}")
        if start + length > len(self.data):
            raise RecordingError("an array is cut off")
        self.at = min(end, len(self.data))
        return start, _BYTES_OF_TYPE[first], length

    def _numbers(self, kinds: tuple[int, ...], what: str) -> tuple[int, ...]:
        start, size, length = self._element(kinds, what)
        if length % size or length > 4 * _MOST_DIMENSIONS:
            raise RecordingError(f"the {what} of an array are damaged")
        letter = "I" if kinds == (6,) else "i"
        return struct.unpack_from(f"{self.order}{length // 4}{letter}", self.data, start)
