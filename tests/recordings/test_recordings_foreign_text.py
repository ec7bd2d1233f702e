"""Text tables of other programs and countries: the same numbers, or words that say what to do."""

from __future__ import annotations

import gzip
import io
import zipfile
from decimal import Decimal

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings import check_recording, read_recording
from tire_pipeline.recordings.conventions.channel_names import find_channel
from tire_pipeline.recordings.conventions.foreign_names import FRENCH, GERMAN

ROWS = 60
TABLE = pd.DataFrame(
    {
        "ET": np.round(0.02 * np.arange(ROWS), 2),
        "SA": np.round(8.0 * np.sin(0.2 * np.arange(ROWS)), 3),
        "FZ": np.round(3000.0 + 10.5 * np.arange(ROWS), 1),
        "FY": np.round(-900.0 * np.sin(0.2 * np.arange(ROWS)), 1),
    }
)
UNITS = ["s", "deg", "N", "N"]


def _text(cells: dict[str, list[str]], units: list[str] | None = UNITS, separator: str = ",") -> str:
    """A table as text: columns of ``TABLE``, some of them written in another way."""
    columns = {name: [repr(float(value)) for value in TABLE[name]] for name in TABLE} | cells
    rows = [list(columns), *([units] if units else []), *map(list, zip(*columns.values(), strict=True))]
    return "\n".join(separator.join(row) for row in rows) + "\n"


def _read(tmp_path, text: str, **more) -> pd.DataFrame:
    (tmp_path / "run.csv").write_text(text, encoding="utf-8")
    return read_recording(tmp_path / "run.csv", axes="ISO", **more)


def _is_table(found: pd.DataFrame) -> None:
    np.testing.assert_allclose(found["slip_angle"], np.radians(TABLE["SA"]), atol=1e-12)
    for name, column in {"time": "ET", "normal_load": "FZ", "fy": "FY"}.items():
        np.testing.assert_allclose(found[name], TABLE[column], atol=1e-9, err_msg=name)


WAYS = {
    "minus": lambda x: f"{x:.3f}".replace("-", "\u2212"),
    "fortran": lambda x: f"{x:.6E}".replace("E", "D"),
    "apostrophe": lambda x: f"{x:,.3f}".replace(",", "'"),
    "typographic apostrophe": lambda x: f"{x:,.3f}".replace(",", "\u2019"),
    "narrow space": lambda x: f"{x:,.3f}".replace(",", "\u202f"),
}


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
def test_numbers_of_other_programs(tmp_path, way):
    found = _read(tmp_path, _text({name: [way(x) for x in TABLE[name]] for name in ("SA", "FZ", "FY")}))
    _is_table(found)
    comma = {name: [way(x).replace(".", ",") for x in TABLE[name]] for name in ("ET", "SA", "FZ", "FY")}
    _is_table(_read(tmp_path, _text(comma, separator=";")))


BEGIN = pd.Timestamp("2025-12-31 23:59:59.5")
STAMPS = {
    "%d.%m.%Y %H:%M:%S.%f": "dates",
    "%Y-%m-%dT%H:%M:%S.%f": "dates",
    "%H:%M:%S.%f": "hours, minutes and seconds",
}


@pytest.mark.parametrize(("form", "kind"), STAMPS.items())
def test_stamps_become_seconds_also_over_midnight(tmp_path, form, kind):
    stamps = [f"{BEGIN + pd.Timedelta(seconds=x):{form}}" for x in TABLE["ET"]]
    found = _read(tmp_path, _text({"ET": stamps}, units=["", *UNITS[1:]]))
    _is_table(found)
    assert f"ET: {kind}, counted in seconds from the first" in found.attrs["notes"]
    assert not any("no unit given" in note for note in found.attrs["notes"])


def test_a_date_with_strokes_is_not_guessed(tmp_path):
    stamps = [f"{BEGIN + pd.Timedelta(seconds=x):%d/%m/%Y %H:%M:%S.%f}" for x in TABLE["ET"]]
    found = _read(tmp_path, _text({"ET": stamps}, units=["", *UNITS[1:]]))
    assert "time" not in found
    assert "ET: text, left out" in found.attrs["notes"]


def test_a_row_of_units_whose_last_cells_are_empty_is_one(tmp_path):
    """The last columns had no unit, and the row was passed over: degrees were read as radians."""
    more = {"flag": ["1"] * ROWS, "gear": ["3"] * ROWS}
    found = _read(tmp_path, _text(more, units=[*UNITS, "", ""]))
    _is_table(found)
    assert found["flag"].eq(1.0).all()


def test_names_that_nobody_knows_are_told_instead_of_the_units(tmp_path):
    lines = _text({}).splitlines()
    with pytest.raises(RecordingError, match=r"among Dauer \(s\), Winkel \(deg\), Last \(N\), Kraft \(N\)"):
        _read(tmp_path, "\n".join(["Dauer,Winkel,Last,Kraft", *lines[1:]]))


