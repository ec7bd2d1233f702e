"""What users may set of the demonstration fleet."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

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
