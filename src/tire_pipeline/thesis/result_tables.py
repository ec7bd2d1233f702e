"""All results of ``reproduce_thesis`` as tables by name, and the few ways in which they are summed up."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import pandas as pd

from tire_pipeline.classifiers.score_on_splits import SPLIT_WORDS
from tire_pipeline.thesis.published import published_agents

CELL = ["algorithm", "reward", "representation", "n_bins"]
THESIS_ORDER = ("coefficients", "latent", "power_series", "key_attributes")
WORDS = {
    "coefficients": "MF coefficients",
    "latent": "latent",
    "power_series": "power series",
    "key_attributes": "key attributes",
    "power_series_stable": "power series, stable form",
    "reach_target_fast": "Reach Target Fast",
    "maximize_reward": "Maximize Reward",
    **SPLIT_WORDS,
    "ann": "ANN",
    "naive_bayes": "GNB",
    "random_forest": "RF",
    "gradient_boosting": "gradient boosting",
    "calibrated": "calibrated RF",
    "forces": "forces",
    "cornering_stiffness": "cornering stiffness",
    "peak_friction": "peak friction",
    "mean": "average",
}
"""What the page calls things."""

BETTER = 0.9995
"""A ratio counts as better than doing nothing below this: what is printed as 1 does not."""


@dataclass(frozen=True)
class Results:
    """What the experiments gave.

    Attributes
    ----------
    frames : mapping of str to DataFrame
        ``class_counts, ann_random, ann_grid, forest_trees, forest_depth, scores, per_class, confusion,
        reliability, calibration, bins, latent, condition, floor`` and of the agents ``agents, actions,
        agent_tires, learning, seconds, force_curves, load_curves``; columns as in
        ``classifier_experiments`` and ``agents``.
    facts : mapping
        ``target, files, seeds, trainings, further_trainings, sets``.
    drawings : dict
        Figures that have been drawn, by file name: the page and the files show the same ones.
    """

    frames: Mapping[str, pd.DataFrame]
    facts: Mapping[str, Any]
    drawings: dict[str, Any] = field(default_factory=dict, repr=False, compare=False)

    def __getitem__(self, name: str) -> pd.DataFrame:
        return self.frames[name]

    @cached_property
    def beside(self) -> pd.DataFrame:
        """Tables 5.10 to 5.21: the thesis' value and ours, one row a cell, metric and quantity.

        Columns: ``table, quantity``, the cell, ``metric, thesis, curves, curves_std, tire, tire_std,
        hidden, hidden_std`` - on the set ``four`` with the thesis' own decoded curves and with the decoded
        ``.tir``; on ``hidden`` with the decoded ``.tir``. Means and standard deviations over the seeds;
        NaN where a cell was not run.
        """
        ours = over_seeds(self["agents"])
        first = self.facts["sets"][0]
        out = published_agents().rename(columns={"value": "thesis"})
        for name, of_set, decoding in (
            ("curves", first, "curves"),
            ("tire", first, "tire"),
            ("hidden", "hidden", "tire"),
        ):
            part = ours[(ours["set"] == of_set) & (ours["decoding"] == decoding)]
            part = part.rename(columns={"value": name, "std": f"{name}_std"})
            keys = [*CELL, "metric", "quantity"]
            out = out.merge(part[[*keys, name, f"{name}_std"]], on=keys, how="left")
        return out

    @property
    def cells_run(self) -> int:
        """How many cells of the grid there are results for."""
        return len(self["agents"][CELL].drop_duplicates())


def over_seeds(agents: pd.DataFrame) -> pd.DataFrame:
    """Return mean and standard deviation over the seeds.

    Parameters
    ----------
    agents : DataFrame
        From ``judged_agent``, all cells and seeds.

    Returns
    -------
    DataFrame
        ``set, decoding``, the cell, ``metric, quantity`` (ratio or improved), ``value, std, seeds``.
    """
    keys = ["set", "decoding", *CELL, "metric"]
    long = agents.melt([*keys, "seed"], ["ratio", "improved"], var_name="quantity", value_name="value")
    grouped = long.groupby([*keys, "quantity"], sort=False)["value"]
    out = grouped.agg(["mean", "std", "count"]).reset_index()
    out["std"] = out["std"].where(out["count"] > 1)
    return out.rename(columns={"mean": "value", "count": "seeds"})


def over_trainings(scores: pd.DataFrame, columns: Sequence[str] = ("accuracy", "f1")) -> pd.DataFrame:
    """Return mean and spread over the trainings of each classifier, split and use of SMOTE."""
    grouped = scores.groupby(["split", "classifier", "smote"], sort=False)
    means = grouped[list(columns)].mean()
    for name in columns:
        means[f"{name}_std"] = grouped[name].std(ddof=0)
    means["trainings"] = grouped.size()
    return means.reset_index()


def in_words(name: Any) -> str:
    """What the page calls it."""
    return WORDS.get(str(name), str(name))
