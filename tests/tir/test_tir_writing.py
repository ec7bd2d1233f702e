"""Writing: the untouched stays, the touched is exact, nothing hostile gets in, nothing half is left."""

from __future__ import annotations

import os

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tir_samples import LATERAL, WHOLE_FILES, tir_text

from tire_pipeline.errors import TirError, TirVersionError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tir import parse_tir, read_tir, tir_bytes, write_tir
from tire_pipeline.tir.format.values import format_number, format_scaled

ODD_TEXT = (
    "$ first = line\r\n[UNITS]\n LENGTH='mm' ! c\r\nFORCE = kN\nANGLE=deg\nMASS = gram\rTIME = 's'\n"
    "[MODEL]\nFITTYP=6$v\nTYRESIDE = 'Left'\nLONGVL = 16700.0\n[dimension]\nUnloaded_Radius = 320.0000 $ r\n"
    "WIDTH = 205\n[VERTICAL]\nFNOMIN =+4.000D0\t$x\n[LATERAL_COEFFICIENTS]\nPCY1 = 1.30000\nPDY1=1.\n"
    "PKY1 =-2.0E+01\nPKY2 = 1.80\nPEY1 =\nPHY1 = 2.0e-3\n[SHAPE]\n1 0\n.9 1\n[SCALING_COEFFICIENTS]\nLMUY = 1"
)

finite = st.floats(allow_nan=False, allow_infinity=False, width=64)
coefficients = st.floats(-1e6, 1e6, allow_nan=False).filter(lambda x: x != 0)


def fresh(**more: float) -> TireModel:
    values = {"FNOMIN": 4000.0, "UNLOADED_RADIUS": 0.32, **LATERAL, **more}
    return TireModel.from_coefficients(values, metadata={"DIMENSION.WIDTH": 0.205, "MODEL.TYRESIDE": "RIGHT"})


@settings(deadline=None)
@given(finite)
def test_numbers_are_exact(value: float):
    assert float(format_number(value)) == value


@settings(deadline=None)
@given(st.floats(1e-6, 1e6), st.sampled_from([1e-3, 1e3, 1e5, 4.4482216152605, np.pi / 180, 0.0254]))
def test_numbers_in_other_units_come_back_within_one_step(value: float, factor: float):
    again = float(format_scaled(value, factor)) * factor
    assert abs(again - value) <= np.spacing(value)


def test_untouched_text_stays_to_the_byte():
    tire = read_tir(ODD_TEXT.encode())
    assert tir_bytes(tire) == ODD_TEXT.encode()
    changed = tir_bytes(tire.replace(PDY1=1.25)).decode()
    assert changed == ODD_TEXT.replace("PDY1=1.", "PDY1= 1.25")


def test_changed_values_are_written_in_the_units_of_the_file():
    tire = read_tir(ODD_TEXT.encode()).replace(FNOMIN=4500.0, UNLOADED_RADIUS=0.3165, PEY1=-0.5)
    text = tir_bytes(tire).decode()
    assert "FNOMIN = 4.5\t$x" in text
    assert "Unloaded_Radius = 316.5 $ r" in text
    assert "PEY1 = -0.5\n" in text  # the empty value is filled in
    again = read_tir(text.encode())
    assert again.coefficients == tire.coefficients
    assert again.source.text.count("PEY1") == 1


def test_new_coefficients_go_to_their_sections():
    tire = read_tir(ODD_TEXT.encode()).replace(PVY1=0.01, LMUX=0.9, PCX1=1.6, FZMAX=9000.0)
    again = read_tir(tir_bytes(tire))
    assert again.coefficients == tire.coefficients
    homes = {entry.key: entry.section for entry in again.source.entries}
    assert homes["PVY1"] == "LATERAL_COEFFICIENTS"
    assert homes["LMUX"] == "SCALING_COEFFICIENTS"  # the file's last line had no line end
    assert homes["PCX1"] == "LONGITUDINAL_COEFFICIENTS"
    assert homes["FZMAX"] == "VERTICAL_FORCE_RANGE"
    assert again.source.rows(again.source.tables[0]) == [(1.0, 0.0), (0.9, 1.0)]


