"""Where names, units and values stand in MATLAB, text and MDF files of other programs."""

import re

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import scipy.io
from asammdf import MDF, Signal

from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula import fit_magic_formula
from tire_pipeline.recordings import read_recording

DEG = np.pi / 180
T = np.arange(50) * 0.02
SA = 10 * np.sin(T)
FZ = 3000 + 100 * np.cos(T)
FY = -900 * np.tanh(0.2 * SA)


def check(recording, format):
    assert recording.attrs["format"] == format
    np.testing.assert_allclose(recording["time"], T, atol=1e-9)
    np.testing.assert_allclose(recording["slip_angle"], SA * DEG, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(recording["normal_load"], FZ, rtol=1e-9)
    np.testing.assert_allclose(recording["fy"], FY, rtol=1e-9, atol=1e-9)


NAMES, UNITS = ["ET", "SA", "FZ", "FY"], ["sec", "deg", "N", "N"]
VALUES = np.column_stack([T, SA, FZ, FY])


def structs(fields, rows):
    """An array of structs, as MATLAB has them."""
    array = np.zeros((1, len(rows)), dtype=[(name, object) for name in fields])
    for place, row in enumerate(rows):
        for name, value in zip(fields, row, strict=True):
            array[0, place][name] = value
    return array


def cells(texts):
    return np.array(texts, dtype=object)


UNIT_OF = dict(zip(NAMES, UNITS, strict=True))
COLUMNS = dict(zip(NAMES, VALUES.T, strict=True))
LISTED = list(zip(NAMES, UNITS, VALUES.T, strict=True))
MAT_LAYOUTS = {
    "consortium, units as an array of structs": COLUMNS
    | {"channel": structs(["name", "units"], [(n, u) for n, u, _ in LISTED])},
    "an array of channels": {"signals": structs(["name", "unit", "data"], LISTED)},
    "a struct a channel": {n: {"data": v, "unit": u} for n, u, v in LISTED},
    "a struct a channel within a run": {"run": {n: {"values": v, "units": u} for n, u, v in LISTED}},
    "a matrix and its names": {"data": VALUES, "names": cells(NAMES), "units": cells(UNITS)},
    "a matrix of rows": {"data": VALUES.T, "names": cells(NAMES), "units": cells(UNITS)},
    "structs in a struct": {"a": {"b": COLUMNS | {"units": UNIT_OF}}},
    "time apart from an array of channels": {
        "r": {
            "X": {"Name": "ET", "Unit": "sec", "Data": T},
            "Y": structs(["Name", "Unit", "Data"], LISTED[1:]),
        }
    },
    "an array of runs": {
        "run": structs(NAMES, [VALUES[:20].T, VALUES[20:].T]),
        "channel": {"name": cells(NAMES), "units": cells(UNITS)},
    },
}


@pytest.mark.parametrize("layout", MAT_LAYOUTS)
def test_mat_layouts(tmp_path, layout):
    file = tmp_path / "a.mat"
    scipy.io.savemat(file, MAT_LAYOUTS[layout])
    check(read_recording(file), "MAT")


def test_mat_runs_that_cannot_follow_each_other_are_named(tmp_path):
    file = tmp_path / "a.mat"
    scipy.io.savemat(file, {"run": structs(NAMES, [VALUES.T, VALUES.T])})
    with pytest.raises(RecordingError, match=r"run holds 2 runs, and ET starts again in run\(2\)"):
        read_recording(file)
    scipy.io.savemat(file, {"cold": COLUMNS, "hot": COLUMNS})
    with pytest.raises(RecordingError, match="cold, hot each hold a recording"):
        read_recording(file)


HEADERS = {
    "names, descriptions, units": (NAMES, ["Time", "Slip Angle", "Tyre load", "x"], UNITS),
    "units, names": (UNITS, NAMES),
    "names, units, source": (NAMES, [f"[{u}]" for u in UNITS], ["Rig 3"] * 4),
    "a title, names, units": (["Run 5"], NAMES, UNITS),
}


@pytest.mark.parametrize("rows", HEADERS)
@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_csv_with_several_header_rows(tmp_path, rows, delimiter):
    file = tmp_path / "a.csv"
    lines = [delimiter.join(row) for row in HEADERS[rows]]
    lines += [delimiter.join(repr(float(v)) for v in row) for row in VALUES]
    file.write_text("\n".join(lines) + "\n")
    check(read_recording(file), "CSV")


def test_blank_separated_units_of_two_words(tmp_path):
    file = tmp_path / "a.txt"
    lines = ["% ET SA TSTC FZ FY", "% sec deg deg C N N"]
    lines += [" ".join(repr(float(v)) for v in (t, a, 40.0, z, y)) for t, a, z, y in VALUES]
    file.write_text("\n".join(lines) + "\n")
    recording = read_recording(file)
    check(recording, "CSV")
    assert recording.attrs["units"]["tread_temperature"] == "degC"


def test_csv_with_hours_and_minutes(tmp_path):
    file = tmp_path / "a.csv"
    stamps = [f"10:{59 + int(t // 60):02d}:{t % 60:09.6f}" for t in T]
    pd.DataFrame({"Time": stamps, "SA [deg]": SA, "FZ": FZ, "FY": FY}).to_csv(file, index=False)
    check(read_recording(file), "CSV")


def test_long_names_in_plain_english(tmp_path):
    file = tmp_path / "a.csv"
    names = [
        "Time [s]",
        "Slip Angle [deg]",
        "Normal Force [N]",
        "Lateral Force [N]",
        "Inclination Angle [deg]",
    ]
    pd.DataFrame(np.c_[VALUES, SA], columns=[*names]).assign(Lamp=1.0).to_csv(file, index=False)
    recording = read_recording(file)
    np.testing.assert_allclose(recording[["slip_angle", "camber"]], np.c_[SA, SA] * DEG)
    np.testing.assert_allclose(recording[["normal_load", "fy"]], VALUES[:, 2:])
    assert "not used, because their names are not known: Lamp" in recording.attrs["notes"]


@pytest.mark.parametrize(("unit", "steps"), [("s", 1), ("ms", 20), ("us", 20_000), ("ns", 20_000_000)])
def test_parquet_dates_are_counted_in_seconds(tmp_path, unit, steps):
    file = tmp_path / "a.parquet"
    stamps = np.datetime64("2024-09-09T12:00:00", unit) + steps * np.arange(50)
    pq.write_table(pa.table({"time": stamps, "slip_angle": SA * DEG, "normal_load": FZ, "fy": FY}), file)
    wanted = np.arange(50.0) if unit == "s" else T
    np.testing.assert_allclose(read_recording(file)["time"], wanted, atol=1e-6)


def test_a_unit_beside_the_channels_holds_before_one_at_the_top_of_a_mat_file(tmp_path):
    file = tmp_path / "a.mat"
    at_the_top = dict.fromkeys(NAMES, "N") | {"ET": "min", "SA": "rad"}
    scipy.io.savemat(file, {"units": at_the_top, "run": COLUMNS | {"units": UNIT_OF}})
    check(read_recording(file), "MAT")


def test_invalid_samples_of_an_mdf_file_are_missing(tmp_path):
    file = tmp_path / "a.mf4"
    invalid = np.arange(T.size) % 10 == 3
    with MDF(version="4.10") as mdf:
        signals = [Signal(v, T, name=n, unit=u) for n, u, v in LISTED[1:]]
        signals[-1] = Signal(FY, T, name="FY", unit="N", invalidation_bits=invalid)
        mdf.append(signals)
        mdf.save(file)
    recording = read_recording(file)
    assert (recording["fy"].isna() == invalid).all()
    np.testing.assert_allclose(recording["fy"][~invalid], FY[~invalid])


def test_mdf_names_with_a_device_behind_them(tmp_path):
    file = tmp_path / "a.mf4"
    with MDF(version="4.10") as mdf:
        mdf.append([Signal(v, T, name=f"{n}\\ETKC:1", unit=u) for n, u, v in LISTED[1:]])
        mdf.save(file)
    check(read_recording(file), "MDF4")


def test_numbers_beyond_any_measurement_become_missing(tmp_path):
    file = tmp_path / "a.csv"
    pd.DataFrame({"time": T, "slip_angle": SA * DEG, "normal_load": FZ, "fy": FY * 1e200}).to_csv(file)
    recording = read_recording(file)
    assert recording["fy"].abs().max() == 0.0
    assert "fy: 49 values are beyond any measurement and became NaN" in recording.attrs["notes"]


def test_a_load_in_kg_is_the_weight(tmp_path):
    """It was taken for newtons, with a note alone."""
    file = tmp_path / "kg.csv"
    file.write_text("SA [deg],FZ [kg],FY [kg]\n" + "\n".join(f"{a},300,{10 * a}" for a in range(-8, 9)))
    recording = read_recording(file)
    assert recording["normal_load"].to_numpy() == pytest.approx(300.0 * 9.80665)
    assert recording["fy"].to_numpy()[-1] == pytest.approx(80.0 * 9.80665)


def test_columns_of_a_vehicle_say_how_to_read_one_wheel(tmp_path):
    file = tmp_path / "car.csv"
    head = "t [s],SA_FL [deg],Fz_FL [N],Fy_FL [N],SA_FR [deg],Fz_FR [N],Fy_FR [N]\n"
    file.write_text(head + "\n".join(f"{0.1 * i},{i},3000,{-9 * i},{i},2000,{-5 * i}" for i in range(20)))
    (said,) = [note for note in read_recording(file).attrs["notes"] if "end with a wheel" in note]
    names = dict(re.findall(r"--name (\S+)=(\S+)", said))
    assert names == {"SA_FL": "slip_angle", "Fz_FL": "normal_load", "Fy_FL": "fy"}
    recording = read_recording(file, names=names)
    assert recording["fy"].iloc[3] == -27.0
    assert recording["normal_load"].iloc[0] == 3000.0


@pytest.mark.parametrize(
    "header",
    [
        "alpha [deg],2000,4000,6000",
        "alpha [deg],Fy @ Fz=2000 N,Fy @ Fz=4000 N,Fy @ Fz=6000 N",
        "alpha [deg],FY_2000,FY_4000,FY_6000",
    ],
)
def test_a_table_of_one_column_a_load_is_told_which_layout_is_needed(tmp_path, header):
    rows = [f"{a},{-300 * a},{-500 * a},{-600 * a}" for a in range(-12, 13)]
    (tmp_path / "wide.csv").write_text("\n".join([header, *rows]))
    with pytest.raises(RecordingError, match=r"are (one load each|loads).*put one row for each point, with"):
        fit_magic_formula(read_recording(tmp_path / "wide.csv"))
