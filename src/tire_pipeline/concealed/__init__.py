"""The rig simulator that makes sealed cases, the scorer, and the baselines.

A brush tire that is no Magic Formula is run on a rig with an effect that its ``.tir`` leaves out.
See ``docs/explanation/concealed.md``.

``second`` stays one flat folder: its published hash covers names and import lines, so a move would end the
proof that it is what it was before the engine. The order in which it reads is a rule of import-linter.
"""

from tire_pipeline.concealed.cases.make import Case, CaseSettings, case_plan, make_case, make_cases
from tire_pipeline.concealed.cases.sealed_answers import Answer, EffectTruth, seal, unseal
from tire_pipeline.concealed.scoring.held_out import held_out_errors
from tire_pipeline.concealed.scoring.score import score

__all__ = [
    "Answer",
    "Case",
    "CaseSettings",
    "EffectTruth",
    "case_plan",
    "held_out_errors",
    "make_case",
    "make_cases",
    "score",
    "seal",
    "unseal",
]