def test_removed_coefficients_become_comments():
    tire = read_tir(ODD_TEXT.encode())
    left = {k: v for k, v in tire.coefficients.items() if k != "PHY1"}
    smaller = TireModel("5.2", left, metadata=tire.metadata, source=tire.source)
    text = tir_bytes(smaller).decode()
    assert "$ PHY1 = 2.0e-3\n" in text
    assert "PHY1" in read_tir(text.encode()).defaulted


def test_a_removed_coefficient_is_gone_by_whatever_name_the_file_has_it():
    tire = read_tir(tir_text(model="FITTYP = 61", more="[TIRE_CONDITIONS]\nIP_NOM = 220000").encode())
    left = {k: v for k, v in tire.coefficients.items() if k != "NOMPRES"}
    text = tir_bytes(TireModel("6.1", left, metadata=tire.metadata, source=tire.source)).decode()
    assert "$ IP_NOM = 220000" in text
    assert "NOMPRES" not in read_tir(text.encode()).coefficients


def test_changed_metadata_is_written():
    tire = read_tir(ODD_TEXT.encode())
    metadata = {**tire.metadata, "DIMENSION.WIDTH": 0.225, "MODEL.TYRESIDE": "RIGHT", "INERTIA.MASS": 9.5}
    changed = TireModel("5.2", tire.coefficients, metadata=metadata, source=tire.source)
    text = tir_bytes(changed).decode()
    assert "WIDTH = 225\n" in text
    assert "TYRESIDE = 'RIGHT'\n" in text
    again = read_tir(text.encode()).metadata
    assert (again["INERTIA.MASS"], again["DIMENSION.WIDTH"]) == (9.5, 0.225)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(st.dictionaries(st.sampled_from(["PDY1", "PKY1", "PVY2", "LMUY", "QDZ1", "RBX1"]), coefficients))
def test_hypothesis_read_write_read(changes: dict[str, float]):
    tire = read_tir(ODD_TEXT.encode()).replace(**changes)
    again = read_tir(tir_bytes(tire))
    assert again.coefficients == tire.coefficients
    assert tir_bytes(again) == tir_bytes(tire)


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(st.data())
def test_hypothesis_read_write_read_of_whole_files(data):
    tire = read_tir(data.draw(st.sampled_from(WHOLE_FILES)))
    printed = {entry.key for entry in tire.source.entries}  # aliases are printed by their other name
    divisors = {"LFZO", "LCX", "LCY", "LMUX", "LMUY", "FNOMIN", "UNLOADED_RADIUS"}
    names = sorted(set(tire.coefficients) & printed - divisors)
    changes = data.draw(st.dictionaries(st.sampled_from(names), coefficients, max_size=5))
    changed = tire.replace(**changes)
    again = read_tir(tir_bytes(changed))
    assert again.coefficients == changed.coefficients
    assert again.version == tire.version
    untouched = [e for e in tire.source.entries if e.key not in changes]
    assert [(e.key, e.value) for e in again.source.entries if e.key not in changes] == [
        (e.key, e.value) for e in untouched
    ]


@pytest.mark.parametrize("version", ["5.0", "5.1", "5.2", "6.1", "6.2", "PAC2002"])
def test_a_model_without_a_file_gets_a_complete_one(version: str, tmp_path):
    made = fresh(PCX1=1.6, PDX1=1.1, PKX1=22.0, NOMPRES=220e3)
    tire = TireModel.from_coefficients(made.coefficients, version=version, metadata=made.metadata)
    path = write_tir(tire, tmp_path / "new.tir")
    again = read_tir(path)
    assert again.version == version
    assert again.metadata["warnings"] == ()
    assert {k: again.coefficients[k] for k in tire.coefficients} == dict(tire.coefficients)
    assert {k: v for k, v in again.coefficients.items() if k not in tire.coefficients} == dict(tire.defaulted)
    assert again.defaulted == {}
    assert again.metadata["DIMENSION.WIDTH"] == 0.205
    assert again.metadata["MODEL.TYRESIDE"] == "RIGHT"
    assert again.metadata["MODEL.USE_MODE"] == (4.0 if version == "PAC2002" else 14.0)  # combined slip
    text = path.read_text()
    assert text.count("$not given: this value is used") == len(tire.defaulted)
    assert max(map(len, text.splitlines())) < 200
    load, slip = 4000.0, np.linspace(-0.2, 0.2, 9)
    wanted = tire.forces(normal_load=load, slip_angle=slip, limits="ignore").fy
    assert np.array_equal(again.forces(normal_load=load, slip_angle=slip, limits="ignore").fy, wanted)


