"""From the text of a ``.tir`` file to coefficients and metadata in SI, the version, and warnings."""

from __future__ import annotations

import math
import os
import re
from dataclasses import dataclass, field

from tire_pipeline.errors import TirSyntaxError, TirValueError
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.assumed_radius import check_stated_radius
from tire_pipeline.tir.format.keys import (
    DIMENSION,
    FORCE_SECTIONS,
    KEY_ALIASES,
    NEVER_COEFFICIENTS,
    is_in_equations,
    names_coefficient,
    names_force_coefficient,
)
from tire_pipeline.tir.format.units import FACTORS, QUANTITIES, dimension_factors, unit_factor
from tire_pipeline.tir.format.values import parse_number
from tire_pipeline.tir.format.version import detect_version
from tire_pipeline.tir.reading.header_date import measurement_date
from tire_pipeline.tir.reading.plausibility import odd_values
from tire_pipeline.tir.reading.two_tires import refuse_two_tires
from tire_pipeline.tir.sidecar import read_sidecar
from tire_pipeline.tir.text.document import Entry, Scan, TirFile, parse_tir

NEXT_WARNING = " | "
"""Between the warnings of a file where they stand in one cell of a table."""
_MAX_WARNINGS = 100
_NAMED_SECTIONS = 5
_HEADER_IN_COMMENT = re.compile(r"[$!][$! \t]*\[[^\[\]]+\]").match
_DIVISORS = ("PCX1", "PCY1", "PKY2")
_KEYS_OF_FORCE = {"longitudinal": ("PCX1", "PDX1", "PKX1"), "lateral": ("PCY1", "PDY1", "PKY1", "PKY2")}


@dataclass(slots=True)
class Reading:
    """A file's values in SI and where each comes from.

    ``origin`` holds the line and the factor to SI of each coefficient and metadata key, ``empty`` the same
    for coefficients whose value is not there.
    """

    version: str = ""
    coefficients: dict[str, float] = field(default_factory=dict)
    metadata: dict[str, object] = field(default_factory=dict)
    origin: dict[str, tuple[Entry, float]] = field(default_factory=dict)
    empty: dict[str, tuple[Entry, float]] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)
    factors: dict[str, float] = field(default_factory=dict)


def read_tir(
    source: str | os.PathLike[str] | bytes, *, path: str | None = None, unloaded_radius: float | None = None
) -> TireModel:
    """Read a tire property file.

    Values become SI (m, N, rad, kg, s, Pa) here, by the file's ``[UNITS]``, and nowhere else. The p, q, r, s
    coefficients and the scale factors are taken as they are (:mod:`tire_pipeline.tir.format.units`). See
    ``docs/reference/tir_format.md`` for every rule.

    Parameters
    ----------
    source : path or bytes
        The file, or its content.
    path : str, optional
        Name used in messages and in the model if ``source`` is bytes.
    unloaded_radius : float, optional
        ``UNLOADED_RADIUS`` (m) where the file states none. Without it such a file's moments are NaN.

    Returns
    -------
    TireModel
        ``defaulted`` lists what the version's equations need and the file lacks.
        ``metadata["warnings"]`` is a tuple of sentences about contradictions and oddities;
        ``metadata["date"]`` is the day of the measurement, ``YYYY-MM-DD``, if the header states it
        (:mod:`.header_date`); ``metadata["sidecar"]`` holds the corrections of ``<file>.sidecar.json`` if
        there is one beside the file. ``source`` is the :class:`TirFile`.

    Raises
    ------
    TirError
        The path cannot be read.
    TirSyntaxError
        Empty, binary, over 5 MB, without any Magic Formula coefficient, or with two tires in it.
    TirValueError
        A coefficient is not a number, is not finite, or has a value that the equations divide by (``FNOMIN =
        0``, ``PCY1 = 0``); a unit is not known. With file, line and key. ``unloaded_radius`` is no
        tire's: not positive, not finite, or in another unit than m.
    TirVersionError
        The version is unknown.

    See Also
    --------
    write_tir : The way back.
    parse_tir : Sections and entries without a meaning.

    Notes
    -----
    The form of the file and its units: docs/reference/tir_format.md.

    Examples
    --------
    >>> tire = read_tir("tire.tir")
    >>> tire.version, dict(tire.defaulted)
    ('5.2', {})
    """
    file = parse_tir(source, path=path)
    reading = interpret(file)
    _state_radius(reading, unloaded_radius)
    metadata = reading.metadata
    metadata["warnings"] = tuple(_bounded(reading.warnings))
    day = measurement_date(file.text)
    if day is not None:
        metadata["date"] = day.isoformat()
    if file.path is not None and not isinstance(source, bytes | bytearray | memoryview):
        sidecar = read_sidecar(file.path)
        if sidecar is not None:
            metadata["sidecar"] = sidecar
    try:
        return TireModel(
            version=reading.version,
            coefficients=reading.coefficients,
            metadata=metadata,
            source=file,
            path=file.path,
        )
    except TirValueError as error:
        raise _with_line(error, reading, file) from None


