"""Each format is written here and read back."""

from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import scipy.io
from asammdf import MDF, Signal

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings import check_recording, read_recording
from tire_pipeline.recordings.conventions.canonical import notes_beside_assumed

DEG = np.pi / 180
N = 50
T = np.arange(N) * 0.02
SA = 10 * np.sin(T)
FZ = 3000 + 100 * np.cos(T)
FY = -900 * np.tanh(0.2 * SA)


def check(recording, format, load=FZ, force=FY):
    assert recording.attrs["format"] == format
    np.testing.assert_allclose(recording["time"], T, atol=1e-9)
    np.testing.assert_allclose(recording["slip_angle"], SA * DEG, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(recording["normal_load"], load, rtol=1e-9)
    np.testing.assert_allclose(recording["fy"], force, rtol=1e-9, atol=1e-9)
    assert list(recording.columns[:2]) == ["time", "slip_angle"]
    assert any("SA from deg to rad" in c for c in recording.attrs["conversions"])


def test_csv_units_in_names(tmp_path):
    file = tmp_path / "a.csv"
    table = {"t_ms": T * 1e3, "SA_deg": SA, "Fz [kN]": FZ / 1e3, "FY (N)": FY, "V_km_h": 36.0, "x": 1.0}
    pd.DataFrame(table).to_csv(file, index=False)
    recording = read_recording(file)
    check(recording, "CSV")
    np.testing.assert_allclose(recording["speed"], 10.0)
    assert (recording["x"] == 1.0).all()


def test_columns_of_other_names_are_asked_for_by_their_unit(tmp_path):
    file = tmp_path / "Messung.csv"
    table = {"Dauer [s]": T, "SA [deg]": SA, "FZ [N]": FZ, "FY [N]": FY, "Luftdruck [bar]": 2.3, "Lauf": 1.0}
    pd.DataFrame(table).to_csv(file, index=False, sep=";", decimal=",", encoding="cp1252")
    (asked,) = [note for note in read_recording(file).attrs["notes"] if "--name" in note]
    assert asked.startswith("Dauer (s), Luftdruck (bar) are not used; if one of them is time or pressure")
    assert "--name Dauer=time," in asked
    named = read_recording(file, names={"Dauer": "time", "Luftdruck [bar]": "pressure"})
    assert not [note for note in named.attrs["notes"] if "--name" in note]
    pd.DataFrame({"t [s]": T, "Dauer [s]": T, "SA [deg]": SA, "FY [N]": FY}).to_csv(file, index=False)
    assert not [note for note in read_recording(file).attrs["notes"] if "--name" in note], "there is a time"
    np.testing.assert_allclose(named["pressure"], 2.3e5)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "utf-16"])
@pytest.mark.parametrize(
    ("delimiter", "decimal"), [(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ",")]
)
def test_csv_with_a_row_of_units(tmp_path, delimiter, decimal, encoding):
    file = tmp_path / "a.csv"
    rows = ["Rig 3, run of Tuesday", "", delimiter.join(["ET", "SA", "FZ", "FY", "TSTC"])]
    rows.append(delimiter.join(["sec", "deg", "kN", "N", "°C"]))
    for row in zip(T, SA, FZ / 1e3, FY, FY * 0 + 40.5, strict=True):
        rows.append(delimiter.join(repr(float(v)).replace(".", decimal) for v in row))
    file.write_text("\n".join(rows) + "\n", encoding=encoding)
    recording = read_recording(file)
    check(recording, "CSV")
    assert (recording["tread_temperature"] == 40.5).all()


@pytest.mark.parametrize("encoding", ["utf-8", "latin-1"])
def test_units_of_a_long_csv_survive_its_encoding(tmp_path, encoding):
    """A part of the file is read first: it may end within a character, and a degree sign is no noise."""
    file = tmp_path / "a.csv"
    rows = ["t [s];slip angle [°];Fz [kN];Fy [N];Prüfer"]
    rows += [f"{0.01 * k:.2f};{5.0 * np.sin(0.01 * k):.6f};4;{k};Äöü" for k in range(6000)]
    file.write_text("\n".join(rows) + "\n", encoding=encoding)
    recording = read_recording(file)
    assert recording["slip_angle"].abs().max() == pytest.approx(np.radians(5.0), rel=1e-3)
    assert any("Prüfer: text, left out" in note for note in recording.attrs["notes"])


