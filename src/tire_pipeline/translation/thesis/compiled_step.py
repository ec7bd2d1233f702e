"""The step of :class:`TranslationEnv` for many tires in one compiled call."""

from __future__ import annotations

import numpy as np
from numba import njit

from tire_pipeline.classifiers.methods.compiled_forest import add_leaves
from tire_pipeline.translation.thesis.rules import OUT_OF_BOUNDS, REACHED, STEP


@njit(cache=True, nogil=True)
def is_real(state, rules):
    """Tell whether one state has a real solution."""
    features = rules.real_features
    for group in range(features.shape[0]):
        a, b, c = state[features[group, 0]], state[features[group, 1]], state[features[group, 2]]
        if not rules.real_lookup[group, a, b, c]:
            return False
    return True


@njit(cache=True, nogil=True)
def move(state, action, best, row, sums, rules, forest):
    """Move one tire, and give its reward, what its valuation gained, and whether the target is reached.

    Parameters
    ----------
    state : int64, shape (d,)
        Written.
    action : int
    best : float
        Highest valuation seen.
    row : float32, shape (1, d); sums : float64, shape (1, classes)
        Written: what the forest reads and adds to.
    rules : RulesForCompiledCode
    forest : ForestArrays
    """
    moved = action // 2
    wanted = state[moved] + (1 if action % 2 == 1 else -1)
    if wanted < 0 or wanted >= rules.n_bins:
        return OUT_OF_BOUNDS, 0.0, False
    state[moved] = wanted
    if not is_real(state, rules):
        return STEP, 0.0, False
    for k in range(state.shape[0]):
        row[0, k] = state[k]
    sums[:] = 0.0
    add_leaves(row, forest, sums)
    return STEP, sums[0, rules.target] - best, np.argmax(sums[0]) == rules.target


@njit(cache=True, nogil=True)
def advance(actions, states, best, without_improvement, steps, rewards, ended, cut, frozen, rules, forest):
    """Move N tires by one action each; every array but the rules and the forest is written.

    Parameters
    ----------
    actions : int64, shape (N,)
    states : int64, shape (N, d)
    best : float64, shape (N,)
        Highest valuation seen; with the reward *Reach Target Fast* too, for the roll-out's use.
    without_improvement, steps : int64, shape (N,)
    rewards : float64, shape (N,)
    ended, cut : bool, shape (N,)
        Episode over by the rules, or by ``max_steps``.
    frozen : bool, shape (N,)
        Tires that do not move.
    rules : RulesForCompiledCode
    forest : ForestArrays
    """
    row = np.empty((1, states.shape[1]), dtype=np.float32)
    sums = np.empty((1, forest.value.shape[1]))
    for i in range(states.shape[0]):
        ended[i] = False
        cut[i] = False
        rewards[i] = 0.0
        if frozen[i]:
            continue
        rewards[i], gained, reached = move(states[i], actions[i], best[i], row, sums, rules, forest)
        if gained > 0:
            best[i] += gained
            without_improvement[i] = 0
        else:
            without_improvement[i] += 1
        if rules.maximize:
            if gained > 0:
                rewards[i] = STEP + gained
            ended[i] = without_improvement[i] >= rules.patience
        elif reached:
            rewards[i] = REACHED
            ended[i] = True
        steps[i] += 1
        cut[i] = steps[i] >= rules.max_steps and not ended[i]
