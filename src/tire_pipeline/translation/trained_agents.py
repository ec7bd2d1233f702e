"""Train the thesis' agent on bins, rewarded by the forest, and ours on curves, rewarded by a density."""

from __future__ import annotations

from functools import partial
from typing import Any

import pandas as pd

from tire_pipeline.classifiers.methods.random_forest import RandomForest
from tire_pipeline.representations import representation_from_state
from tire_pipeline.tasks import Map, Task, all_done, in_turn
from tire_pipeline.tire_table import Binning
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.translation.base import make_translator
from tire_pipeline.translation.parameters import TrainAgentParameters
from tire_pipeline.translation.thesis.translator import AgentTranslator


def train_agents(
    normalized_table: pd.DataFrame,
    representation: dict[str, Any],
    binning: dict[str, Any],
    classifier: dict[str, Any],
    parameters: TrainAgentParameters,
    normalize: NormalizeParameters,
    target_category: str,
    seed: int,
    *,
    work: Map = in_turn,
) -> tuple[dict[str, Any], pd.DataFrame, dict[str, Any]]:
    """Train the thesis' agent and ours. Neither needs the other, so they may be trained at the same time.

    Parameters
    ----------
    normalized_table, representation, binning, classifier, parameters, target_category, seed
        As for :func:`train_one_agent`.
    normalize : NormalizeParameters
        As for :func:`train_our_agent`.
    work : Map
        Does the trainings.

    Returns
    -------
    agent, learning_curve
        As :func:`train_one_agent` gives them.
    our_agent : dict
        As :func:`train_our_agent` gives it.
    """
    thesis = partial(
        train_one_agent,
        normalized_table,
        representation,
        binning,
        classifier,
        parameters,
        target_category,
        seed,
    )
    ours = partial(train_our_agent, normalized_table, parameters, normalize, target_category, seed)
    tasks: dict[str, Task[Any]] = {"the thesis' agent": thesis, "our agent": ours}
    done = all_done(work, tasks, "training both agents")
    agent, learning_curve = done["the thesis' agent"].result()
    return agent, learning_curve, done["our agent"].result()


def train_one_agent(
    normalized_table: pd.DataFrame,
    representation: dict[str, Any],
    binning: dict[str, Any],
    classifier: dict[str, Any],
    parameters: TrainAgentParameters,
    target_category: str,
    seed: int,
) -> tuple[dict[str, Any], pd.DataFrame]:
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
    return translator.to_state(), translator.learning_curve


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
    agent = make_translator("likelihood_agent", updates=parameters.likelihood_updates)
    agent.fit(normalized_table, target=target_category, seed=seed)
    return {**agent.to_state(), "nominal_load": normalize.nominal_load}
