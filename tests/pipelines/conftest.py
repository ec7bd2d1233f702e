"""Fixtures of the pipeline tests."""

from conftest_kedro import small_fleet, small_run

__all__ = ["small_fleet", "small_run"]
