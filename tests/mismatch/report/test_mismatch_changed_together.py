"""A name that rests on the form of its force alone, because another channel changed with its own."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from tire_pipeline.mismatch.report.changed_together import (
    changed_by_itself,
    changed_together,
    on_changed_together,
)

CAMBER = np.repeat([0.0, 0.035], 400)
NOISE = np.random.default_rng(0).normal(size=800)


def named(name, title, *alternatives):
    return SimpleNamespace(name=name, title=title, names=(name, *alternatives))


TURNED = [named("camber", "camber")]


class Channels:
    """The slow channels of a recording."""

    def __init__(self, **channels):
        self.channels = channels

    def varies(self, name):
        return name in self.channels

    def smooth(self, name):
        return self.channels[name]


def test_a_pressure_that_changed_with_the_camber_is_said():
    data = Channels(camber=CAMBER, pressure=82_700.0 - 4e5 * CAMBER + 300.0 * NOISE)
    told = on_changed_together(changed_together(data, TURNED))
    assert told.startswith("Pressure changed in the same rows as camber: that camber is the cause rests on")
    assert not changed_by_itself(changed_together(data, TURNED), "inflation_pressure")


@pytest.mark.parametrize(
    "pressure",
    [np.tile([82_700.0, 68_900.0], 400) + 300.0 * NOISE, 82_700.0 - 4e5 * CAMBER + 7_000.0 * NOISE],
    ids=["at other rows", "hardly with it"],
)
def test_a_pressure_that_changed_by_itself_is_not(pressure):
    data = Channels(camber=CAMBER, pressure=pressure)
    assert on_changed_together(changed_together(data, TURNED)) == ""
    assert changed_by_itself(changed_together(data, TURNED), "inflation_pressure")


def test_a_pressure_that_is_named_or_open_itself_is_not():
    data = Channels(camber=CAMBER, pressure=82_700.0 - 4e5 * CAMBER)
    both = [*TURNED, named("inflation_pressure", "inflation pressure")]
    assert on_changed_together(changed_together(data, both)) == ""
    either = [named("camber", "camber", "inflation_pressure")]
    assert on_changed_together(changed_together(data, either)) == ""
