"""The tables of docs/reference/recordings.md are made from the code; run this file to make them again."""

from pathlib import Path

from tire_pipeline.recordings.conventions.channel_names import CANONICAL, FURTHER
from tire_pipeline.recordings.conventions.foreign_names import FRENCH, GERMAN
from tire_pipeline.recordings.conventions.units import UNITS_BY_NAME, find_unit

PAGE = Path(__file__).resolve().parents[2] / "docs" / "reference" / "recordings.md"
MARK = "<!-- {}: made by tests/recordings/test_recordings_docs.py -->"


def names_table() -> str:
    lines = ["| column | unit | names |", "| --- | --- | --- |"]
    for channel in CANONICAL:
        aliases = ", ".join(f"`{a}`" for a in channel.aliases)
        lines.append(f"| `{channel.name}` | {channel.unit} | {aliases} |")
    lines += ["", "Further channels, kept and brought to SI:", "", "| column | unit | names |"]
    lines.append("| --- | --- | --- |")
    for channel in FURTHER:
        aliases = ", ".join(f"`{a}`" for a in channel.aliases)
        lines.append(f"| `{channel.name}` | {channel.unit} | {aliases} |")
    lines += [
        "",
        "In German (with `ae` for `ä` and so on, too) and French:",
        "",
        "| column | German | French |",
    ]
    lines.append("| --- | --- | --- |")
    for name in (each.name for each in (*CANONICAL, *FURTHER)):
        if name in GERMAN or name in FRENCH:
            cells = (", ".join(f"`{a}`" for a in language.get(name, ())) for language in (GERMAN, FRENCH))
            lines.append(f"| `{name}` | {' | '.join(cells)} |")
    return "\n".join(lines)


def units_table() -> str:
    lines = ["| of | spellings (without blanks, dots and case) |", "| --- | --- |"]
    for dimension in dict.fromkeys(u.dimension for u in UNITS_BY_NAME.values()):
        spellings = ", ".join(f"`{n}`" for n, u in UNITS_BY_NAME.items() if u.dimension == dimension)
        lines.append(f"| {dimension} | {spellings} |")
    return "\n".join(lines)


def with_tables(text: str) -> str:
    for name, table in (("names", names_table()), ("units", units_table())):
        head, rest = text.split(MARK.format(name))
        tail = rest.split("<!-- end -->", 1)[1]
        text = f"{head}{MARK.format(name)}\n{table}\n<!-- end -->{tail}"
    return text


def test_the_page_says_what_the_code_knows():
    page = PAGE.read_text(encoding="utf-8")
    assert with_tables(page) == page, f"run `python {Path(__file__).name}`"


def test_every_spelling_is_found():
    for spelling in UNITS_BY_NAME:
        assert find_unit(spelling) is not None, spelling


if __name__ == "__main__":
    PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
