"""The text of a ``.tir`` file, line by line: what is a key, a comment, a table; nothing about its meaning."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from tire_pipeline.errors import TirSyntaxError
from tire_pipeline.tir.format.keys import section_name
from tire_pipeline.tir.format.values import parse_number
from tire_pipeline.tir.text.decode import decode, load_bytes

MAX_ENTRIES = 2_000
"""More keys than that are refused (real files have 100 to 400): it bounds the memory that a file can ask
for."""
MAX_SECTIONS = 1_000
_MAX_LISTED = 20

# Possessive quantifiers (*+) never give back what they took, so no line can make the search slower than its
# length.
_LINE = re.compile(
    r"""[ \t\f\v]*+
    (?: (?P<key>[A-Za-z_][A-Za-z0-9_.\-]*+) [ \t]*+ = [ \t]*+
        (?P<value> '[^'\r\n]*+' (?=[ \t]*+(?:[$!\r\n]|\Z))
                 | "[^"\r\n]*+" (?=[ \t]*+(?:[$!\r\n]|\Z))
                 | [^$!\r\n]*+ )
      | \[ (?P<section>[^\[\]\r\n]*+) \]
      | (?P<comment>[$!])
      | (?P<row>[-+.0-9])
      | \{ (?P<header>[^}\r\n]*+)
      | \( (?P<block>[^)\r\n]*+)
      | (?P<other>[^\s])
    )?+
    [^\r\n]*+ (?: \r\n | \r | \n | \Z )""",
    re.VERBOSE,
)
_QUOTES = ("'", '"')
_REST = re.compile(r"[ \t]*+(?:[$!\r\n]|\Z)")


class Entry(NamedTuple):
    """One ``KEY = value`` line."""

    section: str
    """Standard section name, in capitals; empty before the first section."""
    key: str
    """In capitals."""
    value: str
    """Text without quotes and comment; empty if there is none."""
    line: int
    """Counted from 1."""
    start: int
    """Where the value, quotes included, starts in the text."""
    stop: int
    """Where it ends."""


class TirSection(NamedTuple):
    """One ``[SECTION]`` line."""

    name: str
    line: int
    start: int
    """Where the line starts in the text."""


class DocumentTable(NamedTuple):
    """Consecutive rows of numbers under a section."""

    section: str
    header: str
    line: int
    """Of the first row."""
    start: int
    stop: int


@dataclass(slots=True)
class Scan:
    """The lines of a file, by kind."""

    entries: list[Entry] = field(default_factory=list)
    sections: list[TirSection] = field(default_factory=list)
    tables: list[DocumentTable] = field(default_factory=list)
    unread: list[int] = field(default_factory=list)
    """First lines that are not recognised (at most 20)."""
    unread_count: int = 0


@dataclass(frozen=True, slots=True)
class TirFile:
    r"""The text of a ``.tir`` file, kept exactly: encoding it again gives the bytes that were read.

    Parameters
    ----------
    text : str
        With its line ends as they are.
    encoding : str
        ``utf-8``, ``cp1252``, ``latin-1`` or ``utf-16``.
    mark : bytes
        Byte order mark, if any.
    path : str, optional
        Where it was read, for messages.

    See Also
    --------
    parse_tir : Makes one from text or bytes.
    read_tir : Reads a file into a tire model, which keeps this text.

    Notes
    -----
    Only the text is stored; ``scan`` and what is built on it go through the lines again, about half a
    millisecond for a file of 10 kB. The format is described in docs/reference/tir_format.md.

    Examples
    --------
    >>> file = TirFile("[LATERAL_COEFFICIENTS]\nPCY1 = 1.3  $ shape\n")
    >>> file.sections, file.entries[0].key
    (['LATERAL_COEFFICIENTS'], 'PCY1')
    """

    text: str
    encoding: str = "utf-8"
    mark: bytes = b""
    path: str | None = None

    def scan(self) -> Scan:
        """Go through the lines.

        Returns
        -------
        Scan
            Entries, sections and tables in order, and the lines that are none of these.

        Raises
        ------
        TirSyntaxError
            More than ``MAX_ENTRIES`` keys or ``MAX_SECTIONS`` sections.
        """
        return _scan(self.text, self.path)

    @property
    def entries(self) -> list[Entry]:
        """All ``KEY = value`` lines in order."""
        return self.scan().entries

    @property
    def sections(self) -> list[str]:
        """Standard names of the sections in order; one that stands twice is there twice."""
        return [each.name for each in self.scan().sections]

    @property
    def tables(self) -> list[DocumentTable]:
        """All tables in order; ``rows`` gives their numbers."""
        return self.scan().tables

    @property
    def comments(self) -> list[tuple[int, str]]:
        """Line number and text of every whole-line comment, ``(COMMENTS)`` blocks included."""
        return list(_comments(self.text))

    @property
    def line_ending(self) -> str:
        r"""The line end that is used most: ``\\n``, ``\\r\\n`` or ``\\r``."""
        pairs = self.text.count("\r\n")
        counts = {
            "\n": self.text.count("\n") - pairs,
            "\r\n": pairs,
            "\r": self.text.count("\r") - pairs,
        }
        return max(counts, key=lambda each: counts[each])

    def get(self, section: str, key: str, default: str | None = None) -> str | None:
        """Return the last value under a section and key, as it is written.

        Parameters
        ----------
        section : str
            Its standard name, or any other that files have for it.
        key : str
            In any case.
        default : str, optional
            Returned if there is none.

        Returns
        -------
        str or None
            Text: numbers and units are not interpreted.
        """
        wanted = (section_name(section), key.upper())
        found = [each.value for each in self.entries if (each.section, each.key) == wanted]
        return found[-1] if found else default

    def rows(self, table: DocumentTable) -> list[tuple[float, ...]]:
        """Return the numbers of a table.

        Parameters
        ----------
        table : DocumentTable
            One of :attr:`tables`.

        Returns
        -------
        list of tuple of float
            A tuple a row, as they stand in the file.

        Raises
        ------
        TirSyntaxError
            A cell is not a number.
        """
        rows = []
        lines = re.split(r"\r\n|\r|\n", self.text[table.start : table.stop])
        for number, line in enumerate(lines, table.line):
            cells = re.split(r"[$!]", line, maxsplit=1)[0].replace(",", " ").split()
            values = [parse_number(cell) for cell in cells]
            if None in values:
                raise TirSyntaxError(
                    f"a row of [{table.section}] holds something else than numbers",
                    path=self.path,
                    line=number,
                    todo="correct the row",
                )
            if values:
                rows.append(tuple(each for each in values if each is not None))
        return rows

    def edited(self, edits: Sequence[tuple[int, int, str]]) -> TirFile:
        """Return a file whose text has the spans replaced; everything else stays to the byte.

        Parameters
        ----------
        edits : sequence of (start, stop, text)
            Spans of the present text that do not overlap. An empty span inserts.

        Returns
        -------
        TirFile
            Of the same encoding and path.
        """
        pieces, at = [], 0
        for start, stop, new in sorted(edits, key=lambda each: each[:2]):
            pieces += [self.text[at:start], new]
            at = stop
        text = "".join(pieces) + self.text[at:]
        return TirFile(text, self.encoding, self.mark, self.path)

    def to_bytes(self) -> bytes:
        """Return the file's content.

        Returns
        -------
        bytes
            In the encoding it came in; UTF-8 if new text does not fit that.
        """
        try:
            return self.mark + self.text.encode(self.encoding)
        except UnicodeEncodeError:
            return self.text.encode("utf-8", errors="replace")


def parse_tir(source: str | os.PathLike[str] | bytes, *, path: str | None = None) -> TirFile:
    """Read a ``.tir`` file as text, without interpreting it.

    Parameters
    ----------
    source : str, path or bytes
        The file, or its content.
    path : str, optional
        Name used in messages if ``source`` is bytes.

    Returns
    -------
    TirFile
        Every line as it is, with the sections, keys and values found in it.

    Raises
    ------
    TirError
        The path cannot be read.
    TirSyntaxError
        Over 5 MB, empty, binary, or with no ``[section]`` and no ``KEY = value`` line at all.

    See Also
    --------
    read_tir : Reads it as a tire model.

    Notes
    -----
    The form of the file: docs/reference/tir_format.md.

    Examples
    --------
    >>> parse_tir("tire.tir").path
    'tire.tir'
    """
    if path is None and not isinstance(source, bytes | bytearray | memoryview):
        path = os.fspath(source)
    text, encoding, mark = decode(load_bytes(source, path), path)
    return TirFile(text, encoding, mark, path)


def _scan(text: str, path: str | None) -> Scan:
    result = Scan()
    entries, tables = result.entries, result.tables
    section, header, in_comments, in_table = "", "", False, False
    for line, match in enumerate(_LINE.finditer(text), 1):
        kind = match.lastgroup
        if kind is None or kind == "comment":
            continue
        if kind == "section" and not (in_comments and not _ends_after(text, match)):
            section, header, in_comments, in_table = section_name(match["section"]), "", False, False
            result.sections.append(TirSection(section, line, match.start()))
            _check_count(result.sections, MAX_SECTIONS, "sections", path, line)
        elif kind == "block":
            header = match["block"].strip()
            in_comments, in_table = header.upper().startswith("COMMENT"), False
        elif in_comments:
            continue
        elif kind == "value":
            in_table = False
            raw = match["value"].rstrip()
            start = match.start("value")
            value = _unquoted(raw) if raw[:1] in _QUOTES else raw
            entries.append(Entry(section, match["key"].upper(), value, line, start, start + len(raw)))
            _check_count(entries, MAX_ENTRIES, "keys", path, line)
        elif kind == "header":
            header, in_table = match["header"].strip(), False
        elif kind == "row" and in_table:
            tables[-1] = tables[-1]._replace(stop=_line_end(text, match))
        elif kind == "row":
            in_table = True
            tables.append(DocumentTable(section, header, line, match.start(), _line_end(text, match)))
            _check_count(tables, MAX_SECTIONS, "tables", path, line)
        else:
            in_table = False
            result.unread_count += 1
            if len(result.unread) < _MAX_LISTED:
                result.unread.append(line)
    return result


def _check_count(found: Sequence[object], limit: int, what: str, path: str | None, line: int) -> None:
    if len(found) > limit:
        raise TirSyntaxError(
            f"more than {limit} {what}",
            path=path,
            line=line,
            todo="check that it is a tire property file; real ones have a few hundred keys",
        )


def _line_end(text: str, match: re.Match[str]) -> int:
    end = match.end()
    while end > match.start() and text[end - 1] in "\r\n":
        end -= 1
    return end


def _ends_after(text: str, match: re.Match[str]) -> bool:
    """Whether only blanks or a comment follow a section's closing bracket."""
    return _REST.match(text, match.end("section") + 1) is not None


def _unquoted(value: str) -> str:
    """Return the text between the first quote and the next of its kind, if there is one."""
    return value[1:].split(value[0], 1)[0].strip()


def _comments(text: str) -> Iterator[tuple[int, str]]:
    in_comments = False
    for line, match in enumerate(_LINE.finditer(text), 1):
        kind = match.lastgroup
        if kind == "block":
            in_comments = match["block"].strip().upper().startswith("COMMENT")
        elif kind == "section":
            in_comments = in_comments and not _ends_after(text, match)
        if kind == "comment" or (in_comments and kind not in (None, "block")):
            yield line, match[0].strip()
