"""What a recording shows of each parameter, with all of the catalogue or part of it."""

from __future__ import annotations

from tire_pipeline.mismatch import Explainer
from tire_pipeline.mismatch.proof.visible import sights

NOISY = {"force_offset": "fy", "sensor_drift": "fy", "time_delay": "delay"}
"""Effects whose parameter noise of the force hides, each in its own way."""


def sizes(tire, recording, without=()):
    """Return the analysis, and (effect, parameter) -> what the recording shows of it."""
    it = Explainer(without=without).weigh(tire, recording)
    found = sights(it.analysis, it.sets, it.answer.named)
    return it.analysis, {(s.variant.name, s.parameter.name): s for s in found}
