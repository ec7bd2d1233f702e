"""Tuning cases: what counts as right is what Fx and Fy can show."""

from pathlib import Path

import pytest

from tire_pipeline.calibration.cases import plans


def case_of(name: str):
    """One tuning case of a simulator."""
    source, seed, number = name.split("_")
    wanted = {key: {} for key in ("real", "first", "second", "unnamed")}
    wanted[source] = {int(seed): int(number) + 1}
    return dict(plans(Path("no recordings"), **wanted))[name]()


@pytest.mark.parametrize("name", ["second_4242_030", "unnamed_2718_004"])
def test_a_cause_that_only_the_moment_shows_is_no_answer(name):
    """A load that leaks into Mz, and a moment that comes with the drive: Fx and Fy hold neither."""
    case = case_of(name)
    assert case.kind == "nothing"
    assert case.right == ((),)
    assert case.unnamed == (False,)


def test_a_cause_in_a_force_is_the_answer():
    case = case_of("second_4242_019")
    assert case.truth == ("crosstalk",)
    assert case.right == (("crosstalk",),)
