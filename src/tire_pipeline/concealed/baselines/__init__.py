"""What else is tried on the same cases: plain BIC stepwise, PySINDy, a Gaussian process."""

from tire_pipeline.concealed.baselines.bic_stepwise import explain_bic_stepwise
from tire_pipeline.concealed.baselines.gaussian_process import explain_gaussian_process
from tire_pipeline.concealed.baselines.report import BaselineReport
from tire_pipeline.concealed.baselines.sindy import explain_sindy

BASELINES = {
    "bic_stepwise": explain_bic_stepwise,
    "pysindy": explain_sindy,
    "gaussian_process": explain_gaussian_process,
}
"""Name -> function of (tire, recording) that gives a :class:`BaselineReport`."""

__all__ = [
    "BASELINES",
    "BaselineReport",
    "explain_bic_stepwise",
    "explain_gaussian_process",
    "explain_sindy",
]
