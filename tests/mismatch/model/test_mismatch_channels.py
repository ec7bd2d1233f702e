"""Channels of a recording: whether a slip goes to both sides."""

import numpy as np
import pytest

from tire_pipeline.mismatch.model.channels import one_sided


@pytest.mark.parametrize(
    ("low", "high", "said"),
    [(-0.15, 0.15, False), (-0.1, 0.15, False), (-0.01, 0.15, True), (0.0, 0.15, True), (-0.15, 0.0, True)],
)
def test_a_slip_goes_to_one_side_or_nearly(low, high, said):
    assert one_sided(np.linspace(low, high, 500)) == said
