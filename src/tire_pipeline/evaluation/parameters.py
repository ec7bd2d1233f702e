"""Parameters of ``evaluate``."""

from __future__ import annotations

from pydantic import Field

from tire_pipeline.parameters import Parameters


class EvaluateParameters(Parameters):
    """Parameters of ``evaluate``.

    Attributes
    ----------
    sets : list of str
        Sub-folders of the evaluation folder that are translated and judged.
    tires_to_choose_by : int
        Tires of the tuning set that tell which translator's files are written. They are judged nowhere else.
    most_files_without_evaluation : int
        Where there are no evaluation tires: translate this many of the user's files, of tires that the
        classifier was not trained on. They cannot be judged, and the report says so.
    """

    sets: list[str] = Field(["four", "hidden"], min_length=1)
    tires_to_choose_by: int = Field(25, ge=1)
    most_files_without_evaluation: int = Field(100, ge=1)
