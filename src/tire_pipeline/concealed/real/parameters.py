"""Parameters of the half of the proof that is made from real recordings."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from tire_pipeline.parameters import Parameters


class RealParameters(Parameters):
    """Parameters of the half from real recordings.

    Attributes
    ----------
    cases : int
    seed : int
        Of the published proof; used once, after all thresholds were fixed on development sweeps.
    recordings : str
        Folder with ``calspan``, ``dart`` and ``tydex``. Without it the published table is shown.
    baselines : tuple of str
        What else is tried on the same cases.
    """

    cases: int = Field(default=420, ge=1)
    seed: int = Field(default=20261231, ge=10_000)
    recordings: str = "../shared/recordings"
    baselines: tuple[Literal["bic_stepwise", "pysindy", "gaussian_process", "refitted_formula"], ...] = (
        "bic_stepwise",
        "pysindy",
        "gaussian_process",
        "refitted_formula",
    )
