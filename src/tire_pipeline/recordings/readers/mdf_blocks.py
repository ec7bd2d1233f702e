"""Checks the block structure of an MDF 4 file before a parser trusts it.

asammdf's compiled parts take offsets and sizes as they stand: a damaged file can crash the
process there. So every link must lead to a block inside the file and of the right kind, chains
must end, and every channel must lie within its record (ASAM MDF 4.1: a block is `##XX`, length,
number of links, links, data).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.readers.limits import check_expansion

_BLOCK_HEADER = struct.Struct("<4sI2Q")
_FIRST_BLOCK = 64
_MOST_LINKS = 1 << 20
_BODY = 64
_DATA = ("DT", "DV", "SD", "RD")
# Blocks whose first link leads to the next of their kind.
_CHAINED = ("DG", "CG", "CN", "DL", "CH", "EV", "AT", "FH")
# By block: the kinds that its links may lead to, in order; None where any will do.
_LINKS: dict[str, tuple[tuple[str, ...] | None, ...]] = {
    "HD": (("DG",), ("FH",), ("CH",), ("AT",), ("EV",), ("TX", "MD")),
    "DG": (("DG",), ("CG",), (*_DATA, "DZ", "DL", "HL"), ("TX", "MD")),
    "CG": (("CG",), ("CN",), ("TX",), ("SI",), ("SR",), ("TX", "MD")),
    "CN": (("CN",), ("CN", "CA"), ("TX",), ("SI",), ("CC",), None, ("TX", "MD"), ("TX", "MD")),
    "CC": (("TX",), ("TX", "MD"), ("TX", "MD"), ("CC",)),
    "FH": (("FH",), ("TX", "MD")),
    "HL": (("DL",),),
}
_ID_BYTES = 0  # of a sorted file
_VIRTUAL_MASTER = 3


@dataclass(frozen=True)
class _MdfBlock:
    kind: str
    length: int
    links: tuple[int, ...]
    body: bytes

    def unpack(self, layout: str, at: int = 0) -> tuple[int, ...]:
        """Numbers of the block's data; a short block has none."""
        if len(self.body) < at + struct.calcsize(layout):
            raise RecordingError(f"a {self.kind} block is too short")
        return struct.unpack_from(layout, self.body, at)


def check_blocks(path: Path) -> None:
    """Raise if the file is no whole and sorted MDF 4 file.

    Raises
    ------
    RecordingError
        Another version, a damaged block, a chain without end, a channel outside of its record,
        or records of several groups in one block.
    """
    with path.open("rb") as file:
        head = file.read(16)
        if head[:3] != b"MDF":
            raise RecordingError("not an MDF file", where=str(path))
        version = head[8:16].strip(b" \x00")
        if not version.startswith(b"4"):
            raise RecordingError(
                f"MDF version {version.decode('latin-1')!r}",
                where=str(path),
                todo="only version 4 is read: convert it with asammdf",
            )
        try:
            blocks = _walk(file, path.stat().st_size)
            _check_links(blocks)
            _check_ends(blocks)
            unpacked = sum(_data_bytes(b, blocks) for b in blocks.values() if b.kind == "DZ")
            check_expansion(path, float(unpacked))
            for block in blocks.values():
                if block.kind == "DG":
                    _check_group(block, blocks)
        except RecordingError as error:
            raise RecordingError(
                f"damaged MDF 4 file: {error.what}" if error.todo is None else error.what,
                where=str(path),
                todo=error.todo,
            ) from error


def _walk(file: BinaryIO, size: int) -> dict[int, _MdfBlock]:
    blocks: dict[int, _MdfBlock] = {}
    waiting = [_FIRST_BLOCK]
    while waiting:
        at = waiting.pop()
        if at in blocks:
            continue
        if len(blocks) > _MOST_LINKS or at % 8 or at + _BLOCK_HEADER.size > size:
            raise RecordingError("a link leads out of the file")
        file.seek(at)
        kind, _, length, count = _BLOCK_HEADER.unpack(file.read(_BLOCK_HEADER.size))
        if kind[:2] != b"##" or length < _BLOCK_HEADER.size + 8 * count or at + length > size:
            raise RecordingError(f"damaged block at byte {at}")
        links = struct.unpack(f"<{count}Q", file.read(8 * count))
        body = file.read(min(_BODY, length - _BLOCK_HEADER.size - 8 * count))
        blocks[at] = _MdfBlock(kind[2:].decode("latin-1"), length, links, body)
        waiting.extend(link for link in links if link)
    if blocks[_FIRST_BLOCK].kind != "HD":
        raise RecordingError("the first block is not a header")
    return blocks


