"""What a file lacks is neither zero nor a reason to refuse it: a radius, a section header."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from tir_samples import LATERAL, tir_text

from tire_pipeline.errors import TirValueError
from tire_pipeline.magic_formula import MissingRadiusWarning, TireModel
from tire_pipeline.magic_formula.equations.numpy_form import OUTPUTS
from tire_pipeline.magic_formula.forces import NEEDS_RADIUS
from tire_pipeline.tir import read_tir, write_tir

MOMENTS = "QBZ1 = 8\nQCZ1 = 1.1\nQDZ1 = 0.1\nQSX1 = 0.01\nQSY1 = 0.01\n"
VERSIONS = ("PROPERTY_FILE_FORMAT = 'PAC2002'", "FITTYP = 52", "FITTYP = 61", "FITTYP = 62")


def without_radius(model: str) -> str:
    lateral = "\n".join(f"{key} = {value}" for key, value in LATERAL.items())
    return tir_text(model=model, lateral=f"{lateral}\n{MOMENTS}").replace("UNLOADED_RADIUS = 0.32\n", "")


@pytest.mark.parametrize("model", VERSIONS)
@pytest.mark.parametrize("angle", [0.05, np.array([0.05, -0.02])], ids=["one point", "array"])
def test_without_a_radius_moments_are_nan_and_forces_are_there(model, angle):
    tire = read_tir(without_radius(model).encode(), path="x.tir")
    assert "there is no UNLOADED_RADIUS" in " ".join(tire.metadata["warnings"])
    with pytest.warns(MissingRadiusWarning, match=r"x\.tir has no UNLOADED_RADIUS: .*unloaded_radius="):
        found = tire.forces(normal_load=4000.0, slip_angle=angle)
    stated = read_tir(without_radius(model).encode(), unloaded_radius=0.32)
    whole = stated.forces(normal_load=4000.0, slip_angle=angle)
    for name in OUTPUTS:
        if name in NEEDS_RADIUS:
            assert np.isnan(getattr(found, name)).all(), name
            assert np.isfinite(getattr(whole, name)).all(), name
        else:
            np.testing.assert_array_equal(getattr(found, name), getattr(whole, name), err_msg=name)
    assert np.all(np.abs(whole.mz) > 1.0)


def test_no_warning_where_nothing_is_lost():
    tire = read_tir(without_radius("FITTYP = 52").encode())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tire.forces(normal_load=4000.0, slip_angle=0.05, outputs=("fx", "fy", "cornering_stiffness"))


@pytest.mark.parametrize("model", VERSIONS)
def test_a_carcass_stands_in_for_the_radius_of_relaxation_lengths_in_6_only(model):
    """They are K over C there; in 5.x they are in proportion to the radius whatever the file has besides."""
    tire = read_tir(without_radius(model).encode())
    tire = tire.replace(LATERAL_STIFFNESS=2e5, LONGITUDINAL_STIFFNESS=4e5, PTY1=2.0, PTY2=2.0, PTX1=1.5)
    lengths = ("relaxation_lateral", "relaxation_longitudinal")
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        found = tire.forces(normal_load=4000.0, slip_angle=0.05, outputs=lengths)
    assert np.isfinite(found.relaxation_lateral) == (tire.family == 6)
    assert len(told) == (0 if tire.family == 6 else 1)
    assert all(name in str(each.message) for each in told for name in lengths)


def test_an_unloaded_wheel_transmits_nothing_even_so():
    tire = read_tir(without_radius("FITTYP = 61").encode())
    for load in (0.0, np.zeros(2)):
        with pytest.warns(MissingRadiusWarning):
            found = tire.forces(normal_load=load, slip_angle=0.05)
        assert np.all(found.mz == 0.0)


def test_turn_slip_needs_the_radius_for_the_forces():
    tire = read_tir(without_radius("FITTYP = 61").encode())
    with pytest.warns(MissingRadiusWarning, match="fy"):
        found = tire.forces(normal_load=4000.0, slip_angle=0.05, turn_slip=0.1, outputs=("fy",))
    assert np.isnan(found.fy)


def test_relaxation_by_the_carcass_stiffness_needs_no_radius():
    more = "[STRUCTURAL]\nLATERAL_STIFFNESS = 1e5\nLONGITUDINAL_STIFFNESS = 3e5\n"
    tire = read_tir((without_radius("FITTYP = 61") + more).encode())
    lengths = ("relaxation_lateral", "relaxation_longitudinal")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = tire.forces(normal_load=4000.0, outputs=lengths)
    assert np.isfinite([found.relaxation_lateral, found.relaxation_longitudinal]).all()


def test_the_callers_radius_counts_only_where_the_file_has_none():
    tire = read_tir(without_radius("FITTYP = 52").encode(), unloaded_radius=0.3)
    assert tire.coefficients["UNLOADED_RADIUS"] == 0.3
    assert "UNLOADED_RADIUS = 0.3 m was given by the caller; the file has none" in tire.metadata["warnings"]
    other = read_tir(tir_text().encode(), unloaded_radius=0.3)
    assert other.coefficients["UNLOADED_RADIUS"] == 0.32
    assert any("the caller's 0.3 m is not used" in each for each in other.metadata["warnings"])
    with pytest.raises(TirValueError, match="must be positive"):
        read_tir(without_radius("FITTYP = 52").encode(), unloaded_radius=-0.3)


def test_a_missing_radius_is_never_written_and_a_stated_one_is(tmp_path):
    tire = read_tir(without_radius("FITTYP = 52").encode())
    bare = TireModel("5.2", tire.coefficients)
    for k, model in enumerate((tire, bare, tire.to_version("6.1"))):
        again = read_tir(write_tir(model, tmp_path / f"{k}.tir"))
        assert "UNLOADED_RADIUS" in again.defaulted
    stated = write_tir(tire.replace(UNLOADED_RADIUS=0.31), tmp_path / "stated.tir")
    assert read_tir(stated).coefficients["UNLOADED_RADIUS"] == 0.31


CONTACT = "![CONTACT_COEFFICIENTS]\nCONTACT_MODEL = '3D_ENVELOPING'\nROAD_CURVE = smooth\n"


def test_texts_behind_a_section_header_that_is_commented_out_are_kept_and_told(tmp_path):
    tire = read_tir(tir_text(model="PROPERTY_FILE_FORMAT = 'PAC2002'", more=CONTACT).encode(), path="x.tir")
    assert tire.metadata["LATERAL_COEFFICIENTS.CONTACT_MODEL"] == "3D_ENVELOPING"
    assert tire.metadata["LATERAL_COEFFICIENTS.ROAD_CURVE"] == "smooth"
    assert [each for each in tire.metadata["warnings"] if "CONTACT_MODEL" in each] == [
        "CONTACT_MODEL = '3D_ENVELOPING' (line 24) is a text in [LATERAL_COEFFICIENTS]: kept as metadata, no "
        "equation reads it; the section header above it is commented out (![CONTACT_COEFFICIENTS], line 23)"
    ]
    written = write_tir(tire.replace(PDY1=0.9), tmp_path / "new.tir")
    assert CONTACT in written.read_text()
    assert tire.forces(normal_load=4000.0, slip_angle=0.05, outputs=("fy",)).fy < 0.0


def test_a_coefficient_behind_such_a_header_still_has_to_be_a_number():
    with pytest.raises(TirValueError, match="PKY3 = 'soft' is not a finite number"):
        read_tir(tir_text(more=CONTACT + "PKY3 = 'soft'\n").encode())
    with pytest.raises(TirValueError, match="LMUY = 'high' is not a finite number"):
        read_tir(tir_text(more="[SCALING_COEFFICIENTS]\nLMUY = 'high'\n").encode())


MOTORCYCLE = """[MDI_HEADER]
FILE_TYPE = 'tir'
[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
[MODEL]
PROPERTY_FILE_FORMAT = 'MF_MC'
[DIMENSION]
UNLOADED_RADIUS = 0.3
[VERTICAL]
FNOMIN = 1500
VERTICAL_STIFFNESS = 1.6e5
"""


def test_a_motorcycle_file_without_coefficients_is_refused():
    with pytest.raises(Exception, match="no Magic Formula coefficient"):
        read_tir(MOTORCYCLE.encode(), path="x.tir")


def test_a_text_above_all_section_headers_lacks_its_header(tmp_path):
    path = tmp_path / "a.tir"
    path.write_text("MASS = 'kg'\nFILE_VERSION = 3.0\nPCY1 = 1.3\n")
    with pytest.raises(TirValueError, match=r"a\.tir:1: MASS = 'kg'.* put the header .*\[UNITS\]"):
        read_tir(path)