def test_only_what_is_given_on_request(tmp_path):
    tire = fresh()
    again = read_tir(write_tir(tire, tmp_path / "new.tir", complete=False))
    assert again.coefficients == tire.coefficients
    assert again.defaulted == tire.defaulted


def test_what_stands_in_can_be_added_to_a_file(tmp_path):
    tire = read_tir(tir_text().encode())
    again = read_tir(write_tir(tire, tmp_path / "new.tir", complete=True))
    assert set(again.defaulted) == {"PCX1"}  # no file may hold its zero
    assert {k: v for k, v in again.coefficients.items() if k not in tire.coefficients} == {
        k: v for k, v in tire.defaulted.items() if k != "PCX1"
    }
    assert again.source.text.startswith(tir_text()[:200])


def test_zeros_that_no_file_may_hold_are_not_written(tmp_path):
    tire = TireModel.from_coefficients({"FNOMIN": 4000.0, **LATERAL})
    assert set(read_tir(write_tir(tire, tmp_path / "new.tir")).defaulted) == {"UNLOADED_RADIUS", "PCX1"}


@pytest.mark.parametrize(
    ("given", "version"),
    [("FITTYP = 52", "PAC2002"), ("PROPERTY_FILE_FORMAT = 'PAC2002'", "5.2"), ("", "5.1")],
)
def test_another_version_of_the_family(given: str, version: str, tmp_path):
    tire = read_tir(tir_text(model=given).encode())
    again = read_tir(write_tir(tire, tmp_path / "new.tir", version=version))
    assert again.version == version
    assert again.metadata["warnings"] == ()
    assert again.coefficients == tire.coefficients


@pytest.mark.parametrize("path", WHOLE_FILES, ids=lambda p: p.name)
@pytest.mark.parametrize("with_source", [True, False])
def test_an_older_model_written_as_61_has_the_same_forces(path, with_source: bool, tmp_path):
    tire = read_tir(path, unloaded_radius=0.3)
    if not with_source:
        tire = TireModel(tire.version, tire.coefficients, metadata=tire.metadata)
    rng = np.random.default_rng(8)
    points = {
        "normal_load": rng.uniform(0.1, 2, 200) * tire.coefficients["FNOMIN"],
        "slip_angle": rng.uniform(-0.4, 0.4, 200),
        "slip_ratio": rng.uniform(-0.4, 0.4, 200),
        "camber": rng.uniform(-0.2, 0.2, 200),
        "limits": "ignore",
    }
    again = read_tir(write_tir(tire, tmp_path / "new.tir", version="6.1"))
    assert again.version == "6.1"
    one, other = tire.forces(**points), again.forces(**points)
    for name in ("fx", "fy", "mz", "mx"):
        before, after = getattr(one, name), getattr(other, name)
        assert np.abs(before - after).max() <= 1e-9 * np.abs(before).max(), name


def test_a_version_that_is_not_known(tmp_path):
    with pytest.raises(TirVersionError):
        write_tir(fresh(), tmp_path / "new.tir", version="7.0")
    assert list(tmp_path.iterdir()) == []


def test_comments_are_kept_and_added(tmp_path):
    text = "$ mine\n" + tir_text()
    path = write_tir(read_tir(text.encode()), tmp_path / "new.tir", comments=["one", "two"])
    assert path.read_text() == "! one\n! two\n" + text


HOSTILE = [
    "x\n[LATERAL_COEFFICIENTS]\nPCY1 = 99",
    "x\r\nPCY1 = 99\r[UNITS]\x0bLENGTH = 'mm'\u2028FNOMIN = 1\x85FNOMIN = 2",
    "\x00\x1b[31m\x07 $ ! ' \" { } \ud800",
    "\u202e\u200b" + "a" * 10_000,
    "\n" * 10_000,
]


@pytest.mark.parametrize("text", HOSTILE)
@pytest.mark.parametrize("source", [True, False])
def test_hostile_comments(text: str, source: bool, tmp_path):
    tire = read_tir(tir_text().encode()) if source else fresh()
    path = write_tir(tire, tmp_path / "new.tir", comments=text, complete=False)
    again = read_tir(path)
    assert again.coefficients == tire.coefficients
    written = path.read_bytes().decode()
    assert not set(written) & set("\x00\x1b\x07\x0b\x85\u2028\u202e\u200b\r")
    added = [line for line in written.splitlines() if line.startswith("! ") and "TIRE_VERSION" not in line]
    assert all(set(line) & set("[]{}$") == set() and len(line) < 200 for line in added)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(st.text(max_size=300))
