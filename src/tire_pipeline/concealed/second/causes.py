"""The causes of a difference: each one a number that is put into the tire, the course or the load cell."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tire_pipeline.concealed.second import cell, wheel
from tire_pipeline.concealed.second.draws import Draw
from tire_pipeline.concealed.second.roll import Course
from tire_pipeline.concealed.second.tire import Tire


@dataclass(frozen=True)
class Cause:
    """One cause.

    Exactly one of `on_tire`, `on_course`, `on_cell` puts a size into place; sizes are positive, zero changes
    nothing, and `most` is where physics ends.
    """

    name: str
    physics: str
    begin: float
    most: float
    on_tire: Callable[[Tire, float, Draw], Tire] | None = None
    on_course: Callable[[Course, float, Draw], Course] | None = None
    on_cell: Callable[[np.ndarray, Course, float, Draw], np.ndarray] | None = None
    quick: bool = False  # needs quick sweeps
    speeds: bool = False  # needs several speeds
    off_temperature: bool = False  # needs a tire that is not at its conditioned temperature
    catalogued: bool = True  # of the kinds a catalogue of tire and rig faults usually has
    fixed: bool = False  # has one size only


CAUSES: dict[str, Cause] = {
    cause.name: cause
    for cause in (
        Cause("inflation pressure", "the tire is inflated to another pressure than the model's",
              0.05, 0.5, on_course=wheel.inflate),
        Cause("unknown camber", "the wheel is cambered by an angle that no channel has",
              np.radians(0.5), np.radians(8.0), on_course=wheel.lean),
        Cause("tread temperature", "rubber friction and modulus follow the tread's temperature",
              0.5, 4.0, on_tire=wheel.heat, off_temperature=True),
        Cause("tread wear", "friction work rubs tread off, which stiffens what is left",
              2e-11, 1e-8, on_tire=wheel.wear),
        Cause("path curvature", "the wheel runs on a curved path (turn slip)",
              0.01, 0.5, on_course=wheel.turn),
        Cause("relaxation", "the carcass needs a way to deflect before the force is there",
              1.0, 4.0, on_tire=wheel.relax, quick=True),
        Cause("sliding speed", "rubber friction follows the sliding speed, so the travelling speed matters",
              0.5, 6.0, on_tire=wheel.hasten, speeds=True),
        Cause("load sensitivity", "friction falls with contact pressure by another power than the model's",
              0.03, 0.5, on_tire=wheel.press),
        Cause("surface friction", "the surface has another friction",
              0.03, 0.6, on_course=wheel.resurface),
        Cause("tread stiffness", "the tread's rubber is stiffer or softer",
              0.05, 0.7, on_tire=wheel.stiffen_tread),
        Cause("carcass stiffness", "the carcass is stiffer or softer",
              0.1, 0.75, on_tire=wheel.stiffen_carcass),
        Cause("force offset", "the load cell's zero is off", 0.02, 2.0, on_cell=cell.offset),
        Cause("force gain", "the load cell's gain is off", 0.02, 0.9, on_cell=cell.gain),
        Cause("crosstalk", "one measured force leaks into another", 0.02, 0.5, on_cell=cell.leak),
        Cause("load crosstalk", "the normal load leaks into a measured force",
              0.005, 0.3, on_cell=cell.leak_load),
        Cause("delay", "forces are stored later than the wheel's channels",
              0.01, 0.5, on_cell=cell.delay, quick=True),
        Cause("low-pass filter", "forces pass a filter that the wheel's channels do not",
              0.02, 1.0, on_cell=cell.smooth, quick=True),
        Cause("slip angle offset", "the slip angle's encoder has its zero elsewhere",
              np.radians(0.1), np.radians(3.0), on_course=wheel.turn_encoder),
        Cause("clipping", "a measured force ends at the amplifier's limit", 0.2, 0.9, on_cell=cell.clip),
        Cause("quantisation", "a measured force is stored in coarse steps", 0.1, 2.5, on_cell=cell.coarsen),
        Cause("drift", "the load cell's zero wanders with time", 0.05, 2.0, on_cell=cell.drift),
        Cause("unit error", "a measured force is stored in another unit than stated",
              1.0, 1.0, on_cell=cell.mistake_unit, fixed=True),
        Cause("bushing hysteresis", "a rubber bushing yields by an angle that lags behind the force",
              np.radians(0.1), np.radians(5.0), on_tire=wheel.loosen, catalogued=False),
        Cause("drum curvature", "the tire runs on a drum, the model's on a flat belt",
              0.3, 2.5, on_tire=wheel.roll_on_drum, catalogued=False),
        Cause("stick-slip vibration", "the hub shakes once the contact slides",
              2e-4, 2e-2, on_tire=wheel.vibrate, catalogued=False),
    )
}  # fmt: skip
