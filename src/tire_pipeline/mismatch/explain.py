"""How a mismatch is explained, step by step. docs/explanation/mismatch.md gives the reasons."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.inference.analysis import analyse
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes
from tire_pipeline.mismatch.inference.named import with_named
from tire_pipeline.mismatch.inference.sets.another_tire import settled
from tire_pipeline.mismatch.inference.sets.answer import answered
from tire_pipeline.mismatch.inference.sets.enumerate import enumerate_sets
from tire_pipeline.mismatch.inference.thinning import thinned
from tire_pipeline.mismatch.model.data import Choices
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.assemble import Explained, assembled
from tire_pipeline.mismatch.report.result import MismatchReport
from tire_pipeline.progress import track, under_way

_PROGRESS_STAGES = ("check", "noise and misfit", "sets", "answer")


def weigh(
    tire: Any,
    recording: pd.DataFrame,
    *,
    without: Collection[str],
    choices: Choices,
    level: float,
    learnt: LearntSizes,
) -> Explained:
    """Return the causes of a mismatch with their probabilities."""
    steps = track(_PROGRESS_STAGES, "explaining the mismatch")
    step = next(steps)  # what is broken or exactly wrong is repaired or taken out, and said
    try:
        prepared = prepare(tire, recording, choices)
        step = next(steps)  # the noise, and how wrong a fitted formula usually is, by the residual
        analysis = analyse(thinned(prepared.data), without)
        step = next(steps)  # sets of effects are screened, fitted, and their evidence integrated
        sets = enumerate_sets(analysis, learnt)
        step = next(steps)  # evidence times learnt odds says which names are there, and how surely
        answer = answered(sets.case, learnt, level, sets.likelihood)
        prepared, answer = settled(prepared, sets, answer, level)
        analysis = with_named(analysis, sets, answer, prepared.data)  # fitted to all samples
    except np.linalg.LinAlgError as error:
        raise RecordingError(
            f"the equations of this recording cannot be solved ({error})",
            where=f"explain_mismatch, step {step}",
            todo="leave out channels that hold nothing but noise, and please report the recording",
        ) from error
    finally:
        steps.close()
    return Explained(prepared, analysis, sets, answer, prepared.recording, level)


def prove(weighed: Explained) -> MismatchReport:
    """Put into the model what makes no unseen sweep worse, and report the errors on these."""
    with under_way("proving the explanation on held-out sweeps"):
        return assembled(weighed)
