"""One agent of the grid, judged on sets of evaluation tires; and what can be had without any agent."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.evaluation import EvaluationGrid, curves_of, evaluate_translations
from tire_pipeline.translation.thesis.grid import Cell, judge_cell
from tire_pipeline.translation.thesis.translator import AgentTranslator

Frames = dict[str, pd.DataFrame]
_WINDOWS = 60


def judged_agent(
    state: Mapping[str, Any],
    cell: Cell,
    seed: int,
    sources: pd.DataFrame,
    references: pd.DataFrame,
    *,
    curves_of_set: str = "four",
) -> Frames:
    """Translate evaluation tires with one agent and compare with what the target measured.

    Parameters
    ----------
    state : mapping
        Of the trained agent.
    cell : Cell
    seed : int
    sources, references : DataFrame
        Row by row the same physical tire, with ``set`` and ``tire``: as another category measured it, and
        as the target did.
    curves_of_set : str
        The set whose curves are kept for the figures.

    Returns
    -------
    dict of DataFrame
        ``agents`` (``set, decoding, metric, ratio, improved, worst, files``), ``actions`` (``set, action,
        count``), ``agent_tires`` (``set, before, after, reached``), and of one set ``force_curves`` and
        ``load_curves``; all with the cell and the seed.
    """
    found: dict[str, list[pd.DataFrame]] = {"agents": [], "actions": [], "agent_tires": []}
    for name in dict.fromkeys(sources["set"]):
        rows = (sources["set"] == name).to_numpy()
        judged = judge_cell(state, sources[rows], references[rows])
        for key, frame in zip(found, (judged["metrics"], judged["actions"], judged["tires"]), strict=True):
            found[key].append(frame.assign(set=name))
    frames = {key: pd.concat(parts, ignore_index=True) for key, parts in found.items()}
    rows = (sources["set"] == curves_of_set).to_numpy()
    if rows.any():
        frames |= _curves(AgentTranslator.from_state(state), sources[rows], references[rows])
    return {key: frame.assign(seed=seed, **asdict(cell)) for key, frame in frames.items()}


def judged_floor(sources: pd.DataFrame, references: pd.DataFrame, again: pd.DataFrame) -> pd.DataFrame:
    """Say how near the target comes to itself when it measures every tire again: no translator does better.

    Returns
    -------
    DataFrame
        ``set, metric, ratio, improved, worst, files``.
    """
    parts = []
    for name in dict.fromkeys(sources["set"]):
        rows = (sources["set"] == name).to_numpy()
        result = evaluate_translations(again[rows], sources[rows], references[rows], lateral_only=True)
        parts.append(result.summary.reset_index().assign(set=name))
    return pd.concat(parts, ignore_index=True)


def thinned_learning_curve(curve: pd.DataFrame) -> pd.DataFrame:
    """Give the mean episode reward in 60 windows of training steps (Figure 5.9).

    Parameters
    ----------
    curve : DataFrame
        One row an episode: ``step, reward, length``.

    Returns
    -------
    DataFrame
        ``step`` (end of the window), ``reward``, ``length``, ``episodes``.
    """
    if curve.empty:
        return pd.DataFrame({"step": [], "reward": [], "length": [], "episodes": []})
    last = float(curve["step"].max())
    window = np.minimum((curve["step"].to_numpy() / max(last, 1.0) * _WINDOWS).astype(int), _WINDOWS - 1)
    grouped = curve.groupby(window)
    thin = grouped[["reward", "length"]].mean()
    thin.insert(0, "step", (thin.index.to_numpy() + 1) * last / _WINDOWS)
    thin["episodes"] = grouped.size()
    return thin.reset_index(drop=True)


def _curves(translator: AgentTranslator, sources: pd.DataFrame, references: pd.DataFrame) -> Frames:
    """Forces over slip angle, stiffness and friction over load, of every tire and supplier."""
    grid = EvaluationGrid()
    decoded = translator.translate_curves(sources)
    of = {
        "source": curves_of(sources, grid, lateral_only=True),
        "translated": curves_of(translator.translate(sources), grid, lateral_only=True),
        "target": curves_of(references, grid, lateral_only=True),
    }
    forces, over_load = [], []
    for index, (tire, category) in enumerate(zip(sources["tire"], sources["category"], strict=True)):
        which = {"tire": tire, "category": category}
        for kind, curves in of.items():
            for number, load in enumerate(grid.loads):
                fy = curves.fy[index, number]
                forces.append(_curve(grid.slip_angles, fy, kind=kind, normal_load=load, **which))
            stiffness, friction = curves.cornering_stiffness, curves.peak_friction
            assert stiffness is not None  # lateral_only gives all three
            assert friction is not None
            frame = pd.DataFrame(
                {
                    "normal_load": grid.load_axis,
                    "cornering_stiffness": stiffness[index],
                    "peak_friction": friction[index],
                }
            )
            over_load.append(frame.assign(kind=kind, **which))
        for number, load in enumerate(grid.loads):
            fy = decoded[index, number]
            forces.append(_curve(grid.slip_angles, fy, kind="decoded", normal_load=load, **which))
    return {
        "force_curves": pd.concat(forces, ignore_index=True),
        "load_curves": pd.concat(over_load, ignore_index=True),
    }


def _curve(slip_angles: np.ndarray, fy: np.ndarray, **which: Any) -> pd.DataFrame:
    return pd.DataFrame({"slip_angle": slip_angles, "fy": fy}).assign(**which)
