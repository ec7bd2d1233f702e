"""A bad file of each kind gives its named error, with file, line and key."""

from __future__ import annotations

import os
import pickle
import stat

import pytest
from tir_samples import LATERAL, tir_text

from tire_pipeline.errors import TirError, TirSyntaxError, TirValueError, TirVersionError
from tire_pipeline.tir import parse_tir, read_tir
from tire_pipeline.tir.text.decode import MOST_FILE_BYTES


def lateral(**changed: str) -> str:
    return "\n".join(f"{key} = {value}" for key, value in {**LATERAL, **changed}.items())


@pytest.mark.parametrize("data", [b"", b"\n\n", b" \r\n\t", b"\xef\xbb\xbf\n"])
def test_empty(data: bytes):
    with pytest.raises(TirSyntaxError, match=r"x\.tir: the file is empty -> export it again"):
        read_tir(data, path="x.tir")


@pytest.mark.parametrize(
    "data",
    [
        b"\x7fELF\x02\x01\x01" + bytes(100),
        b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 4,
        pickle.dumps({"PCY1": 1.3}),
        tir_text().encode() + b"\0",
        b"\xff\xfe\x00",
        b"\x01\x02\x03\x04 PCY1 = 1.3",
    ],
)
def test_binary(data: bytes):
    with pytest.raises(TirSyntaxError, match="binary file"):
        read_tir(data, path="x.tir")


@pytest.mark.parametrize(
    "data", [b"hello", b"[UNITS]\nLENGTH = 'meter'", b"[VERTICAL]\nFNOMIN = 4000", b"<html>[MODEL]</html>"]
)
def test_no_coefficients(data: bytes):
    with pytest.raises(TirSyntaxError, match="no Magic Formula coefficient"):
        read_tir(data, path="x.tir")


@pytest.mark.parametrize(
    "text", ["abc", "1,5", "1.2.3", "nan", "inf", "1e999", "--1", "1_000", "0x10", "1 2", "٣"]
)
def test_a_coefficient_that_is_no_number(text: str):
    with pytest.raises(TirValueError) as caught:
        read_tir(tir_text(lateral=lateral(PKY1=text)).encode(), path="some/x.tir")
    assert (caught.value.path, caught.value.line, caught.value.key) == ("some/x.tir", 23, "PKY1")
    assert str(caught.value).startswith("some/x.tir:23: PKY1 = ")


def test_a_decimal_comma_is_named():
    with pytest.raises(TirValueError, match="write the decimal point as a point"):
        read_tir(tir_text(lateral=lateral(PKY1="-20,5")).encode())


@pytest.mark.parametrize(
    ("text", "key", "line"),
    [
        (tir_text(vertical="FNOMIN = 0"), "FNOMIN", 17),
        (tir_text(vertical="FNOMIN = -4000"), "FNOMIN", 17),
        (tir_text(vertical="FNOMIN = much"), "FNOMIN", 17),
        (tir_text(lateral=lateral(PCY1="0")), "PCY1", 19),
        (tir_text(lateral=lateral(PCY1="0.0D0")), "PCY1", 19),
        (tir_text(vertical="VERTICAL_STIFFNESS = 2e5"), "FNOMIN", None),
        (tir_text(vertical="FNOMIN =  $ forgotten"), "FNOMIN", None),
        (tir_text(more="[SCALING_COEFFICIENTS]\nLMUY = 0"), "LMUY", 27),
        (tir_text(units="LENGTH = 'furlong'"), "LENGTH", 4),
        (tir_text(units="FORCE = 4.448"), "FORCE", 4),
        (tir_text(units="FORCE = kN", more="[X]\nFNOMIN = 1e307"), "FNOMIN", None),
    ],
)
def test_values_that_make_no_sense(text: str, key: str, line: int | None):
    with pytest.raises(TirValueError) as caught:
        read_tir(text.encode(), path="x.tir")
    assert (caught.value.key, caught.value.path) == (key, "x.tir")
    if line is not None:
        assert caught.value.line == line
    assert "->" in str(caught.value)  # what to do


OTHER = {key: 1.1 * value for key, value in LATERAL.items()}


