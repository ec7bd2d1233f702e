"""The Matplotlib figure behind :func:`~tire_pipeline.pages.drawing.new_figure`; loaded where one is drawn."""

from __future__ import annotations

from typing import Any

from matplotlib.figure import Figure
from matplotlib.text import Text

from tire_pipeline.pages.visible_text import visible


class PlainTextFigure(Figure):
    """A figure in which a dollar is a dollar: names of files and categories are no formulas.

    Characters that are not seen, or that turn a text round, are drawn as their code points.
    """

    def draw(self, renderer: Any) -> None:
        """Draw, with formulas only in the labels of logarithmic axes."""
        powers: set[Text] = set()
        for axis in (each for axes in self.axes for each in (axes.xaxis, axes.yaxis)):
            labels = axis.get_majorticklabels()  # also updates them
            if axis.get_scale() != "linear":
                powers.update(labels, axis.get_minorticklabels())
        for text in self.findobj(Text):
            if text not in powers:
                text.set_parse_math(False)
                if (shown := visible(text.get_text())) != text.get_text():
                    text.set_text(shown)
        super().draw(renderer)
