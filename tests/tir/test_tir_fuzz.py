"""No input crashes the reader, makes it hang, or takes more than ten times its size in memory."""

from __future__ import annotations

import itertools
import random
import tracemalloc

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tir_samples import WHOLE_FILES, tir_text

from tire_pipeline.errors import TirError
from tire_pipeline.tir import TirFile, parse_tir, read_tir, tir_bytes

pytestmark = pytest.mark.slow

PIECES = [
    b"[",
    b"]",
    b"[LATERAL_COEFFICIENTS]\n",
    b"[UNITS]\n",
    b"[MODEL]\nFITTYP=",
    b"PCY1=1.3\n",
    b"FNOMIN = 4e3\n",
    b"PKY2",
    b" = ",
    b"=",
    b"'",
    b'"',
    b"$",
    b"!",
    b"{",
    b"}",
    b"(COMMENTS)\n",
    b"(",
    b")",
    b"\n",
    b"\r",
    b"\r\n",
    b"\t",
    b" " * 50,
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    b"\x80\x9f",
    b"\0",
    b"1.0D5",
    b"-",
    b"9" * 30,
    b"1e308",
    b"nan",
    b"LENGTH = mm\n",
    b"MASS='kg'\n",
    b"1 2 3\n",
    "é輪\u2028".encode(),
]
SEEDS = [path.read_bytes() for path in WHOLE_FILES]


def check(data: bytes) -> None:
    """Only documented errors; what is read can be written, and reads the same again."""
    try:
        file = parse_tir(data, path="fuzz.tir")
        assert file.to_bytes() == data
        for table in file.tables[:3]:
            file.rows(table)
    except TirError:
        pass
    try:
        tire = read_tir(data, path="fuzz.tir")
    except TirError:
        return
    assert isinstance(tire.source, TirFile)
    assert tir_bytes(tire) == data
    assert all(isinstance(value, float) for value in tire.coefficients.values())


def mutated(rng: random.Random) -> bytes:
    """A real file with a few bytes, lines or pieces changed."""
    data = bytearray(rng.choice(SEEDS))
    for _ in range(rng.randint(1, 8)):
        at, kind = rng.randrange(len(data) + 1), rng.randrange(6)
        if kind == 0 and data:
            data[min(at, len(data) - 1)] = rng.randrange(256)
        elif kind == 1:
            data[at:at] = rng.choice(PIECES)
        elif kind == 2:
            del data[at : at + rng.choice([1, 10, 1000])]
        elif kind == 3:
            length = rng.choice([5, 100, 2000])
            to = rng.randrange(len(data) + 1)
            data[to:to] = data[at : at + length]
        elif kind == 4:
            lines = bytes(data).split(b"\n")
            rng.shuffle(lines)
            data = bytearray(b"\n".join(lines))
        else:
            data = data[: at + 1]
    return bytes(data)


@settings(max_examples=200, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.binary(max_size=400))
def test_any_bytes(data: bytes):
    check(data)


@settings(max_examples=250, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(st.sampled_from(PIECES), max_size=60))
def test_pieces_of_the_format(pieces: list[bytes]):
    check(b"".join(pieces))


def test_mutations_of_real_files():
    rng = random.Random(20240607)
    for _ in range(200):
        check(mutated(rng))


@pytest.mark.long
def test_a_hundred_thousand_inputs():
    rng = random.Random(1)
    for i in range(100_000):
        if i % 4:
            check(b"".join(rng.choices(PIECES, k=rng.randrange(80))))
        else:
            check(mutated(rng))


LARGE = {
    "one long line": b"PCY1 = " + b"1" * 4_000_000,
    "blanks and a letter": b"A =" + b" " * 2_000_000 + b"x" + b" " * 2_000_000 + b"x",
    "blanks at the start": b" " * 4_000_000 + b"x",
    "word without an equals sign": b"a" * 4_000_000,
    "open quotes": b"A = '" * 500_000,
    "quotes": b"A = " + b"'\"" * 1_500_000,
    "open brackets": b"[" * 4_000_000,
    "brackets in lines": b"[a\n" * 200_000,
    "empty lines": b"\n" * 400_000,
    "short lines": b"ab\n" * 200_000,
    "rows": b"1\n" * 200_000,
    "keys": b"a=\n" * 200_000,
    "sections": b"[]\n" * 200_000,
    "comments": b"$\n" * 200_000,
    "a block": b"(COMMENTS)\n" + b"a=1\n" * 150_000,
    "not ascii": "é".encode() * 1_500_000,
    "wide": ("輪" + "a" * 4_000_000).encode(),
    "wider": ("\U0001f600" + "a" * 4_000_000).encode(),
    "not utf-8": b"\xe9\n" * 200_000,
    "carriage returns": b"a=1\r" * 1_950,
}


@pytest.mark.parametrize("name", LARGE)
def test_memory_of_large_inputs(name: str):
    data = LARGE[name]
    assert peak_memory(data) <= 10 * len(data) + ALLOWANCE


def test_memory_of_mutations():
    rng = random.Random(3)
    for data in itertools.chain(SEEDS, (mutated(rng) for _ in range(40))):
        assert peak_memory(data) <= 10 * len(data) + ALLOWANCE


def test_memory_of_as_many_keys_as_are_allowed():
    text = tir_text() + "".join(f"X{i}={i}\n" for i in range(1900))
    assert peak_memory(text.encode()) <= 10 * len(text) + ALLOWANCE


# A model of a hundred coefficients needs some memory however short its file is; the bound on keys bounds it.
ALLOWANCE = 1_000_000


def peak_memory(data: bytes) -> int:
    read_tir(tir_text().encode())  # what is allocated once
    tracemalloc.start()
    try:
        read_tir(data, path="fuzz.tir")
    except TirError:
        pass
    finally:
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    return peak
