"""All that real files do."""

from __future__ import annotations

import math

import pytest
from tir_samples import LATERAL, tir_text

from tire_pipeline.errors import TirVersionError
from tire_pipeline.tir import parse_tir, read_tir, tir_bytes


def read(text: str, encoding: str = "utf-8"):
    return read_tir(text.encode(encoding), path="x.tir")


@pytest.mark.parametrize(
    ("fittyp", "version"),
    [
        ("5", "5.0"),
        ("51", "5.1"),
        ("6", "5.2"),
        ("21", "5.2"),
        ("52", "5.2"),
        ("60", "6.1"),
        ("61", "6.1"),
        ("62", "6.2"),
        ("61.0", "6.1"),
        ("6.2", "6.2"),
        ("'61'", "6.1"),
    ],
)
def test_fittyp(fittyp: str, version: str):
    tire = read(tir_text(model=f"FITTYP = {fittyp}   $Magic Formula = version"))
    assert tire.version == version
    told = any("has no equations of its own here" in each for each in tire.metadata["warnings"])
    assert told == (fittyp in ("60", "21"))


@pytest.mark.parametrize(
    ("label", "version"),
    [("PAC2002", "PAC2002"), ("MF_05", "5.0"), ("MF_61", "6.1"), ("mf62", "6.2"), ("MF_52", "5.2")],
)
def test_property_file_format_where_there_is_no_fittyp(label: str, version: str):
    assert read(tir_text(model=f"PROPERTY_FILE_FORMAT = '{label}'")).version == version


@pytest.mark.parametrize(
    ("keys", "version"),
    [
        ("", "5.2"),
        ("PKY4 = 2\nPPY1 = 0.1", "6.1"),
        ("PKY4 = 2\n[CONTACT_PATCH]\nENV_C1 = 0", "6.2"),
        ("PTX4 = 1", "PAC2002"),
    ],
)
def test_the_keys_decide_where_no_label_does(keys: str, version: str):
    for model in ("", "FITTYP =", "PROPERTY_FILE_FORMAT = 'USER'", "PROPERTY_FILE_FORMAT = 'MF-TYRE'"):
        tire = read(tir_text(model=model, more=keys))
        assert tire.version == version
        assert any("no FITTYP" in each for each in tire.metadata["warnings"])


def test_a_version_comment_helps_where_no_label_does():
    text = "! : TIRE_VERSION :      MF-Tyre 6.1\n" + tir_text(model="USE_MODE = 14")
    assert read(text).version == "6.1"
    assert read(text.replace("6.1", "5.1").replace("USE_MODE = 14", "FITTYP = 5")).version == "5.1"


def test_a_label_of_the_model_section_is_followed():
    other = "[SOFTWARE]\nFITTYP = 99"
    assert read(tir_text(more=other)).version == "5.2"
    assert read(other.replace("99", "61") + "\n" + tir_text(model="")).version == "6.1"


def test_two_units_of_one_quantity():
    tire = read(tir_text(units="LENGTH = mm\nLENGTH = meter"))
    assert tire.coefficients["UNLOADED_RADIUS"] == 0.32
    assert "two units of LENGTH (lines 4 and 5): the last is taken" in tire.metadata["warnings"]


def test_a_side_that_is_neither():
    tire = read(tir_text(model="FITTYP = 52\nTYRESIDE = 'top'"))
    assert "TYRESIDE = 'top' is neither LEFT nor RIGHT" in tire.metadata["warnings"]


def test_a_version_comment_outside_of_a_comment_is_none():
    assert read("TIRE_VERSION = 'MF-Tyre 6.1'\n" + tir_text(model="")).version == "5.2"


def test_another_model_beside_a_known_fittyp():
    tire = read(tir_text(model="FITTYP = 61\nPROPERTY_FILE_FORMAT = 'FTIRE'"))
    assert tire.version == "6.1"
    assert "PROPERTY_FILE_FORMAT = 'FTIRE' contradicts FITTYP, which is followed" in tire.metadata["warnings"]


