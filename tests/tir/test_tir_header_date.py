"""The day of the measurement, as laboratories write it."""

import datetime as dt

import pytest
from tir_samples import PUBLIC, need_shared

from tire_pipeline.fleet.files.tir_text import FILE_STYLES
from tire_pipeline.tir import read_tir
from tire_pipeline.tir.reading.header_date import measurement_date

DAY = dt.date(2011, 1, 31)
REST = "\n[MDI_HEADER]\nFILE_TYPE='tir'\n[UNITS]\nLENGTH='meter'\n"


@pytest.mark.parametrize(
    "written",
    [
        "2011-01-31",
        "2011-1-31",
        "2011/01/31",
        "2011.01.31",
        "2011-01-31T12:30:00Z",
        "2011-01-31 12:30",
        "31.01.2011",
        "31.1.2011",
        "31. 1. 2011",
        "31/01/2011",
        "01/31/2011",
        "31-01-2011",
        "31 Jan 2011",
        "31-JAN-2011",
        "31st January 2011",
        "31. Januar 2011",
        "January 31, 2011",
        "Jan 31 2011",
        "Mon Jan 31 12:30:00 2011",
    ],
)
@pytest.mark.parametrize(
    "line", ["$ Date of test: {}", "! belt, {}, one direction", "$measured {}; drum 2.5 m"]
)
def test_common_ways_of_writing_a_day(written, line):
    assert measurement_date(line.format(written) + REST) == DAY


@pytest.mark.parametrize(
    "header",
    [
        "$ drum",
        "$ test 02/03/2011",  # 2 March or 3 February
        "$ test 31.01.11",
        "$ test 2011-13-31",
        "$ test 2011-02-30",
        "$ test 2011-01-31 to 2011-02-01",
        "$ measured 2011-01-31\n$ measured 2011-02-01",
        "$ belt 2011-01-31\n$ processed 2011-02-01",
        "$ measured 02/03/2011\n$ processed 2011-02-01",
        "$ file created 2011-01-31",
        "$ Fit of 2011-01-31",
        "$ Copyright (C) 1999-2004",
        "$ tyre 20110131",
        "$ source file: B/test_2011-01-31.tir",
        "$ B/2011-01-31.tir",
        "$ test 2011-01-31-4",
        "$ serial 12011-01-31",
        "$ $Id: MF_205.tir,v 1.1 2011/01/31 13:57:32 fh Exp $",
        "!DATE_PRGM_CONVERTER: 25-MAY-2009 11:14:40",
        "!DATESTAMP:           10-JUN-2010",
        "$ tyre 205/55/2011",
    ],
)
def test_no_day_where_it_would_be_a_guess(header):
    assert measurement_date(header + REST) is None


def test_lines_that_name_a_measurement_come_first():
    text = "$ Test date 31.01.2011\n$ processed 2011-03-01\n$ revised 2012-04-05"
    assert measurement_date(text + REST) == DAY
    assert measurement_date("$ 05/05/2011" + REST) == dt.date(2011, 5, 5)
    assert measurement_date("$ DATE : 20110131" + REST) == DAY


@pytest.mark.parametrize(("written", "day"), [("02.03.2011", (2011, 3, 2)), ("12. 11. 2011", (2011, 11, 12))])
def test_with_points_the_day_comes_first(written: str, day: tuple[int, int, int]):
    assert measurement_date(f"$ tested {written}{REST}") == dt.date(*day)


def test_only_the_header_is_read():
    assert measurement_date("[MDI_HEADER]\n$ tested 2011-01-31\n[UNITS]\n$ 2012-01-01") == DAY
    assert measurement_date("[MDI_HEADER]\n(COMMENTS)\n{comment}\n'2011-01-31'\n[UNITS]\n") == DAY
    assert measurement_date("[UNITS]\n$ tested 2011-01-31\n[MODEL]\n") is None
    assert measurement_date("") is None


@pytest.mark.parametrize("name", sorted(FILE_STYLES))
def test_every_manufacturer_of_the_fleet_is_understood(name):
    hand = FILE_STYLES[name]
    head = hand.newline.join(f"{hand.comment} {line}" for line in hand.header)
    assert measurement_date(head % {"date": "2011-01-31"} + REST) == DAY


def test_a_model_knows_its_day_and_others_none():
    values = "[MODEL]\nFITTYP=52\n[VERTICAL]\nFNOMIN=4000\n[LATERAL_COEFFICIENTS]\n"
    values += "PCY1=1.3\nPDY1=1\nPKY1=-20\nPKY2=2\n"
    assert read_tir(f"$ tested 31 Jan 2011\n{values}".encode()).metadata["date"] == "2011-01-31"
    assert "date" not in read_tir(values.encode()).metadata


def test_public_files_are_read_without_a_wrong_day():
    need_shared()
    found = {path.name: read_tir(path).metadata.get("date") for path in PUBLIC}
    assert {name: day for name, day in found.items() if day} == {}
