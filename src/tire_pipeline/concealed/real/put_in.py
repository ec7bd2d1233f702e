"""Known effects put into a real recording by their mechanism.

By similarity (Pacejka, *Tire and Vehicle Dynamics*, 3rd ed., 4.2.1) a tire with the friction ``m`` gives
``m`` times the force at ``m`` times the slip, a tire with the stiffness ``s`` the same force at ``1 / s`` of
the slip, so a recording of the one is made from that of the other. The thrust of camber, ply steer and
conicity does not come from friction: the formula says at which slip angle they leave no side force. A lag
of the slip needs the force at slips that were not there at that moment: the formula fitted to these very
sweeps gives the difference, and what it leaves of the recorded force stays as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import pandas as pd

from tire_pipeline.concealed.brush_rig.artefacts import UNIT_ERRORS, low_pass
from tire_pipeline.concealed.cases.clean_run import model_forces
from tire_pipeline.magic_formula import TireModel

Frame: TypeAlias = pd.DataFrame
_ABOUT_STRAIGHT = 1e-3
"""rad: force and slip are in proportion below that."""


@dataclass(frozen=True)
class RecordedSession:
    """What the mechanisms of one case go by.

    Attributes
    ----------
    formula : TireModel
        Fitted to the recorded and the held-out sweeps.
    start, end : float
        Of the recording, s (0 and 1 without time).
    load, speed, temperature, work, largest : float
        Nominal load N, speed m/s and tread temperature degC; friction work of the recording J; largest
        side force N.
    opposing : float
        -1 where a positive slip angle gives a negative side force, else 1.
    radius : float
        Of the wheel, m.
    done : tuple of ndarray, shape (n,)
        Times, s, and the friction work that the recording has done by then, J. A sweep that is held out of it
        has the same tire.
    rolled : tuple of ndarray, shape (n,)
        Times, s, and the way that the wheel has rolled by then, m. It rolls on in a sweep that is held out.
    """

    formula: TireModel
    start: float
    end: float
    load: float
    speed: float
    temperature: float
    work: float
    largest: float
    opposing: float
    radius: float
    done: tuple[np.ndarray, np.ndarray] = (np.zeros(1), np.zeros(1))
    rolled: tuple[np.ndarray, np.ndarray] = (np.zeros(1), np.zeros(1))


@dataclass(frozen=True)
class Details:
    """What was drawn beside the strength: direction, channel, factor of a unit, moments, phase."""

    sign: float
    channel: str
    factor: float
    moment: float
    interval: tuple[float, float]
    phase: float


@dataclass(frozen=True)
class InsertedEffect:
    """How one effect gets into a recording.

    Attributes
    ----------
    kind : str
        "physics", "artefact" or "unknown".
    act : callable
        (frame of one run, pieces, strength with its sign, Session, Details) -> frame.
    guess, low, high : float
        Strength from which the wanted one is searched, and its limits.
    share_of : str
        ``"force"`` if these are shares of the largest force, ``"radius"`` if they are of the wheel's radius.
    signed : bool
        Whether both directions occur.
    scaled : bool
        Whether the strength can be chosen.
    whole : bool
        Whether binning would take it away: samples are then picked.
    """

    kind: str
    act: Callable[[Frame, np.ndarray, float, RecordedSession, Details], Frame]
    guess: float
    low: float
    high: float
    share_of: str = ""
    signed: bool = False
    scaled: bool = True
    whole: bool = False


def put_in(
    frame: Frame, strengths: Mapping[str, float], session: RecordedSession, details: Mapping[str, Details]
) -> Frame:
    """Return one run with all effects in it, physics first.

    Parameters
    ----------
    frame : pandas.DataFrame
        Whole sweeps at the recording's own rate, ``piece`` numbers them.
    strengths : mapping
        Effect -> strength with its sign.
    session : RecordedSession
    details : mapping
        Effect -> Details.
    """
    order = {"physics": 0, "artefact": 1, "unknown": 2}
    for name in sorted(strengths, key=lambda n: order[INSERTED_EFFECTS[n].kind]):
        pieces = frame["piece"].to_numpy()
        frame = INSERTED_EFFECTS[name].act(frame, pieces, strengths[name], session, details[name])
    return frame


def draw_details(name: str, rng: np.random.Generator, time: np.ndarray) -> Details:
    """Draw everything about an effect but its strength.

    Parameters
    ----------
    name : str
        One of ``INSERTED_EFFECTS``.
    rng : numpy.random.Generator
    time : ndarray, shape (n,)
        Of the recording, s. Moments are drawn by samples: nothing begins in the pauses.
    """
    channel, factor = "fy", 1.0
    if name == "sign_convention":
        channel = str(rng.choice(["slip_angle", "fy"]))
    elif name == "unit_error":
        channel = str(rng.choice(list(UNIT_ERRORS)))
        factor = float(rng.choice(list(UNIT_ERRORS[channel].values())))
    elif name == "stuck_channel":
        channel = str(rng.choice(["normal_load", "fy", "slip_angle"]))

    def at(share: float) -> float:
        return float(time[int(share * (len(time) - 1))])

    first, length = float(rng.uniform(0.2, 0.6)), float(rng.uniform(0.15, 0.3))
    return Details(
        sign=float(rng.choice([-1.0, 1.0])),
        channel=channel,
        factor=factor,
        moment=at(float(rng.uniform(0.3, 0.7))),
        interval=(at(first), at(first + length)),
        phase=float(rng.uniform(0.0, 2.0 * np.pi)),
    )


def friction_work(frame: Frame) -> np.ndarray:
    """Friction work done before each sample of one run, J; time between the pieces does not count."""
    if "time" not in frame or "speed" not in frame:
        return np.zeros(len(frame))
    step = np.diff(frame["time"].to_numpy(), prepend=frame["time"].iloc[0])
    step[_starts(frame["piece"].to_numpy())] = 0.0
    power = np.abs(frame["fy"] * np.sin(frame["slip_angle"]) * frame["speed"]).to_numpy()
    return np.cumsum(power * step)


def way_rolled_by(frame: Frame) -> np.ndarray:
    """Way that the wheel has rolled before each sample of one run, m; it rolls on between the pieces."""
    if "time" not in frame or "speed" not in frame:
        return np.zeros(len(frame))
    step = np.diff(frame["time"].to_numpy(), prepend=frame["time"].iloc[0])
    return np.cumsum(step * frame["speed"].to_numpy())


def _starts(pieces: np.ndarray) -> np.ndarray:
    return np.diff(pieces, prepend=pieces[0] - 1) != 0


def _similar(
    frame: Frame, s: RecordedSession, friction: np.ndarray | float, stiffness: np.ndarray | float = 1.0
) -> Frame:
    """The run of a tire with another friction and another slip stiffness, by similarity."""
    straight = _straight_ahead(frame, s)
    slip = straight + (np.tan(frame["slip_angle"]) - straight) * friction / stiffness
    return frame.assign(slip_angle=np.arctan(slip), fy=frame["fy"] * friction)


def _straight_ahead(frame: Frame, s: RecordedSession) -> np.ndarray:
    """Slip angle without a side force at the camber and load of each sample, by the formula."""
    low, zero, high = (
        model_forces(s.formula, frame.assign(slip_angle=x))[:, 1]
        for x in (-_ABOUT_STRAIGHT, 0.0, _ABOUT_STRAIGHT)
    )
    return -zero * 2.0 * _ABOUT_STRAIGHT / (high - low)


def _friction(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    return _similar(frame, s, 1.0 + x)


def _stiffness(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    return _similar(frame, s, 1.0, 1.0 + x)


def _load(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    return _similar(frame, s, np.maximum(1.0 + x * (frame["normal_load"] / s.load - 1.0), 0.1))


def _temperature(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    return _similar(frame, s, 1.0 + x * (frame["tread_temperature"] - s.temperature) / 10.0)


def _speed(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    grade = np.log(np.maximum(frame["speed"], 0.1) / s.speed)
    return _similar(frame, s, np.maximum(1.0 + x * grade, 0.1))


def _wear(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    before = np.interp(frame["time"].iloc[0], *s.done)
    return _similar(frame, s, np.maximum(1.0 + x * (before + friction_work(frame)) / s.work, 0.1))


def _surface(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, d: Details) -> Frame:
    return _similar(frame, s, np.where(frame["time"] >= d.moment, 1.0 + x, 1.0))


def _compliance(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    """The rig turns the wheel back by ``x`` rad at the largest force: more was set than the tire saw."""
    return frame.assign(slip_angle=frame["slip_angle"] + x * s.opposing * frame["fy"] / s.largest)


def _relaxation(frame: Frame, pieces: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    """Force at the slip that lags by ``x`` metres, plus what the formula leaves of the recorded force."""
    step = np.diff(frame["time"].to_numpy(), prepend=frame["time"].iloc[0]) * frame["speed"].to_numpy()
    slip, behind = np.tan(frame["slip_angle"].to_numpy()), np.empty(len(frame))
    gain = 1.0 - np.exp(-np.maximum(step, 0.0) / x)
    first = _starts(pieces)
    for i in range(len(slip)):
        behind[i] = slip[i] if first[i] else behind[i - 1] + gain[i] * (slip[i] - behind[i - 1])
    lagged = frame.assign(slip_angle=np.arctan(behind))
    change = model_forces(s.formula, lagged)[:, 1] - model_forces(s.formula, frame)[:, 1]
    return frame.assign(fy=frame["fy"] + change)


def _once_a_turn(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, d: Details) -> Frame:
    """A crooked wheel: the slip angle that the tire sees swings by ``x`` rad once a turn."""
    first, (times, way) = float(frame["time"].iloc[0]), s.rolled
    before = np.interp(first, times, way) + max(first - times[-1], 0.0) * frame["speed"].iloc[0]
    turn = (before + way_rolled_by(frame)) / s.radius + d.phase
    wobbling = frame.assign(slip_angle=frame["slip_angle"] + x * np.sin(turn))
    change = model_forces(s.formula, wobbling)[:, 1] - model_forces(s.formula, frame)[:, 1]
    return frame.assign(fy=frame["fy"] + change)


def _offset(channel: str) -> Callable[[Frame, np.ndarray, float, RecordedSession, Details], Frame]:
    def act(frame: Frame, _p: np.ndarray, x: float, _s: RecordedSession, _d: Details) -> Frame:
        return frame.assign(**{channel: frame[channel] + x})

    return act


def _gain(frame: Frame, _p: np.ndarray, x: float, _s: RecordedSession, _d: Details) -> Frame:
    return frame.assign(fy=frame["fy"] * (1.0 + x))


def _load_gain(frame: Frame, _p: np.ndarray, x: float, _s: RecordedSession, _d: Details) -> Frame:
    return frame.assign(normal_load=frame["normal_load"] * (1.0 + x))


def _load_offset(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    return frame.assign(normal_load=frame["normal_load"] + x * s.load)


def _crosstalk(frame: Frame, _p: np.ndarray, x: float, _s: RecordedSession, _d: Details) -> Frame:
    """The load cell leaks the normal load into the side force."""
    return frame.assign(fy=frame["fy"] + x * frame["normal_load"])


def _drift(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    return frame.assign(fy=frame["fy"] + x * (frame["time"] - s.start) / (s.end - s.start))


def _delay(frame: Frame, pieces: np.ndarray, x: float, _s: RecordedSession, _d: Details) -> Frame:
    time, force = frame["time"].to_numpy(), frame["fy"].to_numpy()
    out = np.empty_like(force)
    for piece in np.unique(pieces):
        here = pieces == piece
        out[here] = np.interp(time[here] - x, time[here], force[here])
    return frame.assign(fy=out)


def _low_pass(frame: Frame, pieces: np.ndarray, x: float, _s: RecordedSession, _d: Details) -> Frame:
    """Two equal first-order filters, together with the time constant ``x``, s."""
    time, force = frame["time"].to_numpy(), frame["fy"].to_numpy()
    out = np.empty_like(force)
    for piece in np.unique(pieces):
        here = pieces == piece
        out[here] = low_pass(force[here], x, float(np.median(np.diff(time[here]))))
    return frame.assign(fy=out)


def _clipping(frame: Frame, _p: np.ndarray, x: float, s: RecordedSession, _d: Details) -> Frame:
    level = s.largest * (1.0 - x)
    return frame.assign(fy=frame["fy"].clip(-level, level))


def _resolution(frame: Frame, _p: np.ndarray, x: float, _s: RecordedSession, _d: Details) -> Frame:
    return frame.assign(fy=np.round(frame["fy"] / x) * x)


def _mirrored(frame: Frame, _p: np.ndarray, _x: float, _s: RecordedSession, d: Details) -> Frame:
    return frame.assign(**{d.channel: -frame[d.channel]})


def _unit(frame: Frame, _p: np.ndarray, _x: float, _s: RecordedSession, d: Details) -> Frame:
    return frame.assign(**{d.channel: frame[d.channel] * d.factor})


def _stuck(frame: Frame, _p: np.ndarray, _x: float, _s: RecordedSession, d: Details) -> Frame:
    inside = ((frame["time"] >= d.interval[0]) & (frame["time"] < d.interval[1])).to_numpy()
    if not inside.any():
        return frame
    held = frame[d.channel].to_numpy()[np.argmax(inside)]
    return frame.assign(**{d.channel: np.where(inside, held, frame[d.channel])})


INSERTED_EFFECTS: dict[str, InsertedEffect] = {
    "friction_scale": InsertedEffect("physics", _friction, 0.05, 0.002, 0.6, signed=True),
    "stiffness_scale": InsertedEffect("physics", _stiffness, 0.1, 0.004, 0.9, signed=True),
    "load_sensitivity": InsertedEffect("physics", _load, 0.1, 0.002, 0.8, signed=True),
    "temperature": InsertedEffect("physics", _temperature, 0.05, 0.002, 0.1, signed=True),
    "speed_dependence": InsertedEffect("physics", _speed, 0.1, 0.002, 0.6, signed=True),
    "wear": InsertedEffect("physics", _wear, 0.1, 0.002, 0.7, signed=True),
    "surface_change": InsertedEffect("physics", _surface, 0.1, 0.002, 0.6, signed=True),
    "compliance": InsertedEffect("physics", _compliance, 0.01, 2e-4, 0.06),
    "relaxation_length": InsertedEffect("physics", _relaxation, 1.0, 0.1, 4.0, share_of="radius"),
    "nonuniformity": InsertedEffect("physics", _once_a_turn, 0.005, 2e-4, 0.05, whole=True),
    "force_offset": InsertedEffect("artefact", _offset("fy"), 0.03, 1e-3, 0.6, share_of="force", signed=True),
    "force_gain": InsertedEffect("artefact", _gain, 0.05, 0.001, 0.7, signed=True),
    "load_gain": InsertedEffect("artefact", _load_gain, 0.05, 0.001, 0.5, signed=True),
    "load_offset": InsertedEffect("artefact", _load_offset, 0.05, 0.001, 0.3, signed=True),
    "slip_angle_offset": InsertedEffect("artefact", _offset("slip_angle"), 0.003, 5e-5, 0.06, signed=True),
    "camber_offset": InsertedEffect("artefact", _offset("camber"), 0.02, 1e-3, 0.1, signed=True),
    "crosstalk": InsertedEffect("artefact", _crosstalk, 0.03, 1e-3, 0.5, signed=True),
    "sensor_drift": InsertedEffect("artefact", _drift, 0.06, 2e-3, 0.9, share_of="force", signed=True),
    "time_delay": InsertedEffect("artefact", _delay, 0.05, 0.003, 0.8),
    "low_pass": InsertedEffect("artefact", _low_pass, 0.05, 0.003, 0.8),
    "clipping": InsertedEffect("artefact", _clipping, 0.15, 0.005, 0.7, whole=True),
    "stuck_channel": InsertedEffect("artefact", _stuck, 1.0, 1.0, 1.0, scaled=False, whole=True),
    "sign_convention": InsertedEffect("artefact", _mirrored, 1.0, 1.0, 1.0, scaled=False),
    "unit_error": InsertedEffect("artefact", _unit, 1.0, 1.0, 1.0, scaled=False),
    "quantisation": InsertedEffect("unknown", _resolution, 0.1, 2e-3, 0.8, share_of="force", whole=True),
}
"""Effect -> how it is put in. Camber and pressure are hidden instead (``layout.py``); combined slip and
turning are not in the recordings; conicity by itself is what ``crosstalk`` of the load puts in."""