def test_contradicting_labels_are_reported():
    tire = read(tir_text(model="PROPERTY_FILE_FORMAT = 'MF_61'\nFITTYP = 52"))
    assert tire.version == "5.2"
    assert "PROPERTY_FILE_FORMAT says 6.1, which contradicts 5.2" in tire.metadata["warnings"]
    tire = read(tir_text(model="PROPERTY_FILE_FORMAT = 'PAC2002'\nFITTYP = 61"))
    assert tire.version == "PAC2002"
    assert "FITTYP says 6.1, which contradicts PAC2002" in tire.metadata["warnings"]
    assert read(tir_text(model="FITTYP = 61")).metadata["warnings"] == ()
    tire = read(tir_text(more="PKY4 = 1.9"))
    assert "read as 5.2, but the file has keys that only 6.1 has" in tire.metadata["warnings"]


@pytest.mark.parametrize("label", ["FIALA", "PAC89", "FTIRE", "PAC_MC"])
def test_another_tire_model_is_named(label: str):
    with pytest.raises(TirVersionError, match=label):
        read(tir_text(model=f"PROPERTY_FILE_FORMAT = '{label}'"))


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_line_ends(end: str):
    text = tir_text().replace("\n", end)
    tire = read(text)
    assert tire.coefficients["PHY1"] == LATERAL["PHY1"]
    assert tire.source.line_ending == end
    assert tire.source.to_bytes() == text.encode()


def test_mixed_line_ends_keep_their_line_numbers():
    text = "[MODEL]\r\nFITTYP = 52\n\r\n[VERTICAL]\rFNOMIN = 4000\r\n" + "PCY1 = 1.3"
    entries = {entry.key: entry.line for entry in parse_tir(text.encode()).entries}
    assert entries == {"FITTYP": 2, "FNOMIN": 5, "PCY1": 6}


def test_tabs_mixed_case_and_comments_with_equals_signs():
    text = tir_text(
        lateral="pcy1\t\t=\t1.3\t$ shape = factor\n"
        "\tPdY1=1.0 ! PDY1 = 2.0\n  PKY1 =-20$no blank\nPKY2 = 1.8\n$PKY1 = 99\n! PKY2 = 99",
        more="[Scaling_Coefficients]\nlmuy = 0.9",
    )
    got = read(text).coefficients
    assert got["PCY1"] == 1.3
    assert got["PDY1"] == 1.0
    assert got["PKY1"] == -20.0
    assert got["PKY2"] == 1.8
    assert got["LMUY"] == 0.9


def test_comment_blocks_with_unbalanced_quotes():
    text = (
        "[MDI_HEADER]\nFILE_TYPE = 'tir'\n(COMMENTS)\n{comment_string}\n'Tire 205/60\n'it''s = 3\n"
        "FNOMIN = 1\n\"open\n[bar] is a unit\n'\n" + tir_text()
    )
    tire = read(text)
    assert tire.coefficients["FNOMIN"] == 4000.0
    assert (5, "'Tire 205/60") in tire.source.comments
    assert (9, "[bar] is a unit") in tire.source.comments


def test_bare_table_rows():
    more = "[SHAPE]\n{radial width}\n 1.0    0.0\n1.0\t0.4 $ row\n\n! break\n 0.9    1.0\n"
    more += "[DEFLECTION_LOAD_CURVE]\n{pen fz}\n0.000 0.0\n1.0D-2 2004.057"
    tire = read(tir_text(more=more))
    shape, curve = tire.source.tables
    assert (shape.section, shape.header, shape.line) == ("SHAPE", "radial width", shape.line)
    assert tire.source.rows(shape) == [(1.0, 0.0), (1.0, 0.4), (0.9, 1.0)]
    assert tire.source.rows(curve) == [(0.0, 0.0), (0.01, 2004.057)]


def test_a_section_twice():
    tire = read(tir_text(more="[VERTICAL]\nVERTICAL_STIFFNESS = 2e5\nFNOMIN = 4100"))
    assert tire.coefficients["FNOMIN"] == 4100.0
    assert tire.coefficients["VERTICAL_STIFFNESS"] == 2e5
    warnings = " / ".join(tire.metadata["warnings"])
    assert "[VERTICAL] occurs twice" in warnings
    assert "FNOMIN has two values" in warnings