def test_csv_comments_blanks_and_text(tmp_path):
    file = tmp_path / "a.txt"
    lines = ["# made by hand", "time  SA_deg FZ FY note"]
    lines += [
        f"{t} {a} {z} {y if i != 7 else 'over'} ok"
        for i, (t, a, z, y) in enumerate(zip(T, SA, FZ, FY, strict=True))
    ]
    file.write_text("\n".join(lines))
    recording = read_recording(file)
    assert np.isnan(recording["fy"][7])
    assert recording["fy"].isna().sum() == 1
    notes = " ".join(recording.attrs["notes"])
    assert "FY: 1 cell is no number" in notes
    assert "note: text, left out" in notes
    assert recording.attrs["comments"] == ["# made by hand"]


def test_csv_dates_become_seconds(tmp_path):
    file = tmp_path / "a.csv"
    stamps = pd.Timestamp("2024-09-09T12:00:00") + pd.to_timedelta(T, unit="s")
    pd.DataFrame({"timestamp": stamps, "SA_deg": SA, "FZ_N": FZ, "FY_N": FY}).to_csv(file, index=False)
    check(read_recording(file), "CSV")


def test_unknown_units_are_si_and_said_so(tmp_path):
    file = tmp_path / "a.csv"
    pd.DataFrame({"SA": SA, "FZ": FZ, "FY": FY}).to_csv(file, index=False)
    recording = read_recording(file)
    np.testing.assert_allclose(recording["slip_angle"], SA)
    assert "no unit given, SI assumed: SA (rad), FZ (N), FY (N)" in recording.attrs["notes"]
    assert any("SI units of SA (rad), FZ (N), FY (N)" in text for text in recording.attrs["assumed"])
    assert not any("SA (rad)" in note for note in notes_beside_assumed(recording)), "said twice in a report"
    assert recording.attrs["steady_points"]
    told = read_recording(file, units={"SA": "deg"})
    np.testing.assert_allclose(told["slip_angle"], SA * DEG)


def test_an_unknown_unit_in_the_file_is_noted_and_one_that_is_stated_is_refused(tmp_path):
    file = tmp_path / "a.csv"
    pd.DataFrame({"SA": SA, "FZ [furlong]": FZ, "FY": FY}).to_csv(file, index=False)
    assert any("'furlong' is not known" in n for n in read_recording(file).attrs["notes"])
    with pytest.raises(RecordingError, match=r"the stated unit 'dge' of channel SA is not known.* 'deg'"):
        read_recording(file, units={"SA": "dge"})
    with pytest.raises(RecordingError, match="a unit is stated for 'SB', which the file does not have"):
        read_recording(file, units={"SB": "deg"})


def test_units_of_the_wrong_kind_are_refused(tmp_path):
    file = tmp_path / "a.csv"
    pd.DataFrame({"SA_deg": SA, "FZ": FZ, "FY": FY}).to_csv(file, index=False)
    with pytest.raises(RecordingError, match="channel FZ has unit 'deg', which is no force"):
        read_recording(file, units={"FZ": "deg"})


def test_names_given_by_the_user(tmp_path):
    file = tmp_path / "a.csv"
    pd.DataFrame({"SA_deg": SA, "FZ_N": FZ, "Kanal_7": FY}).to_csv(file, index=False)
    recording = read_recording(file, names={"Kanal_7": "fy"}, units={"Kanal_7": "kN"})
    np.testing.assert_allclose(recording["fy"], FY * 1e3)
    with pytest.raises(RecordingError, match="'Kanal_8', which the file does not have"):
        read_recording(file, names={"Kanal_8": "fy"})
    with pytest.raises(
        RecordingError, match=r"'Kanal_7' is stated to be 'pressur', .* did you mean 'pressure'\?"
    ):
        read_recording(file, names={"Kanal_7": "pressur"})
    with pytest.raises(RecordingError, match="the file's name stands first and the channel second"):
        read_recording(file, names={"FZ": "Kanal_7"})


