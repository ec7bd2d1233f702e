"""The front page: one link to every report that is there, and the command for each that is not."""

from __future__ import annotations

import datetime
import html
import re
from collections.abc import Mapping
from pathlib import Path

from tire_pipeline.reporting.page_parts import Links, Picture, Text, render_page

FRONT = "index.html"
_MAIN = re.compile(r'<div class="main">(.*?)</div>', re.S)
_PARAGRAPH = re.compile(r"<p[^>]*>(.*?)</p>", re.S)
_CODE_TAG = re.compile(r"</?code>")
LEADS = (
    ("report.html", "How well the translation works"),
    ("translated_files.html", "Your files, translated"),
    ("mismatch.html", "Your recordings"),
)

REPORTS = (
    (
        "Files, classifier, agent, evaluation",
        (
            (
                "report.html",
                "Translation, classification and reading of the files",
                "kedro run",
            ),
            ("confusion_matrix.png", "Confusion matrix of the classifier", "kedro run"),
            ("learning_curve.png", "Learning curve of the thesis' agent", "kedro run"),
            (
                "force_curves.png",
                "Lateral force before and after translation",
                "kedro run",
            ),
        ),
    ),
    (
        "Translations",
        (
            ("translated_files.html", "Your files, translated", "kedro run --pipeline translate"),
            (
                "translation.html",
                "How well every translator does",
                "kedro run --pipeline compare_translators",
            ),
            ("thesis.html", "The thesis, reproduced", "kedro run --pipeline reproduce_thesis"),
        ),
    ),
    (
        "Recordings, mismatches, proof",
        (
            (
                "mismatch.html",
                "All recordings",
                "kedro run --pipeline explain_mismatch",
            ),
            (
                "mismatch/**/*.html",
                "Where recording and simulation differ",
                "kedro run --pipeline explain_mismatch",
            ),
            (
                "proof.html",
                "The proof: how many concealed cases were explained",
                "kedro run --pipeline prove_concealed",
            ),
        ),
    ),
    ("Tables (CSV), the newest of each", (("tables/*.csv", "Tables", "kedro run"),)),
    (
        "Retraining and lineage",
        (
            (
                "retraining.html",
                "Retraining: new files, drift, released model",
                "kedro run --pipeline retrain",
            ),
            ("lineage.html", "Lineage: how every result is made", "make viz-page"),
        ),
    ),
)

PICTURES = (
    (
        "force_curves.png",
        "Lateral force over slip angle. Solid: measured by each source. Dashed: translated; a file that was "
        "not translated has its solid line only. If the target measured the tires too, its curve is the "
        "thick one, and the second row shows the differences from it: dashed lines should lie near zero.",
    ),
    (
        "confusion_matrix.png",
        "Share of the files of each organisation (rows) for which the classifier predicts each organisation "
        "(columns). Right predictions are on the diagonal. The classifier has not seen these files. Left: "
        "it may have learned from another organisation's file of the same tire. Right: it has not.",
    ),
)


def front_page(folder: Path, described: Mapping[str, str] | None = None) -> str:
    """Link all reports in a folder.

    Parameters
    ----------
    folder : Path
        ``data/08_reporting``.
    described : mapping of str to str, optional
        Name of a table -> what it holds, in a sentence.

    Returns
    -------
    str
        A page that opens without a network; titles and names of files are escaped.
    """
    parts: list[Text | Links | Picture] = [
        Text(
            [
                "Tire property files (.tir): which organisation measured them, what another organisation "
                "would have measured, and why a recording differs from the simulation."
            ]
        ),
        *_what_matters(folder),
    ]
    for heading, reports in REPORTS:
        items = [item for report in reports for item in _items(folder, *report, described or {})]
        parts.append(Links(items, heading=heading))
    return render_page("Tire pipeline: all reports", parts, footer="Updated after every run.")


def _what_matters(folder: Path) -> list[Text | Links | Picture]:
    """The first sentence of each report, and the pictures that go with them."""
    said = [(name, text) for name, _ in LEADS if (text := _lead(folder / name))]
    parts: list[Text | Links | Picture] = []
    if said:
        links = [(name, dict(LEADS)[name], text) for name, text in said]
        parts.append(Links(links, heading="Results"))
    for name, caption in PICTURES:
        found = _newest(folder / name)
        if found is not None:
            parts.append(Picture(found.relative_to(folder).as_posix(), caption))
    return parts


def _lead(page: Path) -> str:
    """The first paragraph of a page's main message."""
    if not page.is_file():
        return ""
    with page.open(encoding="utf-8", errors="replace") as file:
        return " ".join(main_message(file.read(40_000))[:1])


def main_message(page: str) -> list[str]:
    """Read the main message of a page: what stands in its emphasised box.

    Parameters
    ----------
    page : str
        HTML as ``render_page`` writes it, or the part of it that holds the box.

    Returns
    -------
    list of str
        One entry a paragraph, as plain text; empty if the page has no such box.

    Examples
    --------
    >>> main_message(render_page("Tires", [Text(["One & all: `run`.", "<b> stays."], emphasis=True)]))
    ['One & all: `run`.', '<b> stays.']
    """
    box = _MAIN.search(page)
    paragraphs = _PARAGRAPH.findall(box[1]) if box else []
    return [html.unescape(_CODE_TAG.sub("`", text)).strip() for text in paragraphs]


def _items(
    folder: Path, pattern: str, name: str, command: str, described: Mapping[str, str]
) -> list[tuple[str, str, str]]:
    found = [newest for path in sorted(folder.glob(pattern)) if (newest := _newest(path)) is not None]
    if not found:
        return [("", name, f"not made yet: {command}")]
    places = [path.relative_to(folder) for path in found]
    return [
        (place.as_posix(), _one_of(name, place) if "*" in pattern else name, _said_of(place, path, described))
        for place, path in zip(places, found, strict=True)
    ]


def _said_of(place: Path, path: Path, described: Mapping[str, str]) -> str:
    """What a table holds, and the date of any report."""
    return " ".join(filter(None, [described.get(place.stem) if place.suffix == ".csv" else "", _date(path)]))


def _one_of(name: str, place: Path) -> str:
    """What one of the reports of a kind is called, of which there may be several."""
    if place.suffix == ".csv":
        return place.stem.replace("_", " ")
    return f"{name}: {Path(*place.parts[1:]).with_suffix('').as_posix()}"


def _newest(path: Path) -> Path | None:
    """The file itself, or its newest version."""
    if path.is_file():
        return path
    return max(path.glob(f"*/{path.name}"), default=None)


def _date(path: Path) -> str:
    return f"{datetime.datetime.fromtimestamp(path.stat().st_mtime):%Y-%m-%d %H:%M}"
