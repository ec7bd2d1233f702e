"""A file that was read, with the values that were changed since: everything else stays to the byte."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.tir.format.keys import DIMENSION, NEVER_COEFFICIENTS
from tire_pipeline.tir.format.layout import describe, home_section
from tire_pipeline.tir.format.values import format_scaled
from tire_pipeline.tir.reading.read import Reading, interpret
from tire_pipeline.tir.text.document import Entry, Scan, TirFile
from tire_pipeline.tir.text.escaping import comment_lines
from tire_pipeline.tir.writing.fresh import (
    NOT_GIVEN,
    entry_line,
    metadata_entries,
    value_text,
    version_labels,
    writable_defaults,
)

Edit = tuple[int, int, str]


def edited_source(
    model: TireModel,
    source: TirFile,
    comments: Iterable[str] = (),
    *,
    complete: bool = False,
    digits: int | None = None,
) -> TirFile:
    """Return the model's source file with the model's values.

    A changed value replaces the old one on its line; a new coefficient goes to the end of its section; the
    line of one that the model no longer has becomes a comment; the labels follow the model's version if that
    was changed.

    Parameters
    ----------
    model : TireModel
    source : TirFile
    comments : iterable of str
        Added as comment lines at the top.
    complete : bool
        Add the defaults of missing coefficients.
    digits : int, optional
        Significant digits of changed values; values that agree with the source to as many digits stay.
    """
    work = _Work(source, digits)
    work.coefficients(model)
    work.metadata(model)
    if model.version != work.reading.version:
        work.labels(model)
    if complete:
        for name, value in writable_defaults(model).items():
            work.add(home_section(name), name, work.text(name, value), NOT_GIVEN)
    lines = [f"! {line}".rstrip() for line in comment_lines(comments)]
    return source.edited(work.finish(lines))


class _Work:
    """Collects the edits of one file."""

    def __init__(self, source: TirFile, digits: int | None) -> None:
        self.source = source
        self.digits = digits
        self.reading: Reading = interpret(source)
        self.scan: Scan = source.scan()
        self.edits: list[Edit] = []
        self.added: dict[str, list[str]] = defaultdict(list)

    def text(self, key: str, value: float, factor: float | None = None) -> str:
        if factor is None:
            factor = self.reading.factors[DIMENSION.get(key, "")]
        return format_scaled(value, factor, self.digits)

    def same(self, old: float, new: float) -> bool:
        return old == new or (self.digits is not None and abs(old - new) < 10.0**-self.digits * abs(old))

    def coefficients(self, model: TireModel) -> None:
        reading = self.reading
        for name, value in model.coefficients.items():
            if name in reading.coefficients:
                if not self.same(reading.coefficients[name], value):
                    entry, factor = reading.origin[name]
                    self.put(entry, self.text(name, value, factor))
            elif name in reading.empty:
                entry, factor = reading.empty[name]
                self.put(entry, self.text(name, value, factor))
            else:
                section = home_section(name)
                self.add(section, name, self.text(name, value), describe(section, name))
        for name in reading.coefficients.keys() - model.coefficients.keys():
            for entry in self.scan.entries:
                if entry.key not in (name, reading.origin[name][0].key):
                    continue
                if entry.section not in NEVER_COEFFICIENTS:
                    self.comment_out(entry)

    def metadata(self, model: TireModel) -> None:
        read = metadata_entries(self.reading.metadata)
        for (section, key), value in metadata_entries(model.metadata).items():
            origin = self.reading.origin.get(f"{section}.{key}")
            if (section, key) not in read or origin is None:
                self.add(section, key, self._metadata_text(key, value), describe(section, key))
            elif read[section, key] != value:
                self.put(origin[0], self._metadata_text(key, value))

    def _metadata_text(self, key: str, value: str | float) -> str:
        return value_text(value) if isinstance(value, str) else self.text(key, float(value))

    def labels(self, model: TireModel) -> None:
        wanted = version_labels(model.version)
        present = {entry.key: entry for entry in self.scan.entries if entry.section == "MODEL"}
        if "FITTYP" in present and "FITTYP" not in wanted:
            self.comment_out(present["FITTYP"])
        for key, text in wanted.items():
            if key not in present:
                self.add("MODEL", key, text, describe("MODEL", key))
            elif key == "FITTYP" or model.version == "PAC2002" or self._misleads(present[key]):
                self.put(present[key], text)

    def _misleads(self, entry: Entry) -> bool:
        return entry.value.upper() not in ("USER", "MF-TYRE", "MFTYRE", "MF-SWIFT")

    def put(self, entry: Entry, value: str) -> None:
        before = " " if self.source.text[entry.start - 1] == "=" else ""
        after = " " if self.source.text[entry.stop : entry.stop + 1] in ("$", "!") else ""
        self.edits.append((entry.start, entry.stop, before + value + after))

    def add(self, section: str, key: str, value: str, words: str) -> None:
        self.added[section].append(entry_line(key, value, words))

    def comment_out(self, entry: Entry) -> None:
        at = self._line_start(entry.start)
        if (at, at, "$ ") not in self.edits:
            self.edits.append((at, at, "$ "))

    def finish(self, top: list[str]) -> list[Edit]:
        text, end = self.source.text, self.source.line_ending
        edits = list(self.edits)
        if top:
            edits.append((0, 0, end.join(top) + end))
        tail = ""
        for section, lines in self.added.items():
            at = self._end_of(section)
            if at is None:
                tail += f"[{section}]{end}" + end.join(lines) + end
            elif text[at - 1 : at] in ("\n", "\r"):
                edits.append((at, at, end.join(lines) + end))
            else:
                edits.append((at, at, end + end.join(lines)))
        if tail:
            first = "" if text.endswith(("\n", "\r")) else end
            edits.append((len(text), len(text), first + tail))
        return edits

    def _end_of(self, section: str) -> int | None:
        """Return where a line can be added to a section: after its last key, or after its heading."""
        keys = [entry.stop for entry in self.scan.entries if entry.section == section]
        if keys:
            return self._next_line(keys[-1])
        headings = [each.start for each in self.scan.sections if each.name == section]
        return self._next_line(headings[-1]) if headings else None

    def _line_start(self, at: int) -> int:
        text = self.source.text
        return max(text.rfind("\n", 0, at), text.rfind("\r", 0, at)) + 1

    def _next_line(self, at: int) -> int:
        text = self.source.text
        ends = [i for i in (text.find("\n", at), text.find("\r", at)) if i >= 0]
        if not ends:
            return len(text)
        first = min(ends)
        return first + (2 if text[first : first + 2] == "\r\n" else 1)