def test_negative_load_is_mirrored_and_sae_is_asked_for(tmp_path):
    file = tmp_path / "a.csv"
    pd.DataFrame({"SA_deg": -SA, "FZ_N": -FZ, "FY_N": -FY}).to_csv(file, index=False)
    iso, sae = read_recording(file), read_recording(file, axes="SAE")
    np.testing.assert_allclose(iso["normal_load"], FZ)
    np.testing.assert_allclose(iso["fy"], -FY)
    assert any('axes="SAE"' in n for n in iso.attrs["notes"])
    np.testing.assert_allclose(sae["normal_load"], FZ)
    np.testing.assert_allclose(sae["fy"], FY)
    np.testing.assert_allclose(sae["slip_angle"], SA * DEG)
    with pytest.raises(RecordingError, match="axes='vehicle'"):
        read_recording(file, axes="vehicle")


def test_sae_mirrors_what_points_to_the_right_or_down(tmp_path):
    """SAE J670e has x as ISO W has it, y to the right and z down."""
    names = {"slip_angle": "rad", "camber": "rad", "slip_ratio": "-", "normal_load": "N", "fx": "N"}
    names |= {"fy": "N", "mx": "N m", "my": "N m", "mz": "N m"}
    file = tmp_path / "a.csv"
    file.write_text(
        ",".join(f"{n} [{u}]" for n, u in names.items()) + "\n" + ",".join("1" * len(names)) + "\n"
    )
    iso, sae = (read_recording(file, axes=axes)[list(names)].iloc[0] for axes in ("ISO", "SAE"))
    assert (iso == 1.0).all()
    assert {name for name in names if sae[name] == -1.0} == {"slip_angle", "fy", "my", "mz"}


def test_repeated_rows_go_and_repeated_stamps_stay(tmp_path):
    file = tmp_path / "a.csv"
    table = pd.DataFrame({"time_s": T, "SA_deg": SA, "FZ_N": FZ, "FY_N": FY})
    table = table.loc[[0, 1, 1, 2, *range(2, N)]].reset_index(drop=True)
    table.loc[3, "FY_N"] += 1
    table.to_csv(file, index=False)
    recording = read_recording(file)
    assert recording.attrs["repeats"]["identical_rows_dropped"] == 1
    assert recording.attrs["repeats"]["repeated_stamps"] == 1
    assert len(recording) == N + 1


def test_of_two_names_for_one_column_the_better_known_wins(tmp_path):
    file = tmp_path / "a.csv"
    table = {"load_N": FZ * 0 + 1, "normal_load": FZ, "SA_deg": SA, "FY_N": FY}
    pd.DataFrame(table).to_csv(file, index=False)
    recording = read_recording(file)
    np.testing.assert_allclose(recording["normal_load"], FZ)
    assert (recording["load"] == 1).all()
    assert any("normal_load is taken from normal_load" in n for n in recording.attrs["notes"])


def test_mdf4_with_units_and_two_rates(tmp_path):
    file = tmp_path / "a.mf4"
    slow = T[::5]
    with MDF(version="4.10") as mdf:
        mdf.append(
            [
                Signal(SA, T, unit="deg", name="SA"),
                Signal(FZ, T, unit="N", name="FZ"),
                Signal(FY / 1e3, T, unit="kN", name="FY"),
            ]
        )
        mdf.append([Signal(slow * 2 + 40, slow, unit="°C", name="TSTC")])
        words = Signal(np.array([b"dry", b"wet", b"dry"]), slow[:3], name="surface", encoding="utf-8")
        mdf.append([words])
        mdf.save(file, compression=2)
    recording = read_recording(file)
    check(recording, "MDF4")
    inside = recording["time"] <= slow[-1]
    np.testing.assert_allclose(recording.loc[inside, "tread_temperature"], T[inside] * 2 + 40)
    assert recording.loc[~inside, "tread_temperature"].isna().all()
    assert any("fastest group" in n for n in recording.attrs["notes"])
    assert "surface: no plain numbers, left out" in recording.attrs["notes"]


