"""Six sealed mechanisms that no closed form of the grammar can say."""

import numpy as np

from tire_pipeline.concealed.open_world.mechanism import Mechanism, Shape
from tire_pipeline.concealed.open_world.memory import asymmetric, bouc_wen, lagged
from tire_pipeline.concealed.open_world.world import World


def chatter(world: World, size: float, shape: Shape) -> np.ndarray:
    """Once the contact slides, the hub rings at its own rate, and dies down when it grips.

    Ibrahim, Friction-induced vibration, chatter, squeal and chaos, Appl. Mech. Rev. 47 (1994) 209.
    """
    slides = (np.abs(world.groups()["s"]) > shape["slip"]).astype(float)
    swell = asymmetric(slides, world.step, 0.3, 0.15)
    time = world.channels["time"].to_numpy()
    ring = np.sin(2.0 * np.pi * shape["hertz"] * time + shape["phase"])
    return world.added(fy=size * swell * ring * np.abs(world.forces[:, 1]))


def draw_chatter(rng: np.random.Generator) -> Shape:
    """Slip from which it slides, rate in Hz, phase."""
    return {
        "slip": float(rng.uniform(0.05, 0.09)),
        "hertz": float(rng.uniform(6.0, 18.0)),
        "phase": float(rng.uniform(0.0, 2.0 * np.pi)),
    }


def creep(world: World, size: float, shape: Shape) -> np.ndarray:
    """The carcass creeps for seconds under a force, and the force relaxes by a part of what is new in it.

    Standard linear solid: Ferry, Viscoelastic Properties of Polymers, 1980, ch. 1.
    """
    relaxed = [lagged(world.forces[:, i], world.step, shape["seconds"]) for i in (0, 1)]
    return world.added(
        fx=size * (world.forces[:, 0] - relaxed[0]), fy=size * (world.forces[:, 1] - relaxed[1])
    )


def draw_creep(rng: np.random.Generator) -> Shape:
    """Time constant in s."""
    return {"seconds": float(np.exp(rng.uniform(np.log(0.6), np.log(6.0))))}


def sticking_cell(world: World, size: float, shape: Shape) -> np.ndarray:
    """Guides of the load cell hold back a force (over nominal load) until it has changed enough.

    Wen, Method for random vibration of hysteretic systems, J. Eng. Mech. Div. ASCE 102 (1976) 249.
    """
    held = bouc_wen(world.forces[:, 1] / world.nominal.load, shape["width"])
    return world.added(fy=-size * world.nominal.load * held)


def draw_cell(rng: np.random.Generator) -> Shape:
    """Change over nominal load after which it gives way."""
    return {"width": float(rng.uniform(0.05, 0.4))}


def belt_seam(world: World, size: float, shape: Shape) -> np.ndarray:
    """The belt's joint passes under the tire once a turn of the belt, and grips less.

    Surfaces of flat-belt machines: Gent and Walter (eds.), The Pneumatic Tire, NHTSA 2006.
    """
    phase = (world.path() / shape["belt"] + shape["begin"]) % 1.0
    away = np.minimum(phase, 1.0 - phase) * shape["belt"]
    pulse = np.exp(-0.5 * (away / shape["seam"]) ** 2)
    return -size * pulse[:, None] * world.forces


def draw_seam(rng: np.random.Generator) -> Shape:
    """Length of the belt and of the seam in m, and where the run begins."""
    return {
        "belt": float(rng.uniform(5.0, 9.0)),
        "seam": float(rng.uniform(0.3, 0.8)),
        "begin": float(rng.random()),
    }


def third_body(world: World, size: float, shape: Shape) -> np.ndarray:
    """Sliding rubs a film off the surface: friction rises with the way slid, and levels off.

    Third bodies: Godet, The third-body approach, Wear 100 (1984) 437.
    """
    slid = np.cumsum(world.sliding()) * world.step
    clean = 1.0 - np.exp(-slid / shape["metres"])
    return world.added(fx=size * clean * world.forces[:, 0], fy=size * clean * world.forces[:, 1])


def draw_film(rng: np.random.Generator) -> Shape:
    """Way slid (m) after which the film is off."""
    return {"metres": float(rng.uniform(5.0, 40.0))}


def payne(world: World, size: float, shape: Shape) -> np.ndarray:
    """Filled rubber softens within tenths of a second of strain and takes seconds to recover.

    Payne, The dynamic properties of carbon black-loaded natural rubber vulcanizates, J. Appl. Polym. Sci. 6
    (1962) 57; its recovery: Chazeau et al., Polym. Compos. 21 (2000) 202.
    """
    slip = np.abs(world.groups()["s"]) / shape["slip"]
    soft = asymmetric(slip, world.step, shape["up"], shape["down"])
    grips = np.exp(-(slip**2))
    return world.added(fy=-size * soft * grips * world.forces[:, 1])


def draw_payne(rng: np.random.Generator) -> Shape:
    """Slip at which the tread lets go; time constants in s."""
    return {
        "slip": float(rng.uniform(0.05, 0.12)),
        "up": float(rng.uniform(0.05, 0.3)),
        "down": float(rng.uniform(2.0, 8.0)),
    }


MECHANISMS = (
    Mechanism("chatter", "Ibrahim 1994", ("slip_angle", "time"), "rig", chatter, draw_chatter),
    Mechanism("creep", "Ferry 1980", ("memory of fx", "memory of fy"), "tire", creep, draw_creep),
    Mechanism("sticking cell", "Wen 1976", ("memory of fy",), "rig", sticking_cell, draw_cell),
    Mechanism("belt seam", "Gent and Walter 2006", ("path",), "rig", belt_seam, draw_seam),
    Mechanism("third body", "Godet 1984", ("memory of slip_angle", "memory of slip_ratio", "speed"), "rig",
              third_body, draw_film),
    Mechanism("Payne effect", "Payne 1962", ("memory of slip_angle",), "tire", payne, draw_payne),
)  # fmt: skip
