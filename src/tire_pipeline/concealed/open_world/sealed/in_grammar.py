"""Six sealed mechanisms that a closed form of at most 12 nodes can say."""

import numpy as np

from tire_pipeline.concealed.open_world.mechanism import Mechanism, Shape
from tire_pipeline.concealed.open_world.world import World


def water_lift(world: World, size: float, shape: Shape) -> np.ndarray:
    """Water carries a part of the load, by speed squared over inflation pressure: -c v^2 / p of the forces.

    Horne and Joyner, Pneumatic tire hydroplaning and some effects on vehicle performance, SAE 650145, 1965.
    """
    x = world.groups()
    part = -size * x["v"] ** 2 / x["p"]
    return world.added(fx=part * x["fx"], fy=part * x["fy"])


def cornering_loss(world: World, size: float, shape: Shape) -> np.ndarray:
    """Rolling resistance grows with the square of slip: -c F0 L s^2.

    Rolling resistance of a cornering tire: Gent and Walter (eds.), The Pneumatic Tire, NHTSA 2006.
    """
    x = world.groups()
    return world.added(fx=-size * x["F0"] * x["L"] * x["s"] ** 2)


def trail_of_length(world: World, size: float, shape: Shape) -> np.ndarray:
    """Trail grows with the length of the contact, that is with the root of load: -c R0 fy L^0.5.

    Pacejka, Tire and Vehicle Dynamics, 2012, ch. 3.2: trail over contact length.
    """
    x = world.groups()
    return world.added(mz=-size * x["R0"] * x["fy"] * np.sqrt(x["L"]))


def belt_tension(world: World, size: float, shape: Shape) -> np.ndarray:
    """Centrifugal tension stiffens the belt against twist, beside what inflation gives: -c mz v^2 / p.

    Tension of a rotating membrane: Soedel, Vibrations of Shells and Plates, 2004.
    """
    x = world.groups()
    return world.added(mz=-size * x["mz"] * x["v"] ** 2 / x["p"])


def leaning_drive(world: World, size: float, shape: Shape) -> np.ndarray:
    """Driving or braking a wheel that leans pushes it aside, with load: c fx g L.

    Camber and longitudinal force: Kuiper and Van Oosten, The PAC2002 advanced handling tire model, Vehicle
    System Dynamics 45 suppl. (2007) 153.
    """
    x = world.groups()
    return world.added(fy=size * x["fx"] * x["g"] * x["L"])


def pressure_times_speed(world: World, size: float, shape: Shape) -> np.ndarray:
    """Friction falls with the heat flow into the skin, pressure times sliding speed: -c |s| v L of fy.

    Flash temperature: Archard, The temperature of rubbing surfaces, Wear 2 (1959) 438.
    """
    x = world.groups()
    return world.added(fy=-size * x["fy"] * np.abs(x["s"]) * x["v"] * x["L"])


MECHANISMS = (
    Mechanism("water lift", "Horne and Joyner 1965", ("speed", "pressure"), "tire", water_lift,
              expressions={"fx": "-c*fx*v**2/p", "fy": "-c*fy*v**2/p"}),
    Mechanism("cornering loss", "Gent and Walter 2006", ("slip_angle", "normal_load"), "tire",
              cornering_loss, expressions={"fx": "-c*F0*L*s**2"}, begin=0.1),
    Mechanism("trail of length", "Pacejka 2012, ch. 3.2", ("slip_angle", "normal_load"), "tire",
              trail_of_length, expressions={"mz": "-c*R0*fy*sqrt(L)"}),
    Mechanism("belt tension", "Soedel 2004", ("speed", "pressure"), "tire", belt_tension,
              expressions={"mz": "-c*mz*v**2/p"}),
    Mechanism("leaning drive", "Kuiper and Van Oosten 2007", ("slip_ratio", "camber", "normal_load"), "tire",
              leaning_drive, expressions={"fy": "c*fx*g*L"}, begin=1.0),
    Mechanism("pressure times speed", "Archard 1959", ("slip_angle", "speed", "normal_load"), "tire",
              pressure_times_speed, expressions={"fy": "-c*fy*Abs(s)*v*L"}, begin=0.1),
)  # fmt: skip