def test_mdf3_is_refused_in_words(tmp_path):
    file = tmp_path / "a.mdf"
    with MDF(version="3.30") as mdf:
        mdf.append([Signal(SA, T, unit="deg", name="SA")])
        mdf.save(file)
    with pytest.raises(RecordingError, match="only version 4 is read"):
        read_recording(file)


def test_mat_of_the_tire_test_consortium(tmp_path):
    file = tmp_path / "B1.mat"
    channel = {
        "name": np.array(["ET", "SA", "FZ", "FY", "P", "V"], dtype=object),
        "units": np.array(["sec", "deg", "N", "N", "kPa", "kph"], dtype=object),
    }
    columns = {"ET": T, "SA": SA, "FZ": -FZ, "FY": FY, "P": T * 0 + 82, "V": T * 0 + 40}
    content = {k: v.reshape(-1, 1) for k, v in columns.items()} | {"channel": channel, "tireid": "X 16"}
    scipy.io.savemat(file, content)
    recording = read_recording(file)
    check(recording, "MAT")
    np.testing.assert_allclose(recording["pressure"], 82e3)
    assert recording.attrs["constants"]["tireid"]["value"] == "X 16"
    assert any("mirrored" in c for c in recording.attrs["conversions"])


@pytest.mark.parametrize("compressed", [False, True])
@pytest.mark.parametrize("format", ["5", "4"])
def test_mat_struct_or_vectors(tmp_path, compressed, format):
    file = tmp_path / "a.mat"
    columns = {"time_s": T, "SA_deg": SA, "FZ_N": FZ, "FY_N": FY}
    if format == "5":
        content = {"run": {**columns, "mass": 12.0}, "other": np.eye(3)}
    else:
        content = columns
    scipy.io.savemat(file, content, do_compression=compressed and format == "5", format=format)
    check(read_recording(file, format="MAT"), "MAT")


def test_mat_objects_and_73_are_refused_in_words(tmp_path):
    file = tmp_path / "a.mat"
    scipy.io.savemat(file, {"cells": np.array([1, "a"], dtype=object)})
    with pytest.raises(RecordingError, match="no numeric vectors"):
        read_recording(file)
    file.write_bytes(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(512) + b"\x89HDF\r\n\x1a\n" + bytes(99))
    with pytest.raises(RecordingError, match="-v7"):
        read_recording(file)


def test_parquet_units_in_fields(tmp_path):
    file = tmp_path / "a.parquet"
    units = {"t": "s", "SA": "deg", "FZ": "kN", "FY": "N"}
    fields = [pa.field(k, pa.float64(), metadata={"unit": v}) for k, v in units.items()]
    columns = [pa.array(v) for v in (T, SA, FZ / 1e3, FY)]
    pq.write_table(pa.table(columns, schema=pa.schema(fields)), file)
    check(read_recording(file), "Parquet")


def test_parquet_round_trip_of_a_recording(tmp_path):
    source, file = tmp_path / "a.csv", tmp_path / "a.parquet"
    pd.DataFrame({"t_s": T, "SA_deg": SA, "FZ_N": FZ, "FY_N": FY}).to_csv(source, index=False)
    first = read_recording(source)
    first.to_parquet(file)
    again = read_recording(file)
    pd.testing.assert_frame_equal(first, again, check_exact=True)
    assert again.attrs["notes"] == []


def test_what_cannot_be_read_says_so(tmp_path):
    cases = {
        "empty.csv": (b"", "the file is empty"),
        "binary.csv": (bytes(range(256)) * 4, "no text file"),
        "words.csv": (b"a,b\nc,d\n", "no row of numbers in the first 2 lines"),
        "header.csv": (b"SA,FY\n", "there is one line, and no row of numbers"),
        "headless.csv": (b"1,2\n3,4\n", "no header"),
        "strange.xyz": (b"abc", "suffix '.xyz' is not known"),
        "names.csv": (b"foo,bar\n1,2\n3,4\n", "no channel is recognised"),
        "ragged.csv": (b"SA,FY\n1,2\n3,4,5,6\n1,2\n", "rows cannot be read"),
        "none.parquet": (b"PAR1" + bytes(50), "cannot be read as Parquet"),
        "none.mf4": (b"MDF     4.10    " + bytes(200), "damaged block"),
        "none.mat": (b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + b"\x0e" * 64, "no|cannot"),
        "none.tdx": (b"**HEADER\nRELEASE   x\n", "no \\*\\*MEASURCHANNELS"),
    }
    for name, (content, message) in cases.items():
        file = tmp_path / name
        file.write_bytes(content)
        with pytest.raises(RecordingError, match=message):
            read_recording(file)
    with pytest.raises(RecordingError, match="no such file"):
        read_recording(tmp_path / "nowhere.csv")
    with pytest.raises(RecordingError, match="format='xls'"):
        read_recording(file, format="xls")