def test_empty_values_count_as_missing():
    tire = read(
        tir_text(lateral="PCY1 = 1.3\nPDY1 = 1\nPKY1 = -20\nPKY2 = 1.8\nPEY1 =\nPEY2 =   $ to be fitted")
    )
    assert {"PEY1", "PEY2"} <= set(tire.defaulted)
    assert not {"PEY1", "PEY2"} & set(tire.coefficients)
    assert "PEY2 has no value (line 24)" in tire.metadata["warnings"]


def test_mass_in_units_and_in_inertia_are_two_keys():
    units = "LENGTH = meter\nFORCE = newton\nANGLE = radians\nMASS = gram\nTIME = second"
    tire = read(tir_text(units=units, more="[INERTIA]\nMASS = 9300\nIXX = 400"))
    assert tire.metadata["UNITS.MASS"] == "gram"
    assert tire.metadata["INERTIA.MASS"] == pytest.approx(9.3, rel=1e-15)


@pytest.mark.parametrize(
    ("section", "standard"),
    [
        ("TURNSLIP", "TURNSLIP_COEFFICIENTS"),
        ("ContactPatch", "CONTACT_PATCH"),
        ("INERTIAL", "INERTIA"),
        ("TIRE_PRESSURE_RANGE", "INFLATION_PRESSURE_RANGE"),
        ("TIRE_CONDITIONS", "OPERATING_CONDITIONS"),
        (" lateral coefficients ", "LATERAL_COEFFICIENTS"),
    ],
)
def test_section_aliases(section: str, standard: str):
    assert parse_tir(f"[{section}] $ x\nA = 1".encode()).sections == [standard]


def test_section_names_hold_nothing_that_does_not_print():
    file = parse_tir(("$ comment\n" * 20 + "[C\x1bD\u202e]\nX = 1").encode())
    assert file.sections == ["C?D?"]


def test_key_aliases_give_way_to_the_standard_key():
    more = "[TIRE_CONDITIONS]\nIP = 250000\nIP_NOM = 220000"
    got = read(tir_text(model="FITTYP = 61", more=more)).coefficients
    assert (got["INFLPRES"], got["NOMPRES"]) == (250000.0, 220000.0)
    for both in ("IP_NOM = 1e5\nNOMPRES = 2e5", "NOMPRES = 2e5\nIP_NOM = 1e5"):
        tire = read(tir_text(model="FITTYP = 61", more=f"[OPERATING_CONDITIONS]\n{both}"))
        assert tire.coefficients["NOMPRES"] == 2e5
        assert any("NOMPRES has two values" in each for each in tire.metadata["warnings"])


@pytest.mark.parametrize("encoding", ["cp1252", "utf-8", "utf-8-sig", "utf-16"])
def test_encodings(encoding: str):
    text = "$ Maße: 205 µm – Prüfstand\n" + tir_text()
    tire = read(text, encoding)
    assert tire.coefficients["PCY1"] == 1.3
    assert tire.source.comments[0] == (1, "$ Maße: 205 µm – Prüfstand")
    assert tire.source.to_bytes() == text.encode(encoding)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1.5D-03", 1.5e-3),
        ("-2d1", -20.0),
        ("+.5", 0.5),
        ("5.", 5.0),
        ("-0.12000E+01", -1.2),
        ("1e-400", 0.0),
    ],
)
def test_numbers(text: str, value: float):
    assert read(tir_text(more=f"PHY2 = {text}")).coefficients["PHY2"] == value


def test_unquoted_and_double_quoted_texts():
    model = "FITTYP = 52\nTYRESIDE = Right $ comment\nTYPE = \"CAR\"\nNAME = 'a $ b'\nOPEN = 'LEFT  $ it's"
    metadata = read(tir_text(model=model)).metadata
    assert metadata["MODEL.TYRESIDE"] == "RIGHT"
    assert metadata["MODEL.TYPE"] == "CAR"
    assert metadata["MODEL.NAME"] == "a $ b"
    assert metadata["MODEL.OPEN"] == "LEFT"


