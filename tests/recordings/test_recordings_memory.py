"""Reading takes no more than ten times the file's size in memory."""

import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
import scipy.io
from asammdf import MDF, Signal

pytestmark = pytest.mark.slow

SCRIPT = """
import resource, sys
from tire_pipeline.recordings import read_recording
peak = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
read_recording(sys.argv[1])
before = peak()
read_recording(sys.argv[2])
print(peak() - before)
"""
TYDEX_KEYS = {"RUNTIME": "s", "SLIPANGL": "deg", "FZW": "N", "FYW": "N", "FX": "N"}


def write(file, count):
    rng = np.random.default_rng(0)
    columns = {"time_s": np.arange(count) * 1e-3}
    columns |= {k: rng.normal(size=count) for k in ("SA_deg", "FZ_N", "FY_N", "FX_N")}
    if file.suffix == ".csv":
        pd.DataFrame(columns).to_csv(file, index=False, float_format="%.7g")
    elif file.suffix == ".parquet":
        pd.DataFrame(columns).to_parquet(file)
    elif file.suffix == ".mat":
        scipy.io.savemat(file, columns)
    elif file.suffix == ".mf4":
        with MDF(version="4.10") as mdf:
            mdf.append([Signal(v, columns["time_s"], name=k) for k, v in columns.items() if k != "time_s"])
            mdf.save(file)
    else:
        lines = ["**MEASURCHANNELS"]
        lines += [f"{k:<40}{u:<10}1         0         0" for k, u in TYDEX_KEYS.items()]
        with file.open("w") as out:
            out.write("\n".join([*lines, "**MEASURDATA", ""]))
            np.savetxt(out, np.column_stack(list(columns.values())), fmt="%.4f")
    return file


@pytest.mark.skipif(sys.platform == "win32", reason="peak memory is asked of the resource module")
@pytest.mark.parametrize("suffix", [".csv", ".tdx", ".mf4", ".mat", ".parquet"])
def test_memory_stays_below_ten_times_the_file(tmp_path, suffix):
    small, large = write(tmp_path / f"a{suffix}", 2000), write(tmp_path / f"b{suffix}", 150_000)
    run = [sys.executable, "-c", SCRIPT, str(small), str(large)]
    grown = int(subprocess.run(run, capture_output=True, text=True, check=True).stdout)
    assert grown < 10 * large.stat().st_size
