"""One agent of the grid, judged on sets of evaluation tires; and what can be had without any agent."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.evaluation import Curves, EvaluationGrid, curves_of, evaluate_translations
from tire_pipeline.representations.base import CURVE_LOADS, CURVE_SLIP_ANGLES
from tire_pipeline.translation.thesis.grid import Cell
from tire_pipeline.translation.thesis.translator import AgentTranslator

_WINDOWS = 60


def judged_agent(
    state: Mapping[str, Any],
    cell: Cell,
    seed: int,
    sources: pd.DataFrame,
    references: pd.DataFrame,
    *,
    curves_of_set: str = "four",
) -> dict[str, pd.DataFrame]:
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
    translator = AgentTranslator.from_state(state)
    found: dict[str, list[pd.DataFrame]] = {"agents": [], "actions": [], "agent_tires": []}
    kept: dict[str, pd.DataFrame] = {}
    for name in dict.fromkeys(sources["set"]):
        rows = (sources["set"] == name).to_numpy()
        path = translator.follow(sources[rows])
        as_tires, as_curves = _both_decodings(translator, sources[rows], references[rows])
        for decoding, of in (("tire", as_tires), ("curves", as_curves)):
            result = evaluate_translations(of["translated"], of["source"], of["target"])
            rows_of = result.summary.rename_axis("metric").reset_index()
            found["agents"].append(rows_of.assign(decoding=decoding, set=name))
        actions = pd.DataFrame({"action": translator.action_names, "count": path.action_counts})
        found["actions"].append(actions.assign(set=name))
        tires = {"before": path.start_valuations, "after": path.valuations, "reached": path.reached}
        found["agent_tires"].append(pd.DataFrame(tires).assign(set=name))
        if name == curves_of_set:
            kept = _drawn(sources[rows], as_tires, as_curves["translated"])
    frames = {key: pd.concat(parts, ignore_index=True) for key, parts in found.items()} | kept
    return {key: frame.assign(seed=seed, **asdict(cell)) for key, frame in frames.items()}


def _both_decodings(
    translator: AgentTranslator, sources: pd.DataFrame, references: pd.DataFrame
) -> tuple[dict[str, Curves], dict[str, Curves]]:
    """Curves of ``source``, ``translated`` and ``target``: from tires, and as the thesis decodes them."""
    as_tires = {
        kind: curves_of(table, lateral_only=True)
        for kind, table in (
            ("source", sources),
            ("translated", translator.translate(sources)),
            ("target", references),
        )
    }
    decoded = translator.translate_curves(sources)
    own = as_tires["source"].fy
    unreal = ~np.isfinite(decoded).all(axis=(1, 2))  # no real solution (Appendix C): not translated
    fy = np.where(unreal[:, None, None], own, decoded)
    forces = {"source": own, "translated": fy, "target": as_tires["target"].fy}
    as_curves = {kind: curves_of_forces(each) for kind, each in forces.items()}
    for curves in (as_tires, as_curves):
        curves["translated"] = _but_for_rounding(curves["translated"], curves["source"])
    return as_tires, as_curves


def _but_for_rounding(translated: Curves, source: Curves) -> Curves:
    """What differs from the source by rounding only is the source's: it is neither better nor worse."""
    same = {}
    for name in ("fy", "cornering_stiffness", "peak_friction"):
        ours, own = getattr(translated, name), getattr(source, name)
        same[name] = np.where(np.isclose(ours, own, rtol=1e-8, atol=1e-6 if name == "fy" else 0.0), own, ours)
    return Curves(**same)


def curves_of_forces(fy: np.ndarray) -> Curves:
    """Slope at the origin and peak friction of sampled forces, shape (n, 3, 100), at their loads."""
    right = len(CURVE_SLIP_ANGLES) // 2  # the two middle slip angles lie on both sides of the origin
    width = CURVE_SLIP_ANGLES[right] - CURVE_SLIP_ANGLES[right - 1]
    return Curves(
        fy=fy,
        cornering_stiffness=np.abs(fy[..., right] - fy[..., right - 1]) / width,
        peak_friction=np.abs(fy).max(axis=2) / CURVE_LOADS,
    )


def judged_floor(sources: pd.DataFrame, references: pd.DataFrame, again: pd.DataFrame) -> pd.DataFrame:
    """Return the error of the target's own second measurement of every tire, which is the floor.

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
    """Return the mean episode reward in 60 windows of training steps (Figure 5.9).

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


def _drawn(sources: pd.DataFrame, as_tires: dict[str, Curves], decoded: Curves) -> dict[str, pd.DataFrame]:
    """Forces over slip angle, stiffness and friction over load, of every tire and supplier."""
    grid = EvaluationGrid()
    forces, over_load = [], []
    for index, (tire, category) in enumerate(zip(sources["tire"], sources["category"], strict=True)):
        for kind, curves in (*as_tires.items(), ("decoded", decoded)):
            which = {"tire": tire, "category": category, "kind": kind}
            for load, fy in zip(grid.loads, curves.fy[index], strict=True):
                curve = pd.DataFrame({"slip_angle": grid.slip_angles, "fy": fy})
                forces.append(curve.assign(normal_load=load, **which))
            if kind == "decoded":
                continue
            assert curves.cornering_stiffness is not None  # lateral_only gives all three
            assert curves.peak_friction is not None
            columns = {
                "normal_load": grid.load_axis,
                "cornering_stiffness": curves.cornering_stiffness[index],
                "peak_friction": curves.peak_friction[index],
            }
            over_load.append(pd.DataFrame(columns).assign(**which))
    return {
        "force_curves": pd.concat(forces, ignore_index=True),
        "load_curves": pd.concat(over_load, ignore_index=True),
    }
