"""Make the demonstration fleet as texts."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from tire_pipeline.fleet import FleetSettings, make_fleet
from tire_pipeline.fleet.write import encoded, truth_files
from tire_pipeline.parameters import Parameters


class FleetParameters(Parameters):
    """Parameters of ``make_fleet``; :class:`tire_pipeline.fleet.FleetSettings` says what each means."""

    files: int = Field(3648, ge=330)
    bias_size: float = Field(1.0, ge=0.0, le=1.5)
    kind: Literal["additive", "interacting", "drifting"] = "additive"
    compound_in_metadata: bool = False
    paired_tires: int = Field(8, ge=0, le=12)
    hidden_tires: int = Field(100, ge=1)
    tuning_tires: int = Field(100, ge=1)


def build_fleet(
    parameters: FleetParameters, target_category: str, seed: int
) -> tuple[dict[str, bytes], dict[str, bytes], dict[str, bytes]]:
    """Make every file of the fleet.

    Parameters
    ----------
    parameters : FleetParameters
    target_category : str
        Its measurements of the evaluation tires are sealed.
    seed : int

    Returns
    -------
    truth, evaluation, files : dict of str to bytes
        By relative path. The training files come last: until they are there, the fleet counts as not made.
    """
    settings = FleetSettings(target=target_category, seed=seed, **parameters.model_dump())
    fleet = make_fleet(settings)
    return truth_files(fleet), encoded(fleet.evaluation), encoded(fleet.files)
