"""The step of :class:`TranslationEnv` for many tires in one compiled call."""

from __future__ import annotations

import numpy as np
from numba import njit

from tire_pipeline.classifiers.methods.compiled_forest import add_leaves
from tire_pipeline.translation.thesis.rules import OUT_OF_BOUNDS, REACHED, STEP


@njit(cache=True, nogil=True)
def is_real(state, real_features, real_lookup):  # type: ignore[no-untyped-def]
    """Tell whether one state has a real solution."""
    for group in range(real_features.shape[0]):
        a = state[real_features[group, 0]]
        b = state[real_features[group, 1]]
        c = state[real_features[group, 2]]
        if not real_lookup[group, a, b, c]:
            return False
    return True


@njit(cache=True, nogil=True)
def advance(  # type: ignore[no-untyped-def]
    actions,
    states,
    best,
    without_improvement,
    steps,
    rewards,
    ended,
    cut,
    frozen,
    maximize,
    n_bins,
    target,
    patience,
    max_steps,
    real_features,
    real_lookup,
    feature,
    threshold,
    left,
    right,
    value,
    roots,
):
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
    maximize : bool
        *Maximize Reward*, else *Reach Target Fast*.
    n_bins, target, patience, max_steps, real_features, real_lookup
        See ``Rules``.
    feature, threshold, left, right, value, roots
        See ``CompiledForest``.
    """
    d = states.shape[1]
    classes = value.shape[1]
    row = np.empty((1, d), dtype=np.float32)
    sums = np.empty((1, classes))
    for i in range(states.shape[0]):
        ended[i] = False
        cut[i] = False
        rewards[i] = 0.0
        if frozen[i]:
            continue
        moved = actions[i] // 2
        wanted = states[i, moved] + (1 if actions[i] % 2 == 1 else -1)
        gained = 0.0
        reached = False
        rewards[i] = STEP
        if wanted < 0 or wanted >= n_bins:
            rewards[i] = OUT_OF_BOUNDS
        else:
            states[i, moved] = wanted
            if is_real(states[i], real_features, real_lookup):
                for k in range(d):
                    row[0, k] = states[i, k]
                sums[:] = 0.0
                add_leaves(row, feature, threshold, left, right, value, roots, sums)
                gained = sums[0, target] - best[i]
                reached = np.argmax(sums[0]) == target
        if gained > 0:
            best[i] += gained
            without_improvement[i] = 0
        else:
            without_improvement[i] += 1
        if maximize:
            if gained > 0:
                rewards[i] = STEP + gained
            ended[i] = without_improvement[i] >= patience
        elif reached:
            rewards[i] = REACHED
            ended[i] = True
        steps[i] += 1
        cut[i] = steps[i] >= max_steps and not ended[i]
