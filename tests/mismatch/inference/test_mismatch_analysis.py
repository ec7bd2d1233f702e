"""A recording ready to be weighed: its sums over sweeps, and its noise."""

import numpy as np
import pytest
from small_rig import out_of_round

from tire_pipeline.mismatch.inference.analysis import analyse
from tire_pipeline.mismatch.recording.prepare import prepare


def test_sums_over_sweeps_add_up(tire, record):
    analysis = analyse(prepare(tire, record(2)).data)
    data, system = analysis.data, analysis.system
    rest = {o: data.recorded[o] - data.simulation.base[o] for o in data.outputs}
    columns = {o: np.column_stack([data.simulation.base[o], data.get("normal_load")]) for o in data.outputs}
    whole = system.sums(rest, columns)
    parts = system.by_sweep(rest, columns)
    np.testing.assert_allclose(parts.ne["fy"].sum(axis=0), whole.ne["fy"].sum(axis=0), rtol=1e-9)
    np.testing.assert_allclose(parts.ee, whole.ee)


@pytest.mark.parametrize("seed", range(4))
def test_what_shakes_is_noise_until_it_is_modelled(tire, record, seed):
    """The recording's noise is 25 N."""
    assert analyse(prepare(tire, out_of_round(tire, record(seed))).data).noise["fy"].floor > 50.0
