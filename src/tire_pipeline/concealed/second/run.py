"""One run of the rig: what a tire's forces are with a set of causes in place, before any noise."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tire_pipeline.concealed.second.causes import Cause
from tire_pipeline.concealed.second.draws import Draw
from tire_pipeline.concealed.second.rig import Rig, filtered
from tire_pipeline.concealed.second.roll import FORCES, Course, Rolled, roll, warm_state
from tire_pipeline.concealed.second.tire import Tire

Placed = tuple[Cause, float, Draw]


@dataclass(frozen=True)
class Run:
    """A tire on a rig's course, before noise."""

    tire: Tire
    rig: Rig
    course: Course
    above: float  # K that the tire begins above its conditioned temperature

    def rolled(self, placed: tuple[Placed, ...] = ()) -> tuple[Rolled, Course]:
        """The tire rolled with the causes that act on tire and course, and the course it went."""
        tire, course = self.tire, self.course
        for cause, size, draw in placed:
            if cause.on_tire is not None:
                tire = cause.on_tire(tire, size, draw)
            if cause.on_course is not None:
                course = cause.on_course(course, size, draw)
        return roll(tire, course, warm_state(tire, self.above)), course

    def measured(self, rolled: Rolled, placed: tuple[Placed, ...] = ()) -> np.ndarray:
        """Forces (3, n) behind anti-alias filter and load cell, with the causes that act there."""
        forces = np.stack([filtered(getattr(rolled, name), self.rig) for name in FORCES])
        for cause, size, draw in placed:
            if cause.on_cell is not None:
                forces = cause.on_cell(forces, self.course, size, draw)
        return forces

    def forces(self, placed: tuple[Placed, ...] = ()) -> np.ndarray:
        """Both, (3, n): N, N, N m."""
        return self.measured(self.rolled(placed)[0], placed)


def as_parameters(placed: Placed) -> dict[str, Any]:
    """A cause in plain numbers for the sealed truth."""
    cause, size, draw = placed
    return {
        "size": float(size),
        "sign": float(draw.sign),
        "channel": FORCES[draw.channel] if cause.on_cell is not None else None,
        "constant": bool(draw.constant) if cause.on_course is not None else None,
    }
