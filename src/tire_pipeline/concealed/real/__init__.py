"""Cases from real recordings, sealed and scored as the simulated ones (docs/explanation/concealed.md)."""

from tire_pipeline.concealed.real.cases import RealAnswer, make_real_case
from tire_pipeline.concealed.real.plan import RealPlan, real_plan

__all__ = ["RealAnswer", "RealPlan", "make_real_case", "real_plan"]