def test_units_are_converted_once():
    units = "LENGTH = 'mm'\nFORCE = 'kN'\nANGLE = 'deg'\nMASS = 'lb'\nTIME = 'milli'\nPRESSURE = 'bar'"
    more = """[OPERATING_CONDITIONS]
NOMPRES = 2.2
[INERTIA]
MASS = 20
IXX = 1e6
[SLIP_ANGLE_RANGE]
ALPMAX = 15
[VERTICAL_FORCE_RANGE]
FZMAX = 9
[STRUCTURAL]
YAW_STIFFNESS = 3
[INFLATION_PRESSURE_RANGE]
PRESMIN = 1.8
"""
    vertical = "FNOMIN = 4\nVERTICAL_STIFFNESS = 0.2\nVERTICAL_DAMPING = 0.05"
    text = tir_text(units=units, vertical=vertical, model="FITTYP = 61\nLONGVL = 16.7", more=more)
    text = text.replace("UNLOADED_RADIUS = 0.32", "UNLOADED_RADIUS = 320\nWIDTH = 205\nASPECT_RATIO = 0.55")
    tire = read(text)
    wanted = {
        "UNLOADED_RADIUS": 0.32,
        "FNOMIN": 4000.0,
        "VERTICAL_STIFFNESS": 200e3,  # 0.2 kN/mm
        "VERTICAL_DAMPING": 50.0,  # 0.05 kN ms/mm
        "LONGVL": 16.7,  # mm/ms
        "NOMPRES": 220e3,
        "PRESMIN": 180e3,
        "ALPMAX": math.radians(15),
        "FZMAX": 9000.0,
        "YAW_STIFFNESS": 3 * math.degrees(1),  # 3 kN mm/deg
        **LATERAL,  # never scaled
    }
    assert {k: tire.coefficients[k] for k in wanted} == pytest.approx(wanted, rel=1e-14)
    assert tire.metadata["DIMENSION.WIDTH"] == pytest.approx(0.205, rel=1e-14)
    assert tire.metadata["DIMENSION.ASPECT_RATIO"] == 0.55
    assert tire.metadata["INERTIA.MASS"] == pytest.approx(9.0718474, rel=1e-14)
    assert tire.metadata["INERTIA.IXX"] == pytest.approx(1e6 * 0.45359237 * 1e-6, rel=1e-14)


@pytest.mark.parametrize(
    ("quantity", "name", "factor"),
    [
        ("LENGTH", "INCH", 0.0254),
        ("LENGTH", "foot", 0.3048),
        ("LENGTH", "cm", 0.01),
        ("FORCE", "lbf", 4.4482216152605),
        ("FORCE", "POUND_FORCE", 4.4482216152605),
        ("FORCE", "KNewton", 1000.0),
    ],
)
def test_unit_names(quantity: str, name: str, factor: float):
    units = f"{quantity} = {name}"
    tire = read(tir_text(units=units, vertical="FNOMIN = 900\nFZMAX = 2000"))
    key = "UNLOADED_RADIUS" if quantity == "LENGTH" else "FNOMIN"
    given = 0.32 if quantity == "LENGTH" else 900
    assert tire.coefficients[key] == pytest.approx(given * factor, rel=1e-13)


@pytest.mark.parametrize(("name", "factor"), [("kPa", 1e3), ("psi", 6894.757293168), ("BAR", 1e5)])
def test_pressure_units(name: str, factor: float):
    more = "[OPERATING_CONDITIONS]\nNOMPRES = 32"
    tire = read(tir_text(units=f"PRESSURE = '{name}'", model="FITTYP = 61", more=more))
    assert tire.coefficients["NOMPRES"] == pytest.approx(32 * factor, rel=1e-12)


def test_slugs():
    tire = read(tir_text(units="MASS = 'SLUG'", more="[INERTIA]\nMASS = 1"))
    assert tire.metadata["INERTIA.MASS"] == pytest.approx(14.593902937, rel=1e-9)


