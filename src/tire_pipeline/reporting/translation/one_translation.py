"""The figure of one translated tire: source, translation, and the band of the target's own measurement."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from tire_pipeline.channels import SHOWN_UNITS, SLIP_OF_FORCE, axis_label
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.pages.drawing import colour_of, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def draw_translation(
    source: TireModel, translated: TireModel | None, bands: Mapping[str, Any]
) -> tuple[Figure, str]:
    """Draw the forces of one tire before and after its translation.

    Parameters
    ----------
    source : TireModel
    translated : TireModel or None
        None if it was left alone.
    bands : mapping of str to Band
        Of this tire alone (``TranslationResult.bands``).

    Returns
    -------
    figure : matplotlib.figure.Figure
    caption : str
    """
    shown = [name for name in SLIP_OF_FORCE if name in bands] or ["fy"]
    figure, axes = new_figure(1, len(shown), width=3.6 * len(shown) + 0.6, height=3.6, squeeze=False)
    for panel, output in zip(np.asarray(axes).ravel(), shown, strict=True):
        _draw(panel, output, source, translated, bands.get(output))
    np.asarray(axes).ravel()[0].legend(fontsize=7, title="normal load", title_fontsize=7)
    caption = (
        "Dashed: the file as it is. Solid: translated. " if translated is not None else "Dashed: the file. "
    )
    if any(np.isfinite(bands[name].low).any() for name in shown if name in bands):
        caption += "Shaded: where the target's own measurement is expected with 90% probability. "
    return figure, f"{caption}One colour a load; pure slip, no camber."


def _draw(panel: Any, output: str, source: TireModel, translated: TireModel | None, band: Any) -> None:
    slip, scale = SLIP_OF_FORCE[output], SHOWN_UNITS[output].factor
    loads = [source.value("FNOMIN")] if band is None else band.normal_load
    x = np.linspace(-0.2, 0.2, 81) if band is None else band.slip
    across = x * SHOWN_UNITS[slip].factor
    for i, load in enumerate(loads):
        colour = colour_of(i)
        for model, line in ((source, "--"), (translated, "-")):
            if model is None:
                continue
            points: dict[str, Any] = {slip: x, "normal_load": load}
            force = getattr(model.forces(**points, limits="ignore", outputs=(output,)), output)
            label = f"{load:,.0f} N" if line == "-" or translated is None else None
            panel.plot(across, force * scale, line, color=colour, lw=1.2, label=label)
        if band is not None:
            panel.fill_between(
                across, band.low[0, i] * scale, band.high[0, i] * scale, color=colour, alpha=0.25, lw=0
            )
    panel.set_xlabel(axis_label(slip))
    panel.set_ylabel(axis_label(output))