def _check_links(blocks: dict[int, _MdfBlock]) -> None:
    for at, block in blocks.items():
        allowed = _LINKS.get(block.kind, ())
        if block.kind == "DL":
            allowed = (("DL",), *(((*_DATA, "DZ"),) * (len(block.links) - 1)))
        if len(block.links) < len(allowed):
            raise RecordingError(f"the {block.kind} block at byte {at} lacks links")
        for link, kinds in zip(block.links, allowed, strict=False):
            if link and kinds is not None and blocks[link].kind not in kinds:
                raise RecordingError(
                    f"the {block.kind} block at byte {at} leads to a {blocks[link].kind} block"
                )


def _check_ends(blocks: dict[int, _MdfBlock]) -> None:
    """No chain may run in a circle, and no channel may hold itself."""
    done: set[int] = set()
    for start, block in blocks.items():
        here: set[int] = set()
        at = start if block.kind in _CHAINED else 0
        while at and at not in done:
            if at in here:
                raise RecordingError(f"the chain of blocks at byte {at} runs in a circle")
            here.add(at)
            at = blocks[at].links[0] if blocks[at].links else 0
        done |= here
    for at, block in blocks.items():
        if block.kind == "CN" and block.links[1] and blocks[block.links[1]].kind == "CN":
            raise RecordingError(
                f"the channel at byte {at} is a structure",
                todo="export plain channels only",
            )


def _chain(at: int, blocks: dict[int, _MdfBlock]) -> list[_MdfBlock]:
    found = []
    while at:
        found.append(blocks[at])
        at = blocks[at].links[0]
    return found


def _data_bytes(block: _MdfBlock, blocks: dict[int, _MdfBlock]) -> int:
    """Bytes of records that a data block, or a list of them, holds."""
    if block.kind == "DZ":
        original = block.body[:2].decode("latin-1")
        kind, _, parameter, size, packed = block.unpack("<BBIQQ", 2)
        if original not in _DATA or kind > 1 or (kind == 1 and not 0 < parameter <= size):
            raise RecordingError("a compressed block is of unknown kind")
        if packed > block.length - _BLOCK_HEADER.size - 24:
            raise RecordingError("a compressed block is cut off")
        return size
    if block.kind == "HL":
        return _data_bytes(blocks[block.links[0]], blocks) if block.links[0] else 0
    if block.kind == "DL":
        total = 0
        for part in _chain(next(a for a, b in blocks.items() if b is block), blocks):
            flags, count = part.unpack("<B3xI")
            if count != len(part.links) - 1 or flags & ~1:
                raise RecordingError("a data list does not hold as many blocks as it states")
            total += sum(_data_bytes(blocks[link], blocks) for link in part.links[1:] if link)
        return total
    return block.length - _BLOCK_HEADER.size


def _check_group(group: _MdfBlock, blocks: dict[int, _MdfBlock]) -> None:
    """Channels within their record, records within the data."""
    (id_bytes,) = group.unpack("<B")
    channel_groups = _chain(group.links[1], blocks)
    if id_bytes != _ID_BYTES or len(channel_groups) > 1:
        raise RecordingError(
            "an unsorted MDF 4 file: records of several channel groups in one data block",
            todo="sort it: asammdf.MDF(path).save('sorted.mf4')",
        )
    held = _data_bytes(blocks[group.links[2]], blocks) if group.links[2] else 0
    for channel_group in channel_groups:
        _, cycles, flags, width, invalid = channel_group.unpack("<QQH6x2I")
        if flags & 1 or cycles * (width + invalid) > held:
            raise RecordingError(f"{cycles} records of {width + invalid} bytes, but {held} bytes of data")
        for channel in _chain(channel_group.links[1], blocks):
            _check_channel(channel, width, invalid)


def _check_channel(channel: _MdfBlock, width: int, invalid: int) -> None:
    kind, _, data_type, bit, byte, bits, flags, position = channel.unpack("<4B4I")
    if kind > 3 or data_type > 14:
        raise RecordingError(f"a channel of type {kind} with data of type {data_type}")
    if kind == _VIRTUAL_MASTER:  # no bytes in the record
        return
    if data_type in (4, 5) and bits not in (16, 32, 64):
        raise RecordingError(f"a floating-point channel of {bits} bits")
    if bit > 7 or bits == 0 or (bits > 64 and data_type <= 5) or byte + (bit + bits + 7) // 8 > width:
        raise RecordingError("a channel lies outside of its record")
    if flags & 2 and position >= 8 * invalid:
        raise RecordingError("an invalidation bit lies outside of its record")
