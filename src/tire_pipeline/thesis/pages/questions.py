"""The thesis' four research questions, answered from our numbers. Rules come first, then the numbers."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.reporting import Text
from tire_pipeline.thesis.pages.page_agents import rising
from tire_pipeline.thesis.pages.words import action_in_words, listed, rank_agreement
from tire_pipeline.thesis.result_tables import BETTER, CELL, Results, in_words, over_seeds, over_trainings

QUESTIONS = (
    "RQ1: Can supervised learning be used to classify tire property files?",
    "RQ2: Can a deep RL agent learn a policy that optimizes the output probabilities of a classifier?",
    "RQ3: Can RL or other ML techniques be used to translate biased tire models into unbiased models?",
    "RQ4: What learnings about the data can be made from the RL policies?",
)


def answers(results: Results) -> list[Text]:
    """Return each question with its answer."""
    given = (_classify(results), _learn(results), _translate(results), _policies(results))
    return [Text(lines, heading=question) for question, lines in zip(QUESTIONS, given, strict=True)]


def _classify(results: Results) -> list[str]:
    means = over_trainings(results["scores"])
    counts = results["class_counts"]
    share = counts["all"].max() / counts.loc[counts["split"] == "random", "all"].sum()
    best = means.loc[means.groupby("split")["accuracy"].idxmax()].set_index("split")
    known, new = best.loc["random"], best.loc["by_tire"]
    yes = new["accuracy"] - 3 * max(new["accuracy_std"], 0.01) > share
    return [
        f"{'Yes' if yes else 'Not on new tires'}: the best classifier is right for {known['accuracy']:.1%} "
        f"of the test files on the random split ({in_words(known['classifier'])}), and for "
        f"{new['accuracy']:.1%} on tires that training has not seen ({in_words(new['classifier'])}). Always "
        f"naming the largest category would be right for {share:.1%}.",
        f"The thesis' 97.0% comes from a random split, where variants of one tire are on both sides. On our "
        f"files this alone adds {(known['accuracy'] - new['accuracy']) * 100:.1f} percentage points.",
    ]


def _learn(results: Results) -> list[str]:
    ends, tires = rising(results), results["agent_tires"]
    up = int((ends["late"] > ends["early"]).sum())
    by_reward = tires.groupby("reward")[["before", "after", "reached"]].mean()
    lines = [answer_on_learning(up, len(ends), tires["before"].mean(), tires["after"].mean())]
    lines += [
        f"{in_words(reward)}: from {row['before']:.2f} to {row['after']:.2f}; the target becomes the most "
        f"probable category for {row['reached']:.0%} of the tires."
        for reward, row in by_reward.iterrows()
    ]
    return lines


def answer_on_learning(rising_cells: int, cells: int, before: float, after: float) -> str:
    """Answer whether agents learn to convince the classifier.

    Parameters
    ----------
    rising_cells, cells : int
        Cells in which the reward rises during training, and all cells.
    before, after : float
        Mean probability of the target over the evaluation tires, before and after translation.

    Returns
    -------
    str
        Yes, if the reward rises in nearly all cells and the probability rises, too; no, if neither does.

    Examples
    --------
    >>> answer_on_learning(0, 2, 0.16, 0.21)  # doctest: +NORMALIZE_WHITESPACE
    "Only in part: training raises the reward in 0 of 2 cells, but the agents' translations raise the
    classifier's mean probability of the target from 0.16 to 0.21 over all evaluation tires."
    """
    learns, moves = rising_cells > 0.9 * cells, round(after, 2) > round(before, 2)
    verdict = "Yes" if learns and moves else "Only in part" if rising_cells or moves else "No"
    change = f"from {before:.2f} to {after:.2f}" if round(after, 2) != round(before, 2) else f"at {after:.2f}"
    verb = "raise" if moves else "leave" if change.startswith("at") else "lower"
    return (
        f"{verdict}: training raises the reward in {rising_cells} of {cells} cells, "
        f"{'and' if learns == moves else 'but'} the agents' translations {verb} the classifier's mean "
        f"probability of the target {change} over all evaluation tires."
    )


def _translate(results: Results) -> list[str]:
    ours = over_seeds(results["agents"])
    ratios = ours[(ours["quantity"] == "ratio") & (ours["decoding"] == "tire")]
    lines = []
    for name in dict.fromkeys(ratios["set"]):
        wide = ratios[ratios["set"] == name].pivot(index=CELL, columns="metric", values="value")
        single = wide[["forces", "cornering_stiffness", "peak_friction"]]
        all_three = int((single < BETTER).all(axis=1).sum())
        some = int((single < BETTER).any(axis=1).sum())
        best = wide["mean"].idxmin()
        which = f"{best[0]}, {in_words(best[1])}, {in_words(best[2])}, {best[3]} bins"
        floor = results["floor"]
        own = floor[(floor["set"] == name) & (floor["metric"] == "mean")]["ratio"].iloc[0]
        lines.append(
            f"Set {name}: {some} of {len(wide)} configurations beat doing nothing on some metric (2 of 48 in "
            f"the thesis), {all_three} on all three (none in the thesis). The best average is "
            f"{wide['mean'].min():.2f} ({which}); the target measuring again reaches "
            f"{own:.2f}."
        )
    last = ratios[ratios["set"] == list(dict.fromkeys(ratios["set"]))[-1]]
    none = last.pivot(index=CELL, columns="metric", values="value")["mean"].min() >= BETTER
    verdict = (
        f"{'Not' if none else 'In part'} by the thesis' agents: {'none is' if none else 'some are'} better "
        "than doing nothing on average over the larger set."
    )
    return [
        verdict,
        *lines,
        "This page is about the thesis' agents only. The pages linked above judge the other translators.",
    ]


def _policies(results: Results) -> list[str]:
    actions, ours = results["actions"], over_seeds(results["agents"])
    shares = actions.groupby([*CELL, "action"])["count"].sum()
    totals = shares.groupby(CELL).transform("sum").clip(lower=1)
    part = (shares / totals).rename("share").reset_index()
    spread = part.groupby(CELL)["share"].agg(_evenness).rename("evenness")
    ratio = ours[(ours["metric"] == "mean") & (ours["quantity"] == "ratio") & (ours["decoding"] == "curves")]
    ratio = ratio[ratio["set"] == results.facts["sets"][0]].set_index(CELL)["value"]
    both = pd.concat([spread, ratio], axis=1).dropna()
    rank = rank_agreement(both["evenness"].to_list(), both["value"].to_list())
    if np.isnan(rank):
        first = (
            "Too few configurations were run to say whether agents whose actions are spread evenly do worse."
        )
    else:
        agrees = "as the thesis supposes" if rank > 0.3 else "which does not confirm it"
        first = (
            "The thesis supposes that agents whose actions are spread evenly do worse. Over our "
            f"{len(both)} cells the rank correlation of evenness and average error is {rank:.2f}, "
            f"{agrees}."
        )
    lines = [first]
    for name in ("coefficients", "key_attributes"):
        own = part[part["representation"] == name].groupby("action")["share"].mean()
        if own.sum() > 0:
            top = own.sort_values(ascending=False).head(4)
            words = listed(f"{action_in_words(action)} ({share:.0%})" for action, share in top.items())
            lines.append(f"Most frequent actions with {in_words(name)}, mean of all agents: {words}.")
    lines.append(
        "If a step up is frequent, the classifier takes larger values as a sign of "
        f"{results.facts['target']}. This is a difference between the categories, not yet a correction that "
        "makes the forces right."
    )
    return lines


def _evenness(shares: pd.Series) -> float:
    """Entropy over that of an even distribution: 0 for one action only, 1 for all alike."""
    used = shares[shares > 0]
    if len(shares) < 2 or used.empty:
        return float("nan")
    return float(-(used * np.log(used)).sum() / np.log(len(shares)))
