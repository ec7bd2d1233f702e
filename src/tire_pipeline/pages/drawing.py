"""One look for all figures and pages: Okabe-Ito colours (safe for the colour-blind), units on every axis."""

from __future__ import annotations

import io
import re
import textwrap
from collections.abc import Sequence
from importlib.resources import files as package_files
from typing import TYPE_CHECKING, Any, TypeVar

from markupsafe import Markup

from tire_pipeline.pages.visible_text import visible

if TYPE_CHECKING:
    from matplotlib.figure import Figure as MplFigure
    from matplotlib.figure import SubFigure

AnyFigure = TypeVar("AnyFigure", "MplFigure", "SubFigure")

#: Okabe and Ito (2008), in an order that also differs in lightness.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C6D1F")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
STYLE: Any = {
    "font.size": 10,
    "axes.grid": True,
    "grid.alpha": 0.3,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "svg.fonttype": "none",
    "svg.hashsalt": "tire-pipeline",
    "figure.constrained_layout.use": True,
}

_LEVEL_NAME = 3
"""Names of so many characters stand side by side."""
_STYLE_ELEMENT = re.compile(
    r'<style type="text/css">\*\{stroke-linejoin: round; stroke-linecap: butt\}</style>\s*'
)


def colour_of(index: int) -> str:
    """The colour of the n-th series; it repeats after eight."""
    return COLOURS[index % len(COLOURS)]


def new_figure(
    rows: int = 1, columns: int = 1, *, width: float = 9.0, height: float = 3.6, **options: Any
) -> tuple[MplFigure, Any]:
    """A figure and its axes in the project's style; no global state, no display.

    Parameters
    ----------
    rows, columns : int
        Grid of axes.
    width, height : float
        Size in inches.
    **options
        Passed to :meth:`matplotlib.figure.Figure.subplots`.

    Returns
    -------
    figure : matplotlib.figure.Figure
    axes : matplotlib.axes.Axes or array of Axes

    Examples
    --------
    >>> figure, axes = new_figure()
    >>> _ = axes.plot([0, 1], [0, 1])
    """
    from matplotlib import rc_context

    from tire_pipeline.pages.drawing_figure import PlainTextFigure

    with rc_context(STYLE):
        figure = PlainTextFigure(figsize=(width, height))
        axes = figure.subplots(rows, columns, **options)
    return figure, axes


def in_figure(name: object, most: int = 20) -> str:
    """Return a name of the user's files as it fits into a figure: the middle of a long one is left out.

    Examples
    --------
    >>> in_figure("North"), in_figure("Tire Testing Centre North", most=12)
    ('North', 'Tire …North')
    """
    text = visible(name)
    half = (most - 1) // 2
    return text if len(text) <= most else f"{text[:half].rstrip()} …{text[-half:].lstrip()}"


def name_ticks(axis: Any, names: Sequence[object]) -> None:
    """Name the places 0, 1, 2 ... of an axis; names stand upright below a figure if they are long.

    Parameters
    ----------
    axis : matplotlib.axis.Axis
    names : sequence
        Of categories.
    """
    shown = [in_figure(name) for name in names]
    upright = axis.axis_name == "x" and max(map(len, shown), default=0) > _LEVEL_NAME
    axis.set_ticks(range(len(shown)), shown, rotation=90 if upright else 0)


def inline_svg(figure: MplFigure) -> Markup:
    """The figure as an SVG element that can stand in a page; the same figure gives the same text."""
    from matplotlib import rc_context

    buffer = io.StringIO()
    with rc_context(STYLE):
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    svg = re.sub(
        r'(<svg[^>]*?) width="[^"]*" height="[^"]*"|(<svg[^>]*?) height="[^"]*"',
        r"\1\2",
        buffer.getvalue(),
        count=1,
    )
    return svg_element(svg)


def svg_element(file: str) -> Markup:
    """What Matplotlib wrote as an SVG file, as an element of a page that allows no styles but its own.

    Parameters
    ----------
    file : str
        Names in it (labels, legends) come out visible, see :func:`tire_pipeline.pages.visible_text.visible`.

    Returns
    -------
    Markup
        Without the file's one ``<style>``; the root has what it says.
    """
    svg, count = _STYLE_ELEMENT.subn("", visible(file[file.index("<svg") :]))
    if count != 1:
        raise ValueError(f"Matplotlib wrote {count} other <style> elements than are known")
    return Markup(svg.replace("<svg", '<svg stroke-linejoin="round" stroke-linecap="butt"', 1))


def page_style() -> str:
    """The style that all pages share: light and dark, and for print."""
    return package_files("tire_pipeline.pages").joinpath("templates", "page.css").read_text("utf-8")


def captioned(figure: AnyFigure, caption: str) -> AnyFigure:
    """Write a caption below a figure that stands alone; in a page the page's own caption says it.

    Parameters
    ----------
    figure : matplotlib.figure.Figure or SubFigure
        With a constrained layout, as from :func:`new_figure`, which makes room for it.
    caption : str
        What to see in it. It is broken into lines as wide as the figure.

    Returns
    -------
    matplotlib.figure.Figure or SubFigure
        The same figure.
    """
    width = int(figure.bbox.width / figure.figure.dpi * 15.0)  # characters of this size in a line
    figure.supxlabel(textwrap.fill(caption, width), x=0.01, ha="left", fontsize=8, color="#444444")
    return figure