@pytest.mark.slow
def test_a_bomb_is_refused(tmp_path):
    """Zeros that pack a thousandfold: refused before they fill the memory."""
    file = tmp_path / "bomb.mat"
    scipy.io.savemat(file, {"SA": np.zeros((30_000_000, 1))}, do_compression=True)
    assert Path(file).stat().st_size < 1 << 20
    with pytest.raises(RecordingError, match="times its size"):
        read_recording(file)


def test_csv_says_which_cell_is_no_number_and_which_row_is_ragged(tmp_path):
    file = tmp_path / "a.csv"
    rows = ["time,slip_angle,normal_load,fy", *(f"{k / 100},0.01,4000,{k}" for k in range(60))]
    rows[41] = "0.4,0.01,4000,overload"
    file.write_text("\n".join(rows))
    notes = read_recording(file).attrs["notes"]
    said = "fy: 1 cell is no number, and counted as missing; the first in data row 41: 'overload'"
    assert said in notes
    rows[51] += ",7"
    file.write_text("\n".join(rows))
    with pytest.raises(RecordingError, match=r"\(Expected 4 fields in line 52, saw 5\) -> every row"):
        read_recording(file)


@pytest.mark.parametrize(
    ("cell", "todo"),
    [
        ("(191.0)", "a minus sign in front of it"),
        ("191.0-", "a minus sign in front of it"),
        ("<0.1", "write the limit as a plain number"),
        ("#DIV/0!", "correct the formula"),
        ("12.3 N", "units in the head of the column only"),
        ("5%", "units in the head of the column only"),
        ("1 234,5", "the same decimal sign"),
        ("1.2.3", "the same decimal sign"),
        ("TRUE", "if it is a value, write it as a plain number"),
        ("---", "if it is a value, write it as a plain number"),
    ],
)
def test_a_cell_that_is_no_number_is_a_warning_that_says_what_to_do(tmp_path, cell, todo):
    """Accountants write (191.0) for -191.0: it was missing, and the check found no fault."""
    file = tmp_path / "a.csv"
    rows = ["time,slip_angle,normal_load,fy", *(f"{k / 100},0.01,4000,{k % 7}.5" for k in range(60))]
    rows[41] = f'0.4,0.01,4000,"{cell}"'
    file.write_text("\n".join(rows))
    recording = read_recording(file)
    (issue,) = (each for each in check_recording(recording) if each.name == "cells_not_read")
    assert issue.severity == "warning"
    assert issue.where.startswith(
        "fy: 1 cell is no number, and counted as missing; the first in data row 41: "
    )
    assert repr(cell) in issue.where
    assert todo in issue.advice
    assert recording["fy"].isna().sum() == 1


@pytest.mark.parametrize("cell", ["inf", "-inf", "1e400"])
def test_an_infinite_number_is_missing_and_said(tmp_path, cell):
    file = tmp_path / "a.csv"
    rows = ["time,slip_angle,normal_load,fy", *(f"{k / 100},0.01,4000,{k % 7}.5" for k in range(60))]
    rows[41] = f"0.4,0.01,4000,{cell}"
    file.write_text("\n".join(rows))
    recording = read_recording(file)
    assert "fy: 1 values are beyond any measurement and became NaN" in recording.attrs["notes"]
    assert recording["fy"].isna().sum() == 1


def test_a_folder_is_no_recording(tmp_path):
    with pytest.raises(RecordingError, match="this is a folder"):
        read_recording(tmp_path)
