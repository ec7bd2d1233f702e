"""Train the thesis' agent on bins, rewarded by the forest, and ours on curves, rewarded by a density."""

from __future__ import annotations

from typing import Any, Literal

import pandas as pd
from matplotlib.figure import Figure
from pydantic import Field

from tire_pipeline.classifiers.random_forest import RandomForest
from tire_pipeline.pipelines.normalize.nodes import NormalizeParameters
from tire_pipeline.pipelines.parameters import Parameters
from tire_pipeline.reporting import colour_of, new_figure
from tire_pipeline.representations import representation_from_state
from tire_pipeline.tire_table import Binning
from tire_pipeline.translation.learned import LikelihoodAgent
from tire_pipeline.translation.predict.policy import UPDATES
from tire_pipeline.translation.thesis.translator import AgentTranslator


class TrainAgentParameters(Parameters):
    """Parameters of ``train_agent``.

    Attributes
    ----------
    algorithm : {"PPO", "A2C"}
    reward : {"reach_target_fast", "maximize_reward"}
    environments, rollout_steps : int
        Environments side by side, and their steps between two updates (thesis, Tables 2.3 and 2.4).
    total_steps : int
        Of all environments together.
    likelihood_updates : int
        Updates of our agent's policy.
    """

    algorithm: Literal["PPO", "A2C"] = "PPO"
    reward: Literal["reach_target_fast", "maximize_reward"] = "reach_target_fast"
    environments: int = Field(4, ge=1, le=256)
    rollout_steps: int = Field(320, ge=2)
    total_steps: int = Field(100_000, ge=1)
    likelihood_updates: int = Field(UPDATES, ge=1)


def train_one_agent(
    normalized_table: pd.DataFrame,
    representation: dict[str, Any],
    binning: dict[str, Any],
    classifier: dict[str, Any],
    parameters: TrainAgentParameters,
    target_category: str,
    seed: int,
) -> tuple[dict[str, Any], pd.DataFrame, Figure]:
    """Train an agent that moves a tire's bins until the forest calls it the target's.

    Parameters
    ----------
    normalized_table : DataFrame
        Tires that episodes start from.
    representation, binning, classifier : dict
        States of the fitted parts.
    parameters : TrainAgentParameters
    target_category : str
    seed : int

    Returns
    -------
    agent : dict
        State of the translator: policy, forest, bins, representation.
    learning_curve : DataFrame
        One row an episode: ``step, reward, length``.
    learning_figure : Figure
    """
    translator = AgentTranslator(
        algorithm=parameters.algorithm,
        reward=parameters.reward,
        representation=representation_from_state(representation),
        bins=Binning.from_state(binning),
        total_steps=parameters.total_steps,
        n_steps=parameters.rollout_steps,
        n_envs=parameters.environments,
    ).fit(normalized_table, target=target_category, seed=seed, classifier=RandomForest.from_state(classifier))
    return translator.to_state(), translator.learning_curve, learning_figure(translator.learning_curve)


def train_our_agent(
    normalized_table: pd.DataFrame,
    parameters: TrainAgentParameters,
    normalize: NormalizeParameters,
    target_category: str,
    seed: int,
) -> dict[str, Any]:
    """Train an agent that moves a tire's curves to where the target's tires of its kind are probable.

    Parameters
    ----------
    normalized_table : DataFrame
        Tires that it learns from.
    parameters : TrainAgentParameters
    normalize : NormalizeParameters
    target_category : str
    seed : int

    Returns
    -------
    dict
        State of the translator: densities and policy, and ``nominal_load`` (N).
    """
    agent = LikelihoodAgent(updates=parameters.likelihood_updates)
    agent.fit(normalized_table, target=target_category, seed=seed)
    return {**agent.to_state(), "nominal_load": normalize.nominal_load}


def learning_figure(curve: pd.DataFrame) -> Figure:
    """Mean episode reward over training steps (thesis, Figure 5.9)."""
    figure, axes = new_figure()
    window = max(1, len(curve) // 100)
    smooth = curve["reward"].rolling(window, min_periods=1).mean()
    axes.plot(curve["step"], smooth, color=colour_of(0))
    axes.set_xlabel("training steps of all environments")
    axes.set_ylabel(f"episode reward\n(mean of {window} episodes)")
    return figure
