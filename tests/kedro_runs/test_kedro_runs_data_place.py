"""Where the data of a run lies."""

from types import SimpleNamespace

import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.kedro_runs.data_place import data_place


def context(data, tmp_path):
    return SimpleNamespace(config_loader={"globals": {"data": data}}, project_path=tmp_path)


@pytest.mark.parametrize("data", [5, None, ["data"], True])
def test_what_is_no_path_is_told(data, tmp_path):
    with pytest.raises(DomainError, match="is no path"):
        data_place(context(data, tmp_path))


def test_a_folder_is_one_of_the_project(tmp_path):
    assert data_place(context("elsewhere", tmp_path)) == tmp_path / "elsewhere"


def test_a_name_that_reads_as_a_pattern_is_told(tmp_path):
    with pytest.raises(DomainError, match="pattern"):
        data_place(context("data[1]", tmp_path))
