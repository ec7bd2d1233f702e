"""Names of code on pages: public ones lead to their entry in the reference, and none may be stale."""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable, Mapping

_FENCE = re.compile(r"^(?:```|~~~).*?^(?:```|~~~)\s*$", re.S | re.M)
_DOTTED = re.compile(r"`(tire_pipeline(?:\.\w+)+)[^`]*`")
_SPAN = re.compile(r"(?<![\[`])`([\w.]+)(\([^`]*\))?`(?!`)")


def stale(text: str, groups: frozenset[str] = frozenset()) -> list[str]:
    """Return the full names on a page that the code does not have.

    Parameters
    ----------
    text : str
        Markdown.
    groups : frozenset of str
        Names that are no modules: groups of entry points.
    """
    return [name for name in _DOTTED.findall(text) if name not in groups and not _is_there(name)]


def linked(text: str, exports: Mapping[str, str]) -> str:
    """Return a page whose first mention of each public name is a link to the reference.

    Parameters
    ----------
    text : str
        Markdown. Fenced code and headings stay as they are.
    exports : mapping of str to str
        Name -> full name, by which the reference has it. A name of two packages is left out.
    """
    seen: set[str] = set()

    def link(found: re.Match[str]) -> str:
        full = exports.get(found[1].rpartition(".")[2] if found[1].startswith("tire_pipeline.") else found[1])
        if full is None or full in seen:
            return found[0]
        seen.add(full)
        return f"[{found[0]}][{full}]"

    parts, last = [], 0
    for fence in _FENCE.finditer(text):
        parts += [_in_lines(text[last : fence.start()], link), fence[0]]
        last = fence.end()
    return "".join([*parts, _in_lines(text[last:], link)])


def _in_lines(text: str, link: Callable[[re.Match[str]], str]) -> str:
    lines = text.split("\n")
    return "\n".join(line if line.startswith("#") else _SPAN.sub(link, line) for line in lines)


def _is_there(name: str) -> bool:
    parts = name.split(".")
    for count in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for part in parts[count:]:
            if not hasattr(found, part):
                return False
            found = getattr(found, part)
        return True
    return False
