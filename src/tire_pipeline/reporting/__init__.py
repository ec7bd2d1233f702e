"""Pages and figures: self-contained HTML that opens without a network, and one look for all figures."""

from tire_pipeline.pages.drawing import COLOURS, MARKERS, colour_of, inline_svg, new_figure
from tire_pipeline.reporting.front import front_page
from tire_pipeline.reporting.page_parts import HOME, Drawing, Figure, Links, Part, Table, Text, render_page

__all__ = [
    "COLOURS",
    "HOME",
    "MARKERS",
    "Drawing",
    "Figure",
    "Links",
    "Part",
    "Table",
    "Text",
    "colour_of",
    "front_page",
    "inline_svg",
    "new_figure",
    "render_page",
]
