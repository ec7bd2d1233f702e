"""Greedy roll-out of a trained policy: where a tire ends up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tire_pipeline.classifiers.methods.compiled_forest import CompiledForest
from tire_pipeline.translation.thesis.policy import GreedyPolicy
from tire_pipeline.translation.thesis.rules import Rules


@dataclass(frozen=True)
class RollOut:
    """Where m tires ended up.

    Attributes
    ----------
    states : ndarray of int, shape (m, d)
    valuations : ndarray, shape (m,)
        The classifier's probability of the target there.
    start_valuations : ndarray, shape (m,)
        And at the start.
    reached : ndarray of bool, shape (m,)
        The target is the most probable category there.
    action_counts : ndarray of int, shape (2 d,)
        How often each action was taken, over all tires (Figure 5.16).
    """

    states: np.ndarray
    valuations: np.ndarray
    start_valuations: np.ndarray
    reached: np.ndarray
    action_counts: np.ndarray


def roll_out(policy: GreedyPolicy, starts: np.ndarray, forest: CompiledForest, rules: Rules) -> RollOut:
    """Follow the most probable actions until the episode ends; keep the best state seen.

    With *Reach Target Fast* a tire stops as soon as the target is its most probable category; one
    that is there already does not move. With *Maximize Reward* it goes on until five steps bring
    nothing. Either way the state kept is the one with the target's highest probability on the way,
    the start included: in the thesis PPO and A2C give the same results with *Maximize Reward*,
    which only the best state, not the last one, explains.

    Parameters
    ----------
    policy : GreedyPolicy
    starts : ndarray of int, shape (m, d)
    forest : CompiledForest
    rules : Rules
    """
    from tire_pipeline.translation.thesis.compiled_step import advance

    m = len(starts)
    states = np.ascontiguousarray(starts, dtype=np.int64).copy()
    compiled_rules, trees = rules.for_compiled_code(), forest.arrays()
    maximize = compiled_rules.maximize
    probabilities = forest.sums(states)
    real = np.array([rules.is_real(state) for state in states], dtype=bool)
    start_valuations = np.where(real, probabilities[:, rules.target], 0.0)
    best = start_valuations.copy()
    best_states = states.copy()
    reached = real & (probabilities.argmax(axis=1) == rules.target)
    frozen = np.zeros(m, dtype=np.bool_) if maximize else reached.copy()
    without, steps = np.zeros(m, dtype=np.int64), np.zeros(m, dtype=np.int64)
    rewards = np.empty(m)
    ended, cut = np.empty(m, dtype=np.bool_), np.empty(m, dtype=np.bool_)
    counts = np.zeros(rules.n_actions, dtype=np.int64)
    while not frozen.all():
        actions = policy.actions(states).astype(np.int64)
        counts += np.bincount(actions[~frozen], minlength=rules.n_actions)
        before = best.copy()
        advance(actions, states, best, without, steps, rewards, ended, cut, frozen, compiled_rules, trees)
        keep = best > before
        if not maximize:
            keep |= ended
        best_states[keep] = states[keep]
        frozen |= ended | cut
    at_end = forest.sums(best_states)
    return RollOut(
        states=best_states,
        valuations=at_end[:, rules.target],
        start_valuations=start_valuations,
        reached=at_end.argmax(axis=1) == rules.target,
        action_counts=counts,
    )
