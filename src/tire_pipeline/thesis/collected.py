"""Nodes that put all results together: one set of tables, the files, the page."""

from __future__ import annotations

from typing import Any

import pandas as pd

from tire_pipeline.files.read_later import StoredFiles
from tire_pipeline.thesis.experiments.experiment_files import together
from tire_pipeline.thesis.pages.whole_page import thesis_page
from tire_pipeline.thesis.parameters import ReproduceThesisParameters
from tire_pipeline.thesis.result_files import result_files
from tire_pipeline.thesis.result_tables import Results

#: Order of the experiments among the inputs of ``collect``.
EXPERIMENTS = (
    "class_counts",
    "ann_random",
    "ann_grid",
    "forest",
    "classifiers",
    "bins",
    "latent",
    "condition",
)


def collect(
    floor: pd.DataFrame,
    splits: pd.DataFrame,
    parameters: ReproduceThesisParameters,
    target_category: str,
    *folders: StoredFiles,
) -> Results:
    """Put the parts of all experiments and of all cells together.

    Parameters
    ----------
    floor : DataFrame
        From ``judge_floor``.
    splits : DataFrame
    parameters : ReproduceThesisParameters
    target_category : str
    *folders : mapping
        Those of ``EXPERIMENTS`` in this order, then one a cell.
    """
    frames: dict[str, pd.DataFrame] = {"floor": floor}
    for name, folder in zip(EXPERIMENTS, folders, strict=False):
        found = together(folder)
        frames |= {name: found["ann"]} if "ann" in found else found
    agents: dict[str, list[pd.DataFrame]] = {}
    for folder in folders[len(EXPERIMENTS) :]:
        for name, frame in together(folder).items():
            agents.setdefault(name, []).append(frame)
    frames |= {name: pd.concat(parts, ignore_index=True) for name, parts in agents.items()}
    facts: dict[str, Any] = {
        "target": target_category,
        "files": len(splits),
        "seeds": list(parameters.agents.seeds),
        "trainings": parameters.trainings,
        "further_trainings": parameters.further_trainings,
        "sets": list(parameters.sets),
    }
    return Results(frames, facts)


def write_tables(results: Results) -> dict[str, str]:
    """Every curve and table as data (CSV) and figure (SVG)."""
    return result_files(results)


def build_page(results: Results) -> str:
    """The thesis and our results side by side, on one page."""
    return thesis_page(results)
