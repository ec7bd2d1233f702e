"""What else is tried on the same cases: plain BIC stepwise, PySINDy, a Gaussian process, a refit."""

from collections.abc import Callable

import pandas as pd

from tire_pipeline.concealed.baselines.bic_stepwise import explain_bic_stepwise
from tire_pipeline.concealed.baselines.gaussian_process import explain_gaussian_process
from tire_pipeline.concealed.baselines.refitted_formula import explain_by_refit
from tire_pipeline.concealed.baselines.report import BaselineReport, with_all_inputs
from tire_pipeline.concealed.baselines.sindy import explain_sindy
from tire_pipeline.magic_formula import TireModel

BASELINES: dict[str, Callable[[TireModel, pd.DataFrame], BaselineReport]] = {
    "bic_stepwise": explain_bic_stepwise,
    "pysindy": explain_sindy,
    "gaussian_process": explain_gaussian_process,
    "refitted_formula": explain_by_refit,
}
"""Name -> function of (tire, recording) that gives a :class:`BaselineReport`."""

__all__ = [
    "BASELINES",
    "BaselineReport",
    "explain_bic_stepwise",
    "explain_by_refit",
    "explain_gaussian_process",
    "explain_sindy",
    "with_all_inputs",
]
