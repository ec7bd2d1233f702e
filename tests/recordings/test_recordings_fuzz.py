"""Damaged files: RecordingError or a table, never anything else."""

import logging
import os
import random
import sys
import time
import tracemalloc
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pandas as pd
import pytest
import scipy.io
from asammdf import MDF, Signal
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.io.matlab import matfile_version

from tire_pipeline.errors import RecordingError
from tire_pipeline.progress import track
from tire_pipeline.recordings import check_recording, read_recording
from tire_pipeline.recordings.readers.mat_elements import check_elements

SUFFIX = {"TYDEX": ".tdx", "CSV": ".csv", "MDF4": ".mf4", "MAT": ".mat", "Parquet": ".parquet"}
QUICK, LONG = 150, 100_000  # for each of the five formats
FOLDER = TemporaryDirectory()
# asammdf closes in __del__ what it could not open; that is its noise, not ours.
pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")]


@cache
def whole(kind: str) -> bytes:
    """A small file of each kind, undamaged."""
    t = np.arange(12) * 0.1
    columns = {"time_s": t, "SA_deg": np.sin(t), "FZ_N": t + 3e3, "FY_N": -np.sin(t) * 9e2}
    file = Path(FOLDER.name) / f"whole{SUFFIX[kind]}"
    if kind == "CSV":
        pd.DataFrame(columns).to_csv(file, index=False)
    elif kind == "Parquet":
        pd.DataFrame(columns).to_parquet(file)
    elif kind == "MAT":
        scipy.io.savemat(file, {**columns, "run": columns}, do_compression=True)
    elif kind == "MDF4":
        with MDF(version="4.10") as mdf:
            mdf.append([Signal(v, t, unit="N", name=k) for k, v in columns.items() if k != "time_s"])
            mdf.save(file, overwrite=True, compression=2)
    else:
        keys = {"RUNTIME": "s", "SLIPANGL": "deg", "FZC": "N", "FYC": "N", "INCLANGL": "deg"}
        lines = ["**HEADER", "**CONSTANTS", f"{'INFLPRES':<40}{'bar':<10}2.5", "**MEASURCHANNELS"]
        lines += [f"{k:<40}{u:<10}1         0         0" for k, u in keys.items()]
        lines += ["**MEASURDATA", *(f"{x} {x} 3000 {-90 * x} 1" for x in t), "**END"]
        file.write_text("\n".join(lines))
    return file.read_bytes()


PATCHES = [b"\xff" * 8, b"\0" * 8, b"1e999", b"nan", b",", b"\n", b"**END\n"]
WAYS = ["set", "insert", "delete", "copy"]
PATCH = st.binary(min_size=1, max_size=8) | st.sampled_from(PATCHES)
PLACE = st.floats(0, 1, exclude_max=True)
# Insertions shift all that follows, which a binary file hardly survives: half of the cases only
# overwrite a few bytes, so that the inner parts of the parsers are reached too.
ROUGH = st.lists(st.tuples(PLACE, st.sampled_from(WAYS), PATCH), min_size=1, max_size=6)
FINE = st.lists(st.tuples(PLACE, st.just("set"), st.binary(min_size=1, max_size=2)), min_size=1, max_size=3)
CASES = st.tuples(FINE, st.just(1.0)) | st.tuples(ROUGH, st.floats(0, 2))


def damaged(kind: str, edits, keep: float) -> bytes:
    data = bytearray(whole(kind))
    for place, what, patch in edits:
        at = int(place * len(data))
        if what == "set":
            data[at : at + len(patch)] = patch
        elif what == "insert":
            data[at:at] = patch
        elif what == "delete":
            del data[at : at + len(patch) * 4]
        else:
            data[at:at] = data[at : at + 40]
    return bytes(data[: int(len(data) * keep) + 1]) if keep < 0.9 else bytes(data)


def drawn(rng: random.Random) -> tuple[list[tuple[float, str, bytes]], float]:
    """A case as from ``CASES``, at a fraction of what drawing it by hypothesis takes."""
    if rng.random() < 0.5:
        fine = range(rng.randint(1, 3))
        return [(rng.random(), "set", rng.randbytes(rng.randint(1, 2))) for _ in fine], 1.0
    edits = []
    for _ in range(rng.randint(1, 6)):
        patch = rng.choice([rng.randbytes(rng.randint(1, 8)), *PATCHES])
        edits.append((rng.random(), rng.choice(WAYS), patch))
    return edits, rng.uniform(0, 2)


