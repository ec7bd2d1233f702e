"""What is named in a recording, without the proof on held-out sweeps, which takes most of a report's time."""

from __future__ import annotations

from tire_pipeline.mismatch import Explainer


def named_sets(tire, recording) -> list[set[str]]:
    """Return the sets of names as ``report.sets`` has them: faults that need no fit, then the posterior's."""
    explained = Explainer().weigh(tire, recording)
    found = [{finding.name} for finding in explained.prepared.findings]
    return [*found, *(set(names) for names, _ in explained.answer.sets)]
