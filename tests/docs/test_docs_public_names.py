"""The public face: thirty names, and what the docstring of each says."""

from __future__ import annotations

import importlib
import inspect
import re
from dataclasses import fields, is_dataclass
from itertools import pairwise

import pytest

from tire_pipeline.translation.base import TRANSLATORS

PUBLIC = {
    "magic_formula": "TireModel TireForces OperatingPoints FitResult fit_magic_formula forces_batch pack "
    "pack_matrix model_of conversion_notes",
    "tir": "read_tir write_tir parse_tir tir_bytes read_sidecar write_sidecar",
    "recordings": "read_recording check_recording join_recordings axle_recording read_dart Vehicle Issue",
    "mismatch": "explain_mismatch explain_recordings MismatchReport CorrectedModel",
    "translation": "make_translator translator_from_state Translator",
}
NAMES = [(package, name) for package, names in PUBLIC.items() for name in names.split()]

BESIDE = {
    "magic_formula": "COEFFICIENT_NAMES DegreesWarning MissingRadiusWarning PoorFitWarning TireRangeWarning",
    "tir": "TirError TirFile",
    "recordings": "DART_CAR",
    "mismatch": "EffectReport Explainer HeldOutFit OutputFit",
    "translation": "TranslationResult",
}
"""What the thirty raise, warn of, take and give."""
EVERY = NAMES + [
    (package, name) for package, names in BESIDE.items() for name in names.split() if not name.isupper()
]

OF_ALL = {"See Also", "Notes", "Examples"}
OF_FUNCTIONS = {"Parameters", "Returns"}


def _object(package: str, name: str):
    return getattr(importlib.import_module(f"tire_pipeline.{package}"), name)


def _sections(what) -> dict[str, str]:
    parts = re.split(r"^([A-Z][A-Za-z ]+)\n-{3,}\n", inspect.getdoc(what) or "", flags=re.M)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def _entries(section: str) -> set[str]:
    heads = [line.split(" : ")[0] for line in section.splitlines() if line and not line.startswith(" ")]
    return {name.strip().lstrip("*") for head in heads for name in head.split(",")}


def _without_a_sentence(section: str) -> list[str]:
    """Entries that no indented line follows."""
    lines = [line for line in section.splitlines() if line]
    pairs = pairwise([*lines, "the end"])
    return [line for line, after in pairs if not line.startswith(" ") and not after.startswith(" ")]


def test_there_are_thirty_and_their_packages_export_them():
    assert len(NAMES) == 30
    for package, name in NAMES:
        assert name in importlib.import_module(f"tire_pipeline.{package}").__all__


@pytest.mark.parametrize("package", PUBLIC)
def test_nothing_else_is_exported(package):
    exported = importlib.import_module(f"tire_pipeline.{package}").__all__
    assert set(exported) == {*PUBLIC[package].split(), *BESIDE[package].split()}


@pytest.mark.parametrize(("package", "name"), EVERY, ids=[name for _, name in EVERY])
def test_the_docstring_has_its_sections(package, name):
    what = _object(package, name)
    wanted = OF_ALL if inspect.isclass(what) else OF_ALL | OF_FUNCTIONS
    found = set(_sections(what))
    if inspect.isclass(what) and not issubclass(what, Warning) and not found & {"Parameters", "Attributes"}:
        found.discard("Parameters")
        wanted = wanted | {"Parameters"}
    assert wanted <= found


@pytest.mark.parametrize(("package", "name"), EVERY, ids=[name for _, name in EVERY])
def test_a_sentence_says_what_each_entry_is(package, name):
    sections = _sections(_object(package, name))
    entries = {title: sections.get(title, "") for title in ("Parameters", "Attributes", "Returns", "Raises")}
    assert {title: bare for title, text in entries.items() if (bare := _without_a_sentence(text))} == {}


@pytest.mark.parametrize(
    ("package", "name"),
    [each for each in NAMES if not inspect.isclass(_object(*each))],
    ids=[name for package, name in NAMES if not inspect.isclass(_object(package, name))],
)
def test_each_parameter_is_described_and_no_other(package, name):
    what = _object(package, name)
    described = _entries(_sections(what).get("Parameters", ""))
    assert described == set(inspect.signature(what).parameters)


@pytest.mark.parametrize(
    ("package", "name"),
    [each for each in EVERY if is_dataclass(_object(*each))],
    ids=[name for package, name in EVERY if is_dataclass(_object(package, name))],
)
def test_each_field_is_described_and_no_other(package, name):
    what = _object(package, name)
    sections = _sections(what)
    described = _entries(sections.get("Parameters", "") + sections.get("Attributes", ""))
    assert described == {field.name for field in fields(what) if not field.name.startswith("_")}


def _methods():
    """Public methods of the public classes, with those that they have from a class of this project."""
    for package, name in EVERY:
        what = _object(package, name)
        for base in what.__mro__ if inspect.isclass(what) else ():
            own = vars(base).items() if base.__module__.startswith("tire_pipeline") else ()
            for method, found in own:
                function = getattr(found, "__func__", found)
                if inspect.isfunction(function) and not method.startswith("_"):
                    yield pytest.param(function, id=f"{name}.{method}")


@pytest.mark.parametrize("method", list(_methods()))
def test_each_method_says_what_it_takes_and_gives(method):
    sections, signature = _sections(method), inspect.signature(method)
    described = _entries(sections.get("Parameters", ""))
    assert described == set(signature.parameters) - {"self", "cls"}
    assert ("Returns" in sections) == (signature.return_annotation not in ("None", None))


def test_the_names_of_all_translators_are_given():
    said = inspect.getdoc(_object("translation", "make_translator"))
    assert [name for name in TRANSLATORS if f"``{name}``" not in said] == []