@pytest.mark.parametrize(
    ("second", "at"),
    [
        (
            tir_text(model="FITTYP = 62\nLONGVL = 10", lateral=lateral(**OTHER)),
            "5 sections are there a second time, [MDI_HEADER] first",
        ),
        (
            tir_text(model="FITTYP = 52", lateral=lateral(**OTHER)).partition("[MODEL]")[2],
            "[DIMENSION] first",
        ),
    ],
)
def test_two_tires_in_one_file_are_refused_where_the_second_starts(second: str, at: str):
    """They were read as a mixture: what only one of them states came from that one."""
    first = tir_text()
    with pytest.raises(TirSyntaxError, match="there are two tires in it: ") as caught:
        read_tir(f"{first}$ another\n{second}".encode(), path="x.tir")
    assert (caught.value.path, caught.value.line) == ("x.tir", first.count("\n") + (2 if "MDI" in at else 4))
    assert at in str(caught.value)
    assert "(PCY1 is 1.3 in line 19 and 1.43" in str(caught.value)
    assert "make one file of each tire" in str(caught.value)


def test_one_tire_stated_twice_is_read():
    assert read_tir((tir_text() + tir_text()).encode()).coefficients["PKY1"] == -20.0
    edited = tir_text(more="[VERTICAL]\nFNOMIN = 4100\n[LATERAL_COEFFICIENTS]\nPKY1 = -21\nPCY1 = 1.4")
    assert read_tir(edited.encode()).coefficients["PKY1"] == -21.0


@pytest.mark.parametrize("fittyp", ["99", "4", "-5", "six", "6.15", "1e300", "60x"])
def test_unknown_versions(fittyp: str):
    with pytest.raises(TirVersionError) as caught:
        read_tir(tir_text(model=f"LONGVL = 10\nFITTYP = {fittyp}").encode(), path="x.tir")
    assert (caught.value.path, caught.value.line, caught.value.key) == ("x.tir", 11, "FITTYP")


def test_a_large_file_is_refused(tmp_path):
    filler = "$ " + "x" * 98 + "\n"
    text = tir_text()
    fits = text + filler * ((MOST_FILE_BYTES - len(text)) // len(filler))
    assert read_tir(fits.encode()).version == "5.2"
    with pytest.raises(TirSyntaxError, match="larger than 5 MB"):
        read_tir((fits + filler).encode(), path="x.tir")
    path = tmp_path / "large.tir"
    path.write_text(fits + filler)
    with pytest.raises(TirSyntaxError, match=r"large\.tir: the file is larger than 5 MB"):
        read_tir(path)


@pytest.mark.parametrize(
    ("line", "what"),
    [("A{} = 1\n", "2000 keys"), ("[A{}]\n", "1000 sections"), ("1 2\nx{}\n", "1000 tables")],
)
def test_more_than_any_real_file_has_is_refused(line: str, what: str):
    text = "".join(line.format(i) for i in range(5001))
    with pytest.raises(TirSyntaxError, match=f"more than {what}"):
        parse_tir(text.encode()).scan()


def test_paths_that_cannot_be_read(tmp_path):
    with pytest.raises(TirError, match="cannot be read: No such file"):
        read_tir(tmp_path / "absent.tir")
    with pytest.raises(TirError, match=r"this is a folder -> give one .tir file"):
        read_tir(tmp_path)
    with pytest.raises(TirError, match="cannot be read: embedded null"):
        read_tir("a\0b.tir")
    fifo = tmp_path / "fifo.tir"
    os.mkfifo(fifo)
    with pytest.raises(TirError, match="is not a regular file"):
        read_tir(fifo)  # and does not wait for a writer


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may read everything")
def test_a_file_without_permission(tmp_path):
    path = tmp_path / "closed.tir"
    path.write_text(tir_text())
    path.chmod(stat.S_IWUSR)
    with pytest.raises(TirError, match="Permission denied"):
        read_tir(path)


def test_a_row_with_words_in_it():
    file = parse_tir(b"[SHAPE]\n1.0 0.0\n1.0 wide\n", path="x.tir")
    with pytest.raises(TirSyntaxError, match=r"x\.tir:3: a row of \[SHAPE\]"):
        file.rows(file.tables[0])
