"""The text of a new ``.tir`` file, for a model that was not read from a file."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.coefficients import is_possible
from tire_pipeline.tir.format.keys import DIMENSION, NEVER_COEFFICIENTS, names_coefficient, section_name
from tire_pipeline.tir.format.layout import LAYOUT, describe, home_section
from tire_pipeline.tir.format.values import format_number
from tire_pipeline.tir.format.version import VERSION_FITTYP
from tire_pipeline.tir.text.escaping import comment_lines, quoted

_METADATA_NAME = re.compile(r"([A-Z][A-Z0-9_ ]*)\.([A-Z_][A-Z0-9_.\-]*)").fullmatch
_RULE = 76
_LABELS = ("FITTYP", "PROPERTY_FILE_FORMAT")
NOT_GIVEN = "not given: this value is used"


def fresh_text(
    model: TireModel, comments: Iterable[str] = (), *, complete: bool = True, digits: int | None = None
) -> str:
    """Return a complete file in SI units: standard sections in their order, a comment for each key.

    Parameters
    ----------
    model : TireModel
    comments : iterable of str
    complete : bool
        Also write the defaults of missing coefficients, marked as such.
    digits : int, optional
        Significant digits of the coefficients; by default all.
    """
    sections = _sections(model, complete, digits)
    lines = _header(model, comments)
    lines += _units(model)
    for section in (*LAYOUT, *sorted(set(sections) - set(LAYOUT))):
        entries = sections.get(section)
        if entries:
            lines += [_rule(section), f"[{section}]"]
            lines += [entry_line(key, *value) for key, value in _ordered(section, entries)]
    return "\n".join(lines) + "\n"


def entry_line(key: str, value: str, words: str = "") -> str:
    """Return ``KEY = value $words`` in columns; blanks around ``=`` because some readers count on them."""
    line = f"{key:<24} = {value:<20}"
    return f"{line} ${words}" if words else line.rstrip()


def version_labels(version: str) -> dict[str, str]:
    """Return the values of ``PROPERTY_FILE_FORMAT`` and, unless it is PAC2002, ``FITTYP``."""
    if version == "PAC2002":
        return {"PROPERTY_FILE_FORMAT": "'PAC2002'"}
    return {"PROPERTY_FILE_FORMAT": "'MF-TYRE'", "FITTYP": VERSION_FITTYP[version]}


def metadata_entries(metadata: Mapping[str, object]) -> dict[tuple[str, str], str | float]:
    """Return the metadata that a file can hold: (section, key) -> number or text.

    The version's labels are left out (the model's version decides them), and ``[UNITS]`` and
    ``[MDI_HEADER]``.
    """
    found: dict[tuple[str, str], str | float] = {}
    for name, value in metadata.items():
        match = _METADATA_NAME(name)
        if match is None or match[2] in _LABELS or not isinstance(value, str | int | float):
            continue
        section = section_name(match[1])
        if isinstance(value, str) and match[2] in DIMENSION:
            continue
        if section not in NEVER_COEFFICIENTS and not names_coefficient(section, match[2]):
            found[section, match[2]] = value
    return found


def writable_defaults(model: TireModel) -> dict[str, float]:
    """Return the defaults of missing coefficients, without the zeros that no file may hold (a radius,
    PCX1)."""
    return {name: value for name, value in model.defaulted.items() if is_possible(name, value)}


def value_text(value: str | float) -> str:
    """Return a metadata value as it is written: a number, or a quoted text."""
    return quoted(value) if isinstance(value, str) else format_number(value)


def _sections(model: TireModel, complete: bool, digits: int | None) -> dict[str, dict[str, tuple[str, str]]]:
    found: dict[str, dict[str, tuple[str, str]]] = {}
    labels = found.setdefault("MODEL", {})
    for key, text in version_labels(model.version).items():
        labels[key] = (text, describe("MODEL", key))
    labels["USE_MODE"] = ("4" if model.version == "PAC2002" else "14", describe("MODEL", "USE_MODE"))
    for (section, key), value in metadata_entries(model.metadata).items():
        found.setdefault(section, {})[key] = (value_text(value), describe(section, key))
    if complete:
        for key, number in writable_defaults(model).items():
            found.setdefault(home_section(key), {})[key] = (format_number(number), NOT_GIVEN)
    for key, number in model.coefficients.items():
        section = home_section(key)
        found.setdefault(section, {})[key] = (format_number(number, digits), describe(section, key))
    return found


def _header(model: TireModel, comments: Iterable[str]) -> list[str]:
    name = model.version if model.version == "PAC2002" else f"MF-Tyre {model.version}"
    return [
        "[MDI_HEADER]",
        entry_line("FILE_TYPE", "'tir'"),
        entry_line("FILE_VERSION", "3.0"),
        entry_line("FILE_FORMAT", "'ASCII'"),
        f"! : TIRE_VERSION :      {name}",
        *(f"! : COMMENT :           {line}".rstrip() for line in comment_lines(comments)),
    ]


def _units(model: TireModel) -> list[str]:
    units = {
        "LENGTH": "meter",
        "FORCE": "newton",
        "ANGLE": "radians",
        "MASS": "kg",
        "TIME": "second",
    }
    if {"NOMPRES", "INFLPRES"} & {*model.coefficients, *model.defaulted}:
        units["PRESSURE"] = "pascal"
    return [_rule("UNITS"), "[UNITS]", *(entry_line(k, f"'{v}'") for k, v in units.items())]


def _rule(section: str) -> str:
    return "$" + section.lower().rjust(_RULE, "-")


def _ordered(section: str, entries: Mapping[str, tuple[str, str]]) -> Iterable[tuple[str, tuple[str, str]]]:
    order = {key: i for i, key in enumerate(LAYOUT.get(section, {}))}
    return sorted(entries.items(), key=lambda each: (order.get(each[0], len(order)), each[0]))
