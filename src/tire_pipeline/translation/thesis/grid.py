"""The 48 agents of the thesis' Table 4.4, cell by cell, and how each one is judged."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.representations.base import (
    CURVE_LOADS,
    CURVE_SLIP_ANGLES,
    REPRESENTATIONS,
    Representation,
)
from tire_pipeline.translation.thesis.rules import REWARDS
from tire_pipeline.translation.thesis.training import ALGORITHMS
from tire_pipeline.translation.thesis.translator import AgentTranslator

BIN_COUNTS = (10, 20, 40)


@dataclass(frozen=True)
class Cell:
    """One configuration of the grid."""

    algorithm: str
    reward: str
    representation: str
    n_bins: int

    @property
    def name(self) -> str:
        """A name that can be a Kedro namespace."""
        return f"{self.algorithm}_{self.reward}_{self.representation}_{self.n_bins}".lower()


CELLS: tuple[Cell, ...] = tuple(
    Cell(*values) for values in product(ALGORITHMS, REWARDS, REPRESENTATIONS, BIN_COUNTS)
)
"""{PPO, A2C} x {Reach Target Fast, Maximize Reward} x 4 representations x {10, 20, 40} bins."""


def train_cell(
    training: pd.DataFrame,
    cell: Cell,
    *,
    target: str,
    seed: int,
    total_steps: int | None = None,
    representation: Representation | None = None,
) -> dict[str, Any]:
    """Train the agent of one cell.

    Parameters
    ----------
    training : DataFrame
        Tire table at one nominal load.
    cell : Cell
    target : str
    seed : int
    total_steps : int, optional
        ``training.TOTAL_STEPS`` if not given.
    representation : Representation, optional
        Of the cell's name and fitted on ``training``, so that an autoencoder is trained once for all
        its cells, or another form is used; fitted here if not given.

    Returns
    -------
    dict
        ``state`` (of the translator, see ``state_files``), ``learning_curve`` (DataFrame: ``step``,
        ``reward``, ``length``), ``seconds``.
    """
    start = time.perf_counter()
    translator = AgentTranslator(
        algorithm=cell.algorithm,
        reward=cell.reward,
        representation=cell.representation if representation is None else representation,
        n_bins=cell.n_bins,
        total_steps=total_steps,
    ).fit(training, target=target, seed=seed)
    return {
        "state": translator.to_state(),
        "learning_curve": translator.learning_curve,
        "seconds": time.perf_counter() - start,
    }


def judge_cell(
    state: Mapping[str, Any], sources: pd.DataFrame, reference: pd.DataFrame
) -> dict[str, pd.DataFrame]:
    """Translate tires with a trained cell and compare with what the target measured.

    Parameters
    ----------
    state : mapping
        From :func:`train_cell`.
    sources, reference : DataFrame
        Row by row the same physical tire: as another category measured it, and as the target did.

    Returns
    -------
    dict
        ``metrics``: rows ``decoding`` (``tire``: decoded to coefficients; ``curves``: the thesis'
        own decoded curves), ``metric``, ``ratio`` (Tables 5.10 to 5.15), ``improved`` (5.16 to
        5.21), ``worst``, ``files``. ``actions``: ``action``, ``count`` (Figure 5.16). ``tires``: index of
        ``sources``, ``before``, ``after`` (probability of the target), ``reached``.
    """
    from tire_pipeline.evaluation.curves import EvaluationGrid, curves_of
    from tire_pipeline.evaluation.translations import evaluate_translations

    translator = AgentTranslator.from_state(state)
    path = translator.follow(sources)
    as_tires = evaluate_translations(translator.translate(sources), sources, reference, lateral_only=True)
    grid = EvaluationGrid(load_axis=CURVE_LOADS)
    as_curves = evaluate_translations(
        _curves(translator.translate_curves(sources), curves_of(sources, grid, lateral_only=True)),
        curves_of(sources, grid, lateral_only=True),
        curves_of(reference, grid, lateral_only=True),
    )
    metrics = [
        result.summary.rename_axis("metric").reset_index().assign(decoding=name)
        for name, result in (("tire", as_tires), ("curves", as_curves))
    ]
    return {
        "metrics": pd.concat(metrics, ignore_index=True),
        "actions": pd.DataFrame({"action": translator.action_names, "count": path.action_counts}),
        "tires": pd.DataFrame(
            {"before": path.start_valuations, "after": path.valuations, "reached": path.reached},
            index=sources.index,
        ),
    }


def _curves(force: np.ndarray, instead: Any) -> Any:
    """Decoded forces (n, 3, 100) with slope at the origin and peak friction at the same loads.

    A tire without a real solution stands for itself, untranslated.
    """
    finite = np.isfinite(force).all(axis=(1, 2))[:, None]
    # the two middle slip angles lie on both sides of the origin
    right = len(CURVE_SLIP_ANGLES) // 2
    width = CURVE_SLIP_ANGLES[right] - CURVE_SLIP_ANGLES[right - 1]
    slope = np.abs(force[..., right] - force[..., right - 1]) / width
    friction = np.abs(force).max(axis=2) / CURVE_LOADS
    return type(instead)(
        fy=np.where(finite[..., None], force, instead.fy),
        cornering_stiffness=np.where(finite, slope, instead.cornering_stiffness),
        peak_friction=np.where(finite, friction, instead.peak_friction),
    )
