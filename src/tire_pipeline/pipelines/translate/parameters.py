"""Parameters of ``translate``."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from tire_pipeline.pipelines.parameters import Parameters, Several
from tire_pipeline.translation.result import EDGE
from tire_pipeline.translation.translator import FARTHEST


class TranslateParameters(Parameters):
    """Parameters of ``translate``.

    Attributes
    ----------
    translator : str
        Which of those that give bands and verdicts. The ``batch`` ones learn from the files to translate as
        well.
    pairs : bool
        Whether to use tires measured by more than one organisation.
    classify : bool
        Classify files whose folder is no known category. Otherwise, and where the classification is not
        sure, their supplier is unknown, and they are not translated.
    farthest : float
        Files farther from the training data are refused. 1 is the edge of the training data; more than 3 is
        not allowed.
    only : list of str
        Suppliers, files or patterns such as ``B/*_2019*.tir``; empty is all files. On the command line
        several are separated by ``;``.
    trials : int
        Most files that are translated; 0 is all.
    """

    translator: Literal[
        "mixed_model",
        "paired_mixed_model",
        "batch_mixed_model",
        "paired_batch_mixed_model",
        "likelihood_agent",
    ] = "paired_mixed_model"
    pairs: bool = True
    classify: bool = False
    farthest: float = Field(EDGE, gt=0, le=FARTHEST)
    only: Several = []
    trials: int = Field(0, ge=0)