def try_to_read(kind: str, content: bytes) -> bool:
    file = Path(FOLDER.name) / f"{os.getpid()}{SUFFIX[kind]}"
    file.write_bytes(content)
    try:
        recording = read_recording(file, format=kind)
    except RecordingError:
        return False
    assert all(dtype.kind == "f" for dtype in recording.dtypes)
    check_recording(recording)
    return True


@pytest.mark.parametrize("kind", SUFFIX)
def test_the_undamaged_file_is_read(kind):
    assert try_to_read(kind, whole(kind))


@pytest.mark.parametrize("kind", SUFFIX)
def test_damaged_files(kind):
    read = 0

    @settings(max_examples=QUICK, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    @given(CASES)
    def run(case):
        nonlocal read
        read += try_to_read(kind, damaged(kind, *case))

    run()
    # Damage that always or never shows would be no test.
    assert 0 < read < QUICK


# A numeric array of the type 96, as damage made it: scipy's table of types has 20 rows, and the process died.
MATRIX = (
    "0e000000 48000000 06000000 08000000 06000000 00000000 "
    "05000000 08000000 01000000 01000000 01000100 61000000"
)


@pytest.mark.parametrize("kind", [0, 8, 10, 14, 15, 96, 0xFFFF])
def test_an_element_of_no_type_is_refused_before_scipy_sees_it(tmp_path, kind):
    array = bytes.fromhex(MATRIX) + bytes([*kind.to_bytes(4, "little"), 8, 0, 0, 0]) + bytes(8)
    file = tmp_path / "a.mat"
    head = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"
    file.write_bytes(head + array[:4] + (len(array) - 8).to_bytes(4, "little") + array[8:])
    with pytest.raises(RecordingError, match=f"of type {kind}"):
        read_recording(file)


def test_arrays_too_deep_are_refused(tmp_path):
    cell = bytes.fromhex(MATRIX.replace("06000000 00000000 05", "01000000 00000000 05"))
    file = tmp_path / "a.mat"
    inside = b"".join(cell[:4] + (40 + 48 * (2000 - i)).to_bytes(4, "little") + cell[8:] for i in range(2001))
    file.write_bytes(b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + inside)
    with pytest.raises(RecordingError, match="deep"):
        read_recording(file)


def test_the_parser_s_own_examples_pass():
    folder = Path(scipy.io.__file__).parent / "matlab/tests/data"
    files = [file for file in sorted(folder.glob("test*.mat")) if matfile_version(str(file))[0] == 1]
    if not files:
        pytest.skip("this build of scipy comes without its test files")
    for file in files:
        check_elements(file)


@pytest.mark.parametrize("count", [20, pytest.param(200, marks=pytest.mark.long)])
@pytest.mark.parametrize("kind", SUFFIX)
def test_memory_of_damaged_files(kind, count, monkeypatch):
    monkeypatch.setattr(logging.root.manager, "disable", logging.CRITICAL)  # pytest keeps every line,
    monkeypatch.setattr(sys, "unraisablehook", lambda _: None)  # and what asammdf's __del__ trips over
    rng = random.Random(kind)
    for _ in range(count):
        content = damaged(kind, *drawn(rng))
        # the second time: what a parser loads once (code pages, its own code) is not the file's
        _, peak = peak_memory(kind, content), peak_memory(kind, content)
        assert peak <= 10 * len(content) + ALLOWANCE, content


# A parser needs some memory however short the file is.
ALLOWANCE = 1_000_000


def peak_memory(kind: str, content: bytes) -> int:
    tracemalloc.start()
    try:
        try_to_read(kind, content)
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.long
@pytest.mark.parametrize("kind", SUFFIX)
def test_a_hundred_thousand_damaged_files(kind):
    rng, read, slowest = random.Random(kind), 0, (0.0, b"")
    for _ in track(range(LONG), f"damaging {kind}", total=LONG):
        content = damaged(kind, *drawn(rng))
        start = time.process_time()
        try:
            read += try_to_read(kind, content)
        except Exception as error:
            raise AssertionError(f"{type(error).__name__}: {error}; the file: {content!r}") from error
        slowest = max(slowest, (time.process_time() - start, content))
    print(f"{kind}: {read} of {LONG} read, slowest {slowest[0]:.2f} s")
    assert 0 < read < LONG
