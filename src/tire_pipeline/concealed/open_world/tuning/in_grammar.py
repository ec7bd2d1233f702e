"""Six mechanisms to tune on that a short closed form can say."""

import numpy as np

from tire_pipeline.concealed.open_world.mechanism import Mechanism, Shape
from tire_pipeline.concealed.open_world.world import World


def aerodynamic_load(world: World, size: float, shape: Shape) -> np.ndarray:
    """Wind on the wheel loads the contact behind the load cell: more force by c v^2 / L.

    Load grows with dynamic pressure (Katz, Race Car Aerodynamics, 1995, ch. 2), forces with load.
    """
    x = world.groups()
    part = size * x["v"] ** 2 / x["L"]
    return world.added(fx=part * x["fx"], fy=part * x["fy"])


def conicity_over_load(world: World, size: float, shape: Shape) -> np.ndarray:
    """Conicity's force grows faster than load, as the crown is pressed flat: c F0 L^2.

    Conicity as an equivalent camber that depends on load: Pacejka, Tire and Vehicle Dynamics, 2012, ch. 4.
    """
    x = world.groups()
    return world.added(fy=size * x["F0"] * x["L"] ** 2)


def slip_drag(world: World, size: float, shape: Shape) -> np.ndarray:
    """A part of the side force turned into the wheel's direction by the slip angle: -c fy s.

    What a load cell sees that stands along the path instead of the wheel: SAE J670, force systems.
    """
    x = world.groups()
    return world.added(fx=-size * x["fy"] * x["s"])


def edge_lift(world: World, size: float, shape: Shape) -> np.ndarray:
    """A cambered and loaded tire lifts its edge and loses side force: -c fy g^2 L.

    Contact under camber: Gent and Walter (eds.), The Pneumatic Tire, NHTSA 2006.
    """
    x = world.groups()
    return world.added(fy=-size * x["fy"] * x["g"] ** 2 * x["L"])


def offset_drive(world: World, size: float, shape: Shape) -> np.ndarray:
    """The side force shifts the contact, so that the longitudinal force has a lever: -c R0 fx fy / F0.

    Pacejka 2012, ch. 3.3, moment of Fx on a flexible carcass.
    """
    x = world.groups()
    return world.added(mz=-size * x["R0"] * x["fx"] * x["fy"] / x["F0"])


def soft_when_hot_and_loaded(world: World, size: float, shape: Shape) -> np.ndarray:
    """Heat softens the rubber the more, the more it is loaded: -c fy h L.

    Temperature and load together: Angrick, van Putten and Prokop, SAE 2014-01-0074.
    """
    x = world.groups()
    return world.added(fy=-size * x["fy"] * x["h"] * x["L"])


MECHANISMS = (
    Mechanism("aerodynamic load", "Katz 1995", ("speed", "normal_load"), "rig", aerodynamic_load,
              expressions={"fx": "c*fx*v**2/L", "fy": "c*fy*v**2/L"}),
    Mechanism("conicity over load", "Pacejka 2012, ch. 4", ("normal_load",), "tire", conicity_over_load,
              expressions={"fy": "c*F0*L**2"}),
    Mechanism("slip drag", "SAE J670", ("slip_angle",), "rig", slip_drag, expressions={"fx": "-c*fy*s"}),
    Mechanism("edge lift", "Gent and Walter 2006", ("camber", "normal_load"), "tire", edge_lift,
              expressions={"fy": "-c*fy*g**2*L"}, begin=1.0),
    Mechanism("offset drive", "Pacejka 2012, ch. 3.3", ("slip_ratio", "slip_angle"), "tire", offset_drive,
              expressions={"mz": "-c*R0*fx*fy/F0"}),
    Mechanism("soft when hot and loaded", "Angrick et al. 2014", ("tread_temperature", "normal_load"), "tire",
              soft_when_hot_and_loaded, expressions={"fy": "-c*fy*h*L"}),
)  # fmt: skip