def test_missing_units_are_reported():
    tire = read(tir_text(units="LENGTH = 'meter'"))
    assert "no unit of FORCE, ANGLE, MASS, TIME: taken as SI" in tire.metadata["warnings"]


@pytest.mark.parametrize(
    ("more", "units", "told"),
    [
        ("[OPERATING_CONDITIONS]\nNOMPRES = 2.2", "", "NOMPRES = 2.2 Pa is implausible"),
        ("[SLIP_ANGLE_RANGE]\nALPMAX = 15", "", "ALPMAX is 15 rad: is it in degrees?"),
        (
            "[SLIP_ANGLE_RANGE]\nALPMAX = 0.5",
            "ANGLE = deg",
            "ALPMAX is 0.5 deg by [UNITS]: is it in radians?",
        ),
        ("[SLIP_ANGLE_RANGE]\nALPMAX = -1\nALPMIN = 1", "", "ALPMIN is larger than ALPMAX"),
        ("[DIMENSION]\nRIM_RADIUS = 0.4", "", "RIM_RADIUS is not smaller than UNLOADED_RADIUS"),
        ("[DIMENSION]\nWIDTH = wide", "", "WIDTH = 'wide' is not a number (line 20)"),
        ("[DIMENSION]\nWIDTH = 1e999", "", "WIDTH = '1e999' is out of range (line 20)"),
        ("[X]\nthis is no line of a tir file", "", "1 line is of no known form and ignored: "),
    ],
)
def test_oddities_are_told_and_nothing_is_changed(more: str, units: str, told: str):
    tire = read(tir_text(model="FITTYP = 61", units=units, more=more))
    assert any(told in each for each in tire.metadata["warnings"]), tire.metadata["warnings"]


def test_the_number_of_warnings_is_bounded():
    more = "".join(f"PHY1 = {i}\n" for i in range(1000))
    assert len(read(tir_text(more=more)).metadata["warnings"]) == 101


def test_coefficients_without_any_section():
    text = "FNOMIN = 4000\n" + "\n".join(f"{k} = {v}" for k, v in LATERAL.items())
    assert read(text).coefficients == {"FNOMIN": 4000.0, **LATERAL}


def test_a_force_that_is_all_zero_is_not_modelled():
    zeros = "[LONGITUDINAL_COEFFICIENTS]\nPCX1 = 0\nPDX1 = 0.0\nPKX1 = 0\nPHX1 = 0"
    text = tir_text(more=zeros)
    tire = read(text)
    assert {"PCX1", "PDX1", "PKX1"} <= set(tire.defaulted)
    assert "PCX1 = PDX1 = PKX1 = 0: the longitudinal force is not modelled" in tire.metadata["warnings"]
    assert tire.forces(normal_load=4000.0, slip_ratio=0.1).fx == 0.0
    assert tir_bytes(tire) == text.encode()
    filled = read_tir(tir_bytes(tire.replace(PCX1=1.6, PDX1=1.1, PKX1=20.0)))
    assert filled.coefficients["PCX1"] == 1.6
    assert filled.source.text == text.replace("PCX1 = 0", "PCX1 = 1.6").replace(
        "0.0\nPKX1 = 0", "1.1\nPKX1 = 20"
    )


def test_the_same_key_outside_of_the_coefficients_is_metadata():
    tire = read(tir_text(more="[GOODYEAR]\nPCY1 = 5\nINFLATION_PRESSURE = 4.14"))
    assert tire.coefficients["PCY1"] == 1.3
    assert tire.metadata["GOODYEAR.PCY1"] == 5.0
    assert tire.metadata["GOODYEAR.INFLATION_PRESSURE"] == 4.14


def test_a_path_and_its_bytes_give_the_same(tmp_path):
    path = tmp_path / "tire.tir"
    path.write_text(tir_text())
    one, other = read_tir(path), read_tir(str(path))
    assert one.coefficients == other.coefficients == read_tir(path.read_bytes()).coefficients
    assert one.path == str(path)
    assert read_tir(path.read_bytes()).path is None
