"""What holds the wheel: a bushing with hysteresis, and a hub that stick-slip shakes."""

import numpy as np
from numba import njit

from tire_pipeline.concealed.second import places as at

HUB_MASS = 18.0  # kg, of wheel and load cell to the side
SLIDES = 0.75  # of the load as side force: from there on the hub is driven
DRIVE = 0.15  # of the hub's rate
REACH = 0.15  # of the load as side force: over this the bushing turns round


@njit(cache=True, error_model="numpy")
def loosen(tire: np.ndarray, hub: np.ndarray, side_force: float, load: float) -> float:
    """Slip angle (rad) that the bushing adds and nobody measures; `hub[0]` is the middle of its play.

    A play operator on force over load, the building block of Prandtl and Ishlinskii (Visintin, Differential
    models of hysteresis, 1994, ch. III): the angle follows the force and keeps what it had while the force
    turns. Rubber-metal bushings: Berg, A non-linear rubber spring model for rail vehicle dynamics analysis,
    Vehicle System Dynamics 30 (1998) 197.
    """
    if tire[at.BUSHING] == 0.0:
        return 0.0
    relative = side_force / load
    follows = min(max(hub[0], relative - REACH), relative + REACH)
    hub[0] = follows
    return tire[at.BUSHING] * (relative - follows) / REACH


@njit(cache=True, error_model="numpy")
def shake(tire: np.ndarray, hub: np.ndarray, side_force: float, load: float, step: float) -> float:
    """Side speed of the hub (m/s); `hub[1]` is its phase in turns and `hub[2]` the force its mass gives, N.

    A limit cycle of a given amplitude that grows in once the contact slides, and dies when it grips: friction
    that falls over speed, Ibrahim, Friction-induced vibration, chatter, squeal and chaos, Appl. Mech. Rev. 47
    (1994) 209. The amplitude is that of the averaged van der Pol oscillator.
    """
    if tire[at.VIBRATION] == 0.0:
        return 0.0
    over = max(abs(side_force) / load - SLIDES, 0.0)
    amplitude = tire[at.VIBRATION] * np.sqrt(min(over / DRIVE, 1.0))
    hub[1] = (hub[1] + step * tire[at.VIBRATION_RATE] / (2.0 * np.pi)) % 1.0
    angle = 2.0 * np.pi * hub[1]
    hub[2] = HUB_MASS * tire[at.VIBRATION_RATE] ** 2 * amplitude * np.sin(angle)
    return amplitude * tire[at.VIBRATION_RATE] * np.cos(angle)
