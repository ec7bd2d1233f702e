"""The 48 agents of the thesis' Table 4.4, cell by cell."""

from __future__ import annotations

import time
from dataclasses import dataclass
from itertools import product
from typing import Any

import pandas as pd

from tire_pipeline.representations.base import (
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