LANGUAGES = {
    "German": ["Zeit in s", "Schräglaufwinkel [°]", "Radlast Fz [N]", "Seitenkraft / N"],
    "German, ASCII": ["ZEIT", "SCHRAEGLAUFWINKEL (Grad)", "RADLAST (N)", "QUERKRAFT (N)"],
    "German, decomposed": ["Messzeit", "Schra\u0308glaufwinkel (deg)", "Vertikalkraft", "Reifenseitenkraft"],
    "French": ["Temps (s)", "Angle de dérive (deg)", "Charge verticale en N", "Effort latéral [N]"],
    "English": ["Time", "Slip angle SA in deg", "Normal load Fz", "Lateral force (FY)"],
}


@pytest.mark.parametrize("encoding", ["utf-8", "cp1252"])
@pytest.mark.parametrize("head", LANGUAGES.values(), ids=LANGUAGES)
def test_names_of_other_languages_and_with_symbols(tmp_path, head, encoding):
    lines = _text({}, units=None, separator=";").replace(".", ",").splitlines()
    text = "\n".join([";".join(head), *lines[1:]])
    (tmp_path / "run.csv").write_bytes(text.encode(encoding, errors="ignore"))
    _is_table(read_recording(tmp_path / "run.csv", axes="ISO"))


def test_a_known_name_counts_before_one_in_another_language(tmp_path):
    more = {"Seitenkraft": ["1"] * ROWS, "Lenkwinkel": ["2"] * ROWS, "Radlast Fy": ["3"] * ROWS}
    found = _read(tmp_path, _text(more, units=[*UNITS, "N", "deg", "N"]))
    _is_table(found)
    assert "Seitenkraft: fy is taken from FY; kept beside it" in found.attrs["notes"]
    assert "not used, because their names are not known: Lenkwinkel, Radlast Fy" in found.attrs["notes"]


@pytest.mark.parametrize("language", [GERMAN, FRENCH])
def test_each_name_in_another_language_is_of_one_channel(language):
    for channel, names in language.items():
        assert {find_channel(name)[0].name for name in names} == {channel}


def test_columns_without_a_name_are_left_out_and_nothing_warns(tmp_path, recwarn):
    lines = _text({}).splitlines()
    found = _read(tmp_path, "\n".join([*lines[:2], *(f"{line},," for line in lines[2:])]))
    _is_table(found)
    assert not found.attrs["notes"] or "without a name" not in " ".join(found.attrs["notes"])
    later = [f"{line},{7 if number > 9 else ''}" for number, line in enumerate(lines[2:])]
    found = _read(tmp_path, "\n".join([*lines[:2], *later]))
    assert "columns without a name are left out" in found.attrs["notes"]
    assert not recwarn.list


def test_of_two_columns_of_one_name_it_is_said_which_counts(tmp_path):
    lines = _text({}).splitlines()
    found = _read(
        tmp_path, "\n".join([f"{lines[0]},FY", f"{lines[1]},N", *(f"{line},1" for line in lines[2:])])
    )
    _is_table(found)
    said = "FY: two columns have this name; fy is the first, the other is kept beside it"
    assert said in found.attrs["notes"]


def test_a_spreadsheets_date_is_told_by_its_steps_and_may_be_stated(tmp_path):
    text = _text({"ET": [f"{46_000.0 + x / 86_400.0:.10f}" for x in TABLE["ET"]]}, units=["", *UNITS[1:]])
    (issue,) = [each for each in check_recording(_read(tmp_path, text)) if "time" in each.name]
    assert issue.name == "short_time_steps"
    assert "--unit ET=day" in issue.advice
    stated = _read(tmp_path, text, units={"ET": "day"})
    assert np.median(np.diff(stated["time"])) == pytest.approx(0.02, rel=1e-3)


def _workbook() -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        archive.writestr("xl/workbook.xml", "<x/>")
    return content.getvalue()


OTHERS = {
    "an Excel workbook.*save the table in it as CSV": _workbook(),
    "compressed by gzip.*decompress it first": gzip.compress(_text({}).encode()),
    "from byte [0-9]+ on it holds nothing but NUL bytes.*cut the file there": _text({}).encode() + bytes(900),
    "this is no text file -> check its format": _text({}).encode()[:90] + bytes(9) + _text({}).encode()[90:],
}


@pytest.mark.parametrize("said", OTHERS)
def test_what_is_no_text_is_called_by_its_name(tmp_path, said):
    (tmp_path / "run.csv").write_bytes(OTHERS[said])
    with pytest.raises(RecordingError, match=said):
        read_recording(tmp_path / "run.csv")


def test_decimal_numbers_of_a_database_are_numbers(tmp_path):
    load = pa.array([Decimal(str(value)) for value in TABLE["FZ"]])
    columns = {"ET": TABLE["ET"], "SA": np.radians(TABLE["SA"]), "FZ": load, "FY": TABLE["FY"]}
    pq.write_table(pa.table(columns), tmp_path / "run.parquet")
    _is_table(read_recording(tmp_path / "run.parquet", axes="ISO"))