def file_warnings(model: TireModel) -> list[str]:
    """Return the sentences about contradictions and oddities of a model's file; none if it has no file."""
    found = model.metadata.get("warnings", ())
    return [str(text) for text in found] if isinstance(found, list | tuple) else []


def _state_radius(reading: Reading, radius: float | None) -> None:
    """Use the caller's radius if the file has none, with a warning; warn if there is none at all."""
    if radius is not None:
        check_stated_radius(radius)
        radius = float(radius)
    own = reading.coefficients.get("UNLOADED_RADIUS")
    if own is None and radius is None:
        reading.warnings.append(
            "there is no UNLOADED_RADIUS: Mx, My, Mz, the trail and relaxation lengths that are shares of it "
            "are NaN; state it (m) by read_tir(path, unloaded_radius=...) or --unloaded-radius"
        )
    elif own is None and radius is not None:
        reading.coefficients["UNLOADED_RADIUS"] = radius
        reading.warnings.append(f"UNLOADED_RADIUS = {radius:g} m was given by the caller; the file has none")
    elif radius is not None and radius != own:
        reading.warnings.append(
            f"UNLOADED_RADIUS = {own:g} m is the file's; the caller's {radius:g} m is not used"
        )


def interpret(file: TirFile) -> Reading:
    """Return the values of a file in SI; raises as :func:`read_tir`."""
    scan = file.scan()
    refuse_two_tires(scan, file)
    reading = Reading()
    _read_units(scan, file, reading)
    _read_entries(scan, file, reading)
    if not any(map(names_force_coefficient, reading.coefficients)):
        raise TirSyntaxError(
            "there is no Magic Formula coefficient in it",
            path=file.path,
            todo="use a tire property file with sections such as [LATERAL_COEFFICIENTS]",
        )
    _drop_what_is_not_modelled(reading)
    _read_version(scan, file, reading)
    _note_side(reading)
    _note_lines(scan, reading)
    _note_unknown_sections(scan, reading)
    reading.warnings += odd_values(reading.coefficients, reading.metadata, reading.factors)
    return reading


def _read_units(scan: Scan, file: TirFile, reading: Reading) -> None:
    units: dict[str, float] = {}
    stated: dict[str, Entry] = {}
    for entry in scan.entries:
        if entry.section != "UNITS" or entry.key not in FACTORS or not entry.value:
            continue
        factor = unit_factor(entry.key, entry.value, path=file.path, line=entry.line)
        if units.get(entry.key, factor) != factor:
            reading.warnings.append(
                f"two units of {entry.key} (lines {stated[entry.key].line} and {entry.line}): "
                "the last is taken"
            )
        units[entry.key], stated[entry.key] = factor, entry
    missing = [each for each in QUANTITIES if each not in units]
    if missing:
        reading.warnings.append(f"no unit of {', '.join(missing)}: taken as SI")
    reading.factors = dimension_factors(units)


