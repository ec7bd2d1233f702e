"""Figures of the agents: learning, force curves, curves over load, actions (Figures 5.9 to 5.16)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from tire_pipeline.pages.drawing import colour_of, in_figure, new_figure
from tire_pipeline.thesis.result_tables import Results, in_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure as MplFigure

FORCE_FIGURES = {
    "figure_5_10": "coefficients",
    "figure_5_11": "latent",
    "figure_5_12": "key_attributes",
    "figure_5_13": "power_series",
}
_DRAWN_LOAD = 6000.0


def shown(frame: pd.DataFrame, representation: str) -> pd.DataFrame:
    """Rows of the cell that the thesis draws (PPO, Reach Target Fast, 20 bins), first seed."""
    rows = frame[
        (frame["algorithm"] == "PPO")
        & (frame["reward"] == "reach_target_fast")
        & (frame["n_bins"] == 20)
        & (frame["representation"] == representation)
    ]
    return rows[rows["seed"] == rows["seed"].min()]


def learning_figure(results: Results) -> MplFigure | None:
    """Mean episode reward over training, 20 bins, Reach Target Fast (Figure 5.9); bands over the seeds."""
    frame = results["learning"]
    frame = frame[(frame["n_bins"] == 20) & (frame["reward"] == "reach_target_fast")]
    if frame.empty:
        return None
    algorithms = [name for name in ("PPO", "A2C") if name in set(frame["algorithm"])]
    columns = max(len(algorithms), 1)
    figure, axes = new_figure(1, columns, width=max(4.6 * columns, 9.0), height=3.6, sharey=True)
    names = list(dict.fromkeys(frame["representation"]))
    for one, algorithm in zip(np.atleast_1d(np.asarray(axes)), algorithms, strict=True):
        _draw_learning(one, frame[frame["algorithm"] == algorithm], names)
        one.set_title(algorithm)
        one.set_xlabel("training steps of all environments")
    first = np.atleast_1d(np.asarray(axes))[0]
    first.set_ylabel("reward of an episode")
    first.legend(fontsize=8)
    return figure


def _draw_learning(panel: Any, frame: pd.DataFrame, names: Sequence[str]) -> None:
    """Draw a representation's mean reward, and its deviation, in the colour of its place among the names."""
    for number, name in enumerate(names):
        part = frame[frame["representation"] == name]
        if part.empty:
            continue
        steps, mean, spread = _over_seeds(part)
        panel.plot(steps, mean, color=colour_of(number), label=in_words(name))
        panel.fill_between(steps, mean - spread, mean + spread, color=colour_of(number), alpha=0.15, lw=0)


