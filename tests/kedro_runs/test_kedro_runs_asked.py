"""What is asked for on the command line and cannot be: one line that says what to do."""

from __future__ import annotations

import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.kedro_runs.run_errors import one_line
from tire_pipeline.kedro_runs.unknown_parameters import check_values


@pytest.mark.parametrize("value", [None, ""])
def test_a_folder_without_a_name_is_told_by_the_parameter(value):
    """An empty variable of the shell: `'NoneType' object has no attribute 'partition'` was the answer."""
    with pytest.raises(DomainError, match=r"--params: 'tir_folder' has no value -> write it behind the sign"):
        check_values({"tir_folder": value}, {"tir_folder", "recordings_folder"})
    check_values({"tir_folder": "my_files", "target_category": None}, {"tir_folder"})


def test_a_node_that_is_in_no_pipeline_is_one_line():
    said = one_line(ValueError("Pipeline does not contain nodes named ['nope']."))
    assert said == (
        "Pipeline does not contain nodes named ['nope']. -> `kedro registry describe PIPELINE` lists the "
        "nodes of a pipeline"
    )
    assert one_line(ValueError("another")) is None
