"""Six mechanisms to tune on that need a memory, a threshold or an angle."""

import numpy as np

from tire_pipeline.concealed.open_world.mechanism import Mechanism, Shape
from tire_pipeline.concealed.open_world.memory import lagged, play, resonance
from tire_pipeline.concealed.open_world.world import World


def _relative(world: World) -> np.ndarray:
    """Side force over normal load, (n,)."""
    return world.forces[:, 1] / np.maximum(world.channels["normal_load"].to_numpy(), 100.0)


def bushing(world: World, size: float, shape: Shape) -> np.ndarray:
    """A rubber bushing turns the wheel by an angle (rad a unit of fy/Fz) that lags in a play.

    Friction in rubber springs: Berg, Vehicle System Dynamics 30 (1998) 197.
    """
    relative = _relative(world)
    return world.turned(size * (relative - play(relative, shape["width"])))


def draw_bushing(rng: np.random.Generator) -> Shape:
    """Width of the play, in fy/Fz."""
    return {"width": float(rng.uniform(0.2, 0.8))}


def carcass_resonance(world: World, size: float, shape: Shape) -> np.ndarray:
    """A part of the side force rings with the carcass on the rim.

    Rigid-ring modes: Zegelaar, The dynamic response of tyres to brake torque and road unevenness,
    TU Delft 1998; to the side Maurice, Short wavelength and dynamic tyre behaviour, TU Delft 2000.
    """
    fy = world.forces[:, 1]
    return world.added(fy=size * (resonance(fy, world.step, shape["hertz"], shape["damping"]) - fy))


def draw_resonance(rng: np.random.Generator) -> Shape:
    """Rate in Hz and damping ratio."""
    return {"hertz": float(rng.uniform(4.0, 15.0)), "damping": float(rng.uniform(0.03, 0.15))}


def drum_runout(world: World, size: float, shape: Shape) -> np.ndarray:
    """The drum is out of round, and the forces swing once a turn of it.

    Runout of test drums: Gent and Walter (eds.), The Pneumatic Tire, NHTSA 2006.
    """
    angle = world.path() / shape["radius"] + shape["phase"]
    return size * np.sin(angle)[:, None] * world.forces


def draw_drum(rng: np.random.Generator) -> Shape:
    """Radius of the drum in m, and where it begins."""
    return {
        "radius": float(rng.choice([0.6, 0.85, 1.0, 1.25])),
        "phase": float(rng.uniform(0.0, 2.0 * np.pi)),
    }


def mullins(world: World, size: float, shape: Shape) -> np.ndarray:
    """Rubber is softer up to the largest deformation it has had: side force falls with that slip.

    Mullins, Softening of rubber by deformation, Rubber Chem. Technol. 42 (1969) 339.
    """
    slip = np.abs(world.groups()["s"])
    largest = np.maximum.accumulate(slip) / shape["slip"]
    grips = np.exp(-((slip / shape["slip"]) ** 2))
    return world.added(fy=-size * world.forces[:, 1] * largest * grips)


def draw_slip(rng: np.random.Generator) -> Shape:
    """Slip at which the tread lets go."""
    return {"slip": float(rng.uniform(0.05, 0.12))}


def unseen_heat(world: World, size: float, shape: Shape) -> np.ndarray:
    """Friction falls with heat that the last sliding has left in the tread, which no channel shows.

    Mizuno et al., Development of a tire force model incorporating the influence of the tire surface
    temperature, Vehicle System Dynamics 43 suppl. (2005) 395.
    """
    power = world.sliding() * np.hypot(world.forces[:, 0], world.forces[:, 1]) / world.nominal.load
    heat = lagged(np.concatenate([[0.0], power[1:]]), world.step, shape["seconds"])
    return world.added(fx=-size * heat * world.forces[:, 0], fy=-size * heat * world.forces[:, 1])


def draw_seconds(rng: np.random.Generator) -> Shape:
    """Time constant in s."""
    return {"seconds": float(np.exp(rng.uniform(np.log(1.5), np.log(10.0))))}


def steering_backlash(world: World, size: float, shape: Shape) -> np.ndarray:
    """The wheel follows its encoder only through a gap (rad).

    Nordin and Gutman, Controlling mechanical systems with backlash, a survey, Automatica 38 (2002) 1633.
    """
    angle = world.channels["slip_angle"].to_numpy()
    return world.turned(play(angle, size) - angle)


MECHANISMS = (
    Mechanism("bushing hysteresis", "Berg 1998", ("memory of fy", "normal_load", "slip_angle"), "rig",
              bushing, draw_bushing),
    Mechanism("carcass resonance", "Maurice 2000", ("memory of fy",), "tire",
              carcass_resonance, draw_resonance),
    Mechanism("drum runout", "Gent and Walter 2006", ("path",), "rig", drum_runout, draw_drum),
    Mechanism("Mullins softening", "Mullins 1969", ("memory of slip_angle",), "tire", mullins, draw_slip),
    Mechanism("unseen heat", "Mizuno et al. 2005",
              ("memory of slip_angle", "memory of slip_ratio", "speed"), "tire", unseen_heat, draw_seconds),
    Mechanism("steering backlash", "Nordin and Gutman 2002", ("memory of slip_angle",), "rig",
              steering_backlash),
)  # fmt: skip