def _over_seeds(part: pd.DataFrame) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Steps that all seeds have reached, mean reward there, and its standard deviation.

    Episodes end at other steps in each seed, so each seed's rewards are put on common steps first.
    """
    seeds = [one.sort_values("step") for _, one in part.groupby("seed")]
    first, last = (pick(one["step"].iloc[at] for one in seeds) for pick, at in ((max, 0), (min, -1)))
    steps = np.unique(part["step"].to_numpy(dtype=float))
    steps = steps[(steps >= first) & (steps <= last)]
    rewards = np.array([np.interp(steps, one["step"], one["episode_reward"]) for one in seeds])
    return steps, rewards.mean(axis=0), rewards.std(axis=0, ddof=1) if len(seeds) > 1 else 0.0 * steps


_FORCE_LINES: dict[str, tuple[str, dict[str, Any]]] = {
    "source": ("as measured", {"color": colour_of(0)}),
    "translated": ("translated .tir", {"color": colour_of(1), "ls": "--"}),
    "decoded": ("as the thesis decodes", {"color": colour_of(2), "lw": 0.8}),
    "target": ("target's measurement", {"color": "black", "lw": 0.9}),
}
"""Kind of a curve -> its label and style."""


def _draw_forces(panel: Any, part: pd.DataFrame) -> None:
    for kind, (label, style) in _FORCE_LINES.items():
        curve = part[part["kind"] == kind]
        panel.plot(np.degrees(curve["slip_angle"]), curve["fy"] / 1e3, label=label, **style)


def force_figure(results: Results, representation: str) -> MplFigure | None:
    """Lateral force at 6 kN of each tire (rows) and supplier (columns) (Figures 5.10 to 5.13)."""
    if "force_curves" not in results.frames:
        return None
    frame = shown(results["force_curves"], representation)
    frame = frame[frame["normal_load"] == _DRAWN_LOAD]
    if frame.empty:
        return None
    tires, suppliers = sorted(set(frame["tire"])), sorted(set(frame["category"]))
    rows, columns = len(tires), len(suppliers)
    figure, axes = new_figure(
        rows, columns, width=2.5 * columns, height=1.9 * rows, sharex=True, sharey=True, squeeze=False
    )
    limit = 1.3 * float(frame.loc[frame["kind"] != "decoded", "fy"].abs().max()) / 1e3
    grid: Any = axes
    for row, tire in enumerate(tires):
        for column, supplier in enumerate(suppliers):
            one = grid[row, column]
            _draw_forces(one, frame[(frame["tire"] == tire) & (frame["category"] == supplier)])
            one.set_title(f"{in_figure(tire)}, supplier {in_figure(supplier)}", fontsize=8)
            one.set_ylim(-limit, limit)
    _label_grid(figure, grid)
    return figure


def _label_grid(figure: MplFigure, grid: Any) -> None:
    for one in grid[-1]:
        one.set_xlabel("slip angle (deg)", fontsize=8)
    for one in grid[:, 0]:
        one.set_ylabel("lateral force (kN)", fontsize=8)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize=8)


def load_figure(results: Results, column: str, label: str, scale: float) -> MplFigure | None:
    """One quantity over load for each tire, latent representation (Figures 5.14, 5.15)."""
    if "load_curves" not in results.frames:
        return None
    frame = shown(results["load_curves"], "latent")
    if frame.empty:
        return None
    tires, suppliers = sorted(set(frame["tire"])), sorted(set(frame["category"]))
    figure, axes = new_figure(1, len(tires), width=2.9 * len(tires), height=3.3, sharey=True, squeeze=False)
    for one, tire in zip(np.asarray(axes)[0], tires, strict=True):
        part = frame[frame["tire"] == tire]
        for number, supplier in enumerate(suppliers):
            of = part[part["category"] == supplier]
            for kind, style in (("source", "-"), ("translated", "--")):
                curve = of[of["kind"] == kind]
                after = ", translated" if kind == "translated" else ""
                one.plot(
                    curve["normal_load"] / 1e3, curve[column] / scale, color=colour_of(number), ls=style,
                    lw=1.1, label=f"supplier {in_figure(supplier)}{after}",
                )  # fmt: skip
        target = part[(part["kind"] == "target") & (part["category"] == suppliers[0])]
        one.plot(target["normal_load"] / 1e3, target[column] / scale, color="black", lw=2, label="target")
        one.set_title(in_figure(tire), fontsize=9)
        one.set_xlabel("normal load (kN)")
    first = np.asarray(axes)[0, 0]
    first.set_ylabel(label)
    handles, labels = first.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize=7)
    return figure


def action_figure(results: Results) -> MplFigure | None:
    """How often each action is taken: latent and power series, PPO, 20 bins (Figure 5.16)."""
    frames = [shown(results["actions"], name) for name in ("latent", "power_series")]
    frames = [frame for frame in frames if not frame.empty]
    if not frames:
        return None
    figure, axes = new_figure(1, len(frames), width=4.8 * len(frames), height=4.6, squeeze=False)
    for one, frame in zip(np.asarray(axes)[0], frames, strict=True):
        counts = frame.groupby("action", sort=False)["count"].sum()
        shares = counts / max(counts.sum(), 1)
        one.barh(np.arange(len(shares)), shares, color=colour_of(0))
        one.set_yticks(np.arange(len(shares)), shares.index, fontsize=7)
        one.invert_yaxis()
        one.set_xlabel("share of all actions")
        one.set_title(in_words(frame["representation"].iloc[0]))
    return figure


def _force(representation: str) -> Callable[[Results], MplFigure | None]:
    return lambda results: force_figure(results, representation)


AGENT_FIGURES: dict[str, Callable[[Results], MplFigure | None]] = {
    "figure_5_9": learning_figure,
    **{name: _force(representation) for name, representation in FORCE_FIGURES.items()},
    "figure_5_14": lambda results: load_figure(
        results, "cornering_stiffness", "cornering stiffness (kN/rad)", 1e3
    ),
    "figure_5_15": lambda results: load_figure(results, "peak_friction", "peak friction", 1.0),
    "figure_5_16": action_figure,
}
"""File name -> how it is drawn."""