def test_any_comment_and_any_text_value(text: str):
    metadata = {f"X.{text}": 1.0, text: text, "MODEL.NAME": text, "DIMENSION.WIDTH": 0.2}
    tire = TireModel.from_coefficients(fresh().coefficients, metadata=metadata)
    again = read_tir(tir_bytes(tire, comments=text, complete=False))
    assert again.coefficients == tire.coefficients
    assert again.metadata["DIMENSION.WIDTH"] == 0.2
    read = read_tir(tir_text().encode())
    changed = TireModel("5.2", read.coefficients, metadata={**read.metadata, **metadata}, source=read.source)
    assert read_tir(tir_bytes(changed, comments=text)).coefficients == read.coefficients


def test_nothing_is_overwritten_unless_asked(tmp_path):
    path = tmp_path / "tire.tir"
    path.write_text(tir_text())
    tire = read_tir(path).replace(PDY1=1.5)
    with pytest.raises(TirError, match="there is a file of that name"):
        write_tir(tire, path)
    assert path.read_text() == tir_text()
    write_tir(tire, path, overwrite=True)
    assert read_tir(path).coefficients["PDY1"] == 1.5


def test_a_full_disk_leaves_nothing(tmp_path, monkeypatch):
    path = tmp_path / "tire.tir"
    path.write_text(tir_text())

    def full(handle: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write_tir(fresh(), path, overwrite=True)
    assert [each.name for each in tmp_path.iterdir()] == ["tire.tir"]
    assert path.read_text() == tir_text()


def test_an_absent_folder(tmp_path):
    with pytest.raises(FileNotFoundError):
        write_tir(fresh(), tmp_path / "absent" / "tire.tir")


def test_text_that_does_not_fit_the_encoding_of_the_file(tmp_path):
    text = "$ Prüfstand\n" + tir_text()
    tire = read_tir(text.encode("cp1252"))
    assert tire.source.encoding == "cp1252"
    path = write_tir(tire, tmp_path / "new.tir", comments="輪胎")
    again = read_tir(path)
    assert again.source.comments[:2] == [(1, "! 輪胎"), (2, "$ Prüfstand")]


def test_edits_of_the_text():
    file = parse_tir(b"A = 1\nB = 2\n")
    assert file.edited([(10, 11, "3"), (0, 0, "$\n"), (4, 5, "2")]).text == "$\nA = 2\nB = 3\n"
    assert file.get("", "b") == "2"
    assert parse_tir(b"A = 1\nA = 2\n").get("", "a") == "2"  # the last one holds, as on reading
    assert file.get("X", "b", "none") == "none"


def test_computed_coefficients_have_nine_digits_and_the_others_their_own(tmp_path):
    source = tmp_path / "source.tir"
    source.write_text(
        "[UNITS]\nLENGTH='mm'\n[DIMENSION]\nUNLOADED_RADIUS = 310.5\n[VERTICAL]\nFNOMIN = 4000\n"
        "[LATERAL_COEFFICIENTS]\nPCY1 = 1.30\nPDY1 = 0.98000000000000009\nPKY1 = -20\n"
    )
    tire = read_tir(source)
    moved = tire.replace(PDY1=tire.coefficients["PDY1"] * (1 + 1e-13), PKY1=-19.6966362490789926)
    text = write_tir(moved, tmp_path / "out.tir", digits=9).read_text()
    assert "PDY1 = 0.98000000000000009" in text
    assert "PKY1 = -19.6966362\n" in text
    assert "UNLOADED_RADIUS = 310.5" in text
    slightly = tire.replace(PDY1=tire.coefficients["PDY1"] * (1 + 1e-7))
    assert "PDY1 = 0.980000098\n" in write_tir(slightly, tmp_path / "slightly.tir", digits=9).read_text()
    assert "PKY1 = -19.696636249078992" in write_tir(moved, tmp_path / "exact.tir").read_text()
    fresh = write_tir(TireModel.from_coefficients(dict(moved.coefficients)), tmp_path / "fresh.tir", digits=9)
    assert read_tir(fresh).coefficients["PKY1"] == -19.6966362
