"""Figures of trained classifiers and agents."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.score_on_splits import SPLIT_WORDS, SPLITS
from tire_pipeline.pages.drawing import colour_of, name_ticks, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def confusion_figure(confusion: pd.DataFrame) -> Figure:
    """Confusion matrices side by side, as shares of each true category (thesis, Figure 5.3)."""
    figure, axes = new_figure(1, len(SPLITS), width=4.6 * len(SPLITS), height=4.2)
    for one, split in zip(np.asarray(axes), SPLITS, strict=True):
        part = confusion[confusion["split"] == split]
        shares = part.pivot(index="true", columns="predicted", values="share")
        one.imshow(shares, vmin=0, vmax=1, cmap="Blues")
        one.grid(False)
        name_ticks(one.xaxis, shares.columns)
        name_ticks(one.yaxis, shares.index)
        one.set_xlabel("predicted category")
        one.set_ylabel("true category")
        one.set_title(SPLIT_WORDS[split])
        for row, values in enumerate(shares.to_numpy()):
            for column, value in enumerate(values):
                ink = "white" if value > 0.5 else "black"
                one.text(column, row, f"{value:.2f}", ha="center", va="center", color=ink, fontsize=8)
    return figure


def learning_figure(curve: pd.DataFrame) -> Figure:
    """Mean episode reward over training steps (thesis, Figure 5.9)."""
    figure, axes = new_figure()
    window = max(1, len(curve) // 100)
    smooth = curve["reward"].rolling(window, min_periods=1).mean()
    axes.plot(curve["step"], smooth, color=colour_of(0))
    axes.set_xlabel("training steps of all environments")
    axes.set_ylabel(f"episode reward\n(mean of {window} episodes)" if window > 1 else "episode reward")
    return figure