def _read_entries(scan: Scan, file: TirFile, reading: Reading) -> None:
    coefficients, metadata, origin, factors = (
        reading.coefficients,
        reading.metadata,
        reading.origin,
        reading.factors,
    )
    for entry in scan.entries:
        section, key, text = entry.section, entry.key, entry.value
        is_coefficient = names_coefficient(section, key)
        if is_coefficient:
            key = KEY_ALIASES.get(key, key)
        name = key if is_coefficient else f"{section}.{key}"
        if not text:
            if is_coefficient:
                reading.empty[key] = (entry, factors[DIMENSION.get(key, "")])
                reading.warnings.append(f"{key} has no value (line {entry.line})")
            continue
        dimension = DIMENSION.get(key, "") if section not in NEVER_COEFFICIENTS else ""
        factor = factors[dimension] if dimension else 1.0
        number = parse_number(text)
        if number is None:
            if is_coefficient and (dimension or (section in FORCE_SECTIONS and is_in_equations(key))):
                raise _not_a_number(entry, file)
            if section in FORCE_SECTIONS:
                reading.warnings.append(_text_among_coefficients(entry, scan, file))
            if dimension:
                reading.warnings.append(f"{key} = {text[:40]!r} is not a number (line {entry.line})")
            if metadata.get(f"{section}.{key}", text) != text:
                reading.warnings.append(_two_texts(f"{section}.{key}", origin[f"{section}.{key}"][0], entry))
            metadata[f"{section}.{key}"] = text
            origin[f"{section}.{key}"] = (entry, 1.0)
            continue
        value = number if factor == 1.0 else number * factor
        if not math.isfinite(value):
            if is_coefficient:
                raise _not_a_number(entry, file)
            reading.warnings.append(f"{key} = {text[:40]!r} is out of range (line {entry.line})")
            continue
        if name in origin and not _replaces(entry, origin[name], value, name, reading):
            continue
        if is_coefficient:
            coefficients[key] = value
        else:
            metadata[name] = value
        origin[name] = (entry, factor)


def _two_texts(name: str, old: Entry, new: Entry) -> str:
    lines = f"lines {old.line} and {new.line}"
    return f"{name} is {old.value[:40]!r} and {new.value[:40]!r} ({lines}): the last is taken"


def _replaces(entry: Entry, present: tuple[Entry, float], value: float, name: str, reading: Reading) -> bool:
    """Whether a second value of a key replaces the first: the last one does, but an alias gives way to the
    key."""
    old = present[0]
    held = reading.coefficients.get(name, reading.metadata.get(name))
    new_is_alias, old_is_alias = entry.key != name, old.key != name
    replaces = old_is_alias or not new_is_alias or name not in reading.coefficients
    if held != value:
        taken = entry.line if replaces else old.line
        reading.warnings.append(
            f"{name} has two values (lines {old.line} and {entry.line}): that of line {taken} is taken"
        )
    return replaces


def _drop_what_is_not_modelled(reading: Reading) -> None:
    """Take zeros for no value where a whole force is zero: fits of one direction only leave the other one
    so."""
    for force, keys in _KEYS_OF_FORCE.items():
        values = [reading.coefficients.get(key) for key in keys]
        divided_by = [reading.coefficients.get(key) for key in keys if key in _DIVISORS]
        if any(values) or 0.0 not in divided_by:
            continue
        for key in keys:
            if key in reading.coefficients:
                del reading.coefficients[key]
                reading.empty[key] = reading.origin.pop(key)
        reading.warnings.append(f"{' = '.join(keys)} = 0: the {force} force is not modelled")


def _read_version(scan: Scan, file: TirFile, reading: Reading) -> None:
    labels: dict[str, Entry] = {}
    for entry in scan.entries:
        if entry.key not in ("FITTYP", "PROPERTY_FILE_FORMAT") or not entry.value:
            continue
        present = labels.get(entry.key)
        if present is None or present.section != "MODEL" or entry.section == "MODEL":
            labels[entry.key] = entry
    fittyp, file_format = labels.get("FITTYP"), labels.get("PROPERTY_FILE_FORMAT")
    reading.version, warnings = detect_version(
        fittyp=fittyp.value if fittyp else None,
        file_format=file_format.value if file_format else None,
        comment=_version_comment(file.text),
        keys=reading.coefficients.keys(),
        path=file.path,
        line=fittyp.line if fittyp else None,
    )
    reading.warnings += warnings


