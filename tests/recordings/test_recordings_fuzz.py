"""Damaged files: RecordingError or a table, never anything else."""

import os
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

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings import check_recording, read_recording

SUFFIX = {"TYDEX": ".tdx", "CSV": ".csv", "MDF4": ".mf4", "MAT": ".mat", "Parquet": ".parquet"}
QUICK, LONG = 400, 20_000  # for each of the five formats
FOLDER = TemporaryDirectory()
# asammdf closes in __del__ what it could not open; that is its noise, not ours.
pytestmark = pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")


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


PATCH = st.binary(min_size=1, max_size=8) | st.sampled_from(
    [b"\xff" * 8, b"\0" * 8, b"1e999", b"nan", b",", b"\n", b"**END\n"]
)
PLACE = st.floats(0, 1, exclude_max=True)
# Insertions shift all that follows, which a binary file hardly survives: half of the cases only
# overwrite a few bytes, so that the inner parts of the parsers are reached too.
ROUGH = st.lists(
    st.tuples(PLACE, st.sampled_from(["set", "insert", "delete", "copy"]), PATCH), min_size=1, max_size=6
)
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


def fuzz(kind: str, count: int) -> None:
    read = 0

    @settings(max_examples=count, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    @given(CASES)
    def run(case):
        nonlocal read
        read += try_to_read(kind, damaged(kind, *case))

    run()
    # Damage that always or never shows would be no test.
    assert 0 < read < count


@pytest.mark.parametrize("kind", SUFFIX)
def test_damaged_files(kind):
    fuzz(kind, QUICK)


@pytest.mark.long
@pytest.mark.parametrize("kind", SUFFIX)
def test_damaged_files_long(kind):
    fuzz(kind, LONG)
