"""A world on the second simulator, in which each mechanism has what it needs."""

import numpy as np
import pandas as pd

from tire_pipeline.concealed.open_world.world import Nominal, World
from tire_pipeline.concealed.second import schedule
from tire_pipeline.concealed.second.rig import draw_rig, driven, noise_size
from tire_pipeline.concealed.second.roll import FORCES, Course, roll, warm_state
from tire_pipeline.concealed.second.tire import draw_tire

VARIED = ("slip_angle", "slip_ratio", "camber", "normal_load", "speed", "pressure")
PRESSURES = 0.2  # either way


def draw_world(rng: np.random.Generator, rows: int = 6000) -> tuple[World, np.ndarray]:
    """A run of the second simulator before noise, and its noise's standard deviations, (3,): N, N, N m.

    Loads, cambers, speeds, pressures and both slips vary, and the tread begins off its temperature.

    Parameters
    ----------
    rows
        Samples at 100 Hz.
    """
    tire, rig = draw_tire(rng), draw_rig(rng)
    sections = schedule.drawn_sections(rng, tire, rows, quick=False, speeds=True)
    course = driven(schedule.played(sections, tire), rig, tire, rng)
    course = course._replace(pressure=course.pressure * (1.0 + PRESSURES * schedule.pattern(sections, rng)))
    begin = warm_state(tire, float(rng.choice([-15.0, 15.0])))

    def on(channels: pd.DataFrame) -> Course:
        return course._replace(**{name: channels[name].to_numpy() for name in VARIED})

    def forces(channels: pd.DataFrame) -> np.ndarray:
        rolled = roll(tire, on(channels), begin)
        return np.stack([getattr(rolled, name) for name in FORCES], axis=1)

    channels = pd.DataFrame({"time": course.time, **{name: getattr(course, name) for name in VARIED}})
    channels["tread_temperature"] = roll(tire, course, begin).tread_temperature
    nominal = Nominal(
        tire.nominal_load, tire.nominal_speed, tire.nominal_pressure, tire.friction_temperature, tire.radius
    )
    return World(channels, forces(channels), forces, nominal), noise_size(rig)