def _version_comment(text: str) -> str | None:
    at = text.find("TIRE_VERSION")
    if at < 0:
        return None
    start = max(text.rfind("\n", 0, at), text.rfind("\r", 0, at)) + 1
    if text[start : start + 1] not in ("!", "$"):
        return None
    return text[at + len("TIRE_VERSION") : at + 80].splitlines()[0].strip(" \t:=")


def _with_line(error: TirValueError, reading: Reading, file: TirFile) -> TirValueError:
    line = reading.origin[error.key][0].line if error.key in reading.origin else None
    return TirValueError(error.what, path=file.path, line=line, key=error.key, todo=error.todo)


def _note_side(reading: Reading) -> None:
    side = reading.metadata.get("MODEL.TYRESIDE")
    if isinstance(side, str):
        reading.metadata["MODEL.TYRESIDE"] = side.upper()
        if side.upper() not in ("LEFT", "RIGHT", "UNKNOWN", "SYMMETRIC"):
            reading.warnings.append(f"TYRESIDE = {side[:40]!r} is neither LEFT nor RIGHT")


def _note_lines(scan: Scan, reading: Reading) -> None:
    if scan.unread_count:
        lines = ", ".join(map(str, scan.unread[:5]))
        more = ", ..." if scan.unread_count > 5 else ""
        what = "line is" if scan.unread_count == 1 else "lines are"
        reading.warnings.append(f"{scan.unread_count} {what} of no known form and ignored: {lines}{more}")
    seen: dict[str, int] = {}
    for section in scan.sections:
        if section.name in seen:
            first = seen[section.name]
            reading.warnings.append(f"[{section.name[:40]}] occurs twice (lines {first} and {section.line})")
        seen[section.name] = section.line


def _note_unknown_sections(scan: Scan, reading: Reading) -> None:
    """Warn where coefficients stand in a section of no known name: they count as absent."""
    unread: dict[str, list[str]] = {}
    for entry in scan.entries:
        known = names_coefficient(entry.section, entry.key) or entry.section in NEVER_COEFFICIENTS
        if not known and names_force_coefficient(entry.key) and is_in_equations(entry.key):
            unread.setdefault(entry.section, []).append(entry.key)
    for section, keys in list(unread.items())[:_NAMED_SECTIONS]:
        reading.warnings.append(
            f"[{section[:40]}] is no section that is known: {len(keys)} coefficients in it are not read "
            f"({keys[0]}, ...)"
        )


def _text_among_coefficients(entry: Entry, scan: Scan, file: TirFile) -> str:
    """Warn about text that no equation reads in a section of numbers."""
    said = (
        f"{entry.key} = {entry.value[:40]!r} (line {entry.line}) is a text in [{entry.section}]: kept as "
        "metadata, no equation reads it"
    )
    top = max(each.line for each in scan.sections if each.line < entry.line)
    headers = [
        (line, text) for line, text in file.comments if top < line < entry.line and _HEADER_IN_COMMENT(text)
    ]
    if headers:
        line, text = headers[-1]
        said += f"; the section header above it is commented out ({text[:40]}, line {line})"
    return said


def _not_a_number(entry: Entry, file: TirFile) -> TirValueError:
    todo = "write a number; a comment after it starts with $"
    if "," in entry.value:
        todo = "write the decimal point as a point"
    if not entry.section:
        todo = "put the header of its section, such as [UNITS], above it: no section has begun here"
    return TirValueError(
        f"{entry.key} = {entry.value[:40]!r} is not a finite number",
        path=file.path,
        line=entry.line,
        key=entry.key,
        todo=todo,
    )


def _bounded(warnings: list[str]) -> list[str]:
    unique = list(dict.fromkeys(warnings))
    if len(unique) <= _MAX_WARNINGS:
        return unique
    return [*unique[:_MAX_WARNINGS], f"and {len(unique) - _MAX_WARNINGS} more"]
