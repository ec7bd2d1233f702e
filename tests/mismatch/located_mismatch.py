"""Where a recording leaves its model, and what the report says of it, without any explanation."""

from __future__ import annotations

from tire_pipeline.mismatch.discrepancy.noise import estimate_noise
from tire_pipeline.mismatch.model.blocks import sweeps
from tire_pipeline.mismatch.proof.locate import everywhere, locate
from tire_pipeline.mismatch.proof.measured import Remainder
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.sentences import head


def located(tire, recording):
    """Places, what is off throughout, and what the report says of it."""
    data = prepare(tire, recording).data
    rest = {o: data.recorded[o] - data.simulation.base[o] for o in data.outputs}
    found = locate(data, rest, estimate_noise(data, rest), sweeps(data))
    even = everywhere(data, rest, found)
    nothing = Remainder(size={}, located=[], significant=False)
    said = head("unexplained", [], {}, found, nothing, "", {}, even).text
    return found, even, said.partition(". ")[2]
