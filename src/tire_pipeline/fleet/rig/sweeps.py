"""The rig: raw sweeps of true tires under a regime, with lag, temperature, filter and noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from tire_pipeline.fleet.rig.regimes import Regime
from tire_pipeline.fleet.rig.true_forces import Contact, TrueTires, in_contact, lateral, longitudinal

SAMPLES = 48  # a direction of a sweep, before decimation
DECIMATE = 2
LATERAL_LOADS = 5
CAMBER_LOADS = 2
SLIP_LOADS = 4


@dataclass(frozen=True)
class Sweeps:
    """Processed measurement points of n tires; every array has shape (n, points).

    Attributes
    ----------
    slip : ndarray
        Slip angle (rad) or slip ratio.
    normal_load, camber, force, moment : ndarray
        N, rad, N, N m; ``moment`` is ``None`` for longitudinal sweeps.
    """

    slip: np.ndarray
    normal_load: np.ndarray
    camber: np.ndarray
    force: np.ndarray
    moment: np.ndarray | None = None

    def of_tires(self, rows: np.ndarray | slice) -> Sweeps:
        """Return the points of some of the tires."""
        moment = None if self.moment is None else self.moment[rows]
        return Sweeps(self.slip[rows], self.normal_load[rows], self.camber[rows], self.force[rows], moment)


@dataclass(frozen=True)
class Session:
    """What differs from one measurement session to the next: the noise floor. Shapes (n, 1).

    Attributes
    ----------
    gain, load_gain : ndarray
        Errors of the force and load channels, as factors.
    surface : ndarray
        State of the test surface that day, as a factor on friction.
    angle : ndarray
        Zero error of the slip angle, rad.
    temperature : ndarray
        Error of the preheat, K.
    stiffness : ndarray
        Difference of the specimen's run-in, as a factor on the conditioning share.
    """

    gain: np.ndarray
    load_gain: np.ndarray
    surface: np.ndarray
    angle: np.ndarray
    temperature: np.ndarray
    stiffness: np.ndarray


def draw_sessions(count: int, rng: np.random.Generator) -> Session:
    """Draw the day-to-day errors of some measurements.

    Parameters
    ----------
    count : int
    rng : numpy.random.Generator

    Returns
    -------
    Session
    """

    def normal(scale: float) -> np.ndarray:
        return rng.normal(0.0, scale, (count, 1))

    return Session(
        gain=1.0 + normal(0.003),
        load_gain=1.0 + normal(0.003),
        surface=1.0 + normal(0.0055),
        angle=normal(0.0004),
        temperature=normal(1.2),
        stiffness=normal(0.06),
    )


def measure_lateral(
    tires: pd.DataFrame,
    condition: pd.DataFrame,
    regime: Regime,
    session: Session,
    rng: np.random.Generator,
) -> Sweeps:
    """Slip angle sweeps at five loads and, at two loads, positive and negative camber.

    Parameters
    ----------
    tires : pandas.DataFrame
        n tires, parameters already blended by :func:`.tire_population.thermal_parameters`.
    condition : pandas.DataFrame
        n rows with ``pressure`` (over nominal) and ``wear``.
    regime : Regime
    session : Session
    rng : numpy.random.Generator
        Sample noise.

    Returns
    -------
    Sweeps
    """
    loads, cambers = _lateral_cases(tires, regime)
    true = in_contact(tires, _contact(tires, condition, regime, session, loads, cambers))
    ramp = np.linspace(-1.0, 1.0, SAMPLES) * regime.slip_range
    command = np.concatenate([ramp, ramp[::-1]])
    fy, mz = _sweep_slip_angle(true, command, regime, session)
    scale = true.tires["rated_load"][:, :, None]
    fy = fy * session.gain[:, :, None] + rng.normal(0.0, 0.005, fy.shape) * scale
    mz = mz * session.gain[:, :, None] + rng.normal(0.0, 0.0004, mz.shape) * scale
    fy, mz = _directions(fy, regime), _directions(mz, regime)
    fy, mz = _symmetrise(fy, regime.symmetrise), _symmetrise(mz, regime.symmetrise)
    shape = (len(tires), loads.shape[1], SAMPLES // DECIMATE)
    slip = np.broadcast_to(_decimate(ramp), shape)
    return Sweeps(
        slip=_flat(slip),
        normal_load=_flat(np.broadcast_to(loads[:, :, None], shape)),
        camber=_flat(np.broadcast_to(cambers[None, :, None], shape)),
        force=_flat(_decimate(fy)),
        moment=_flat(_decimate(mz)),
    )


def measure_longitudinal(
    tires: pd.DataFrame,
    condition: pd.DataFrame,
    regime: Regime,
    session: Session,
    rng: np.random.Generator,
) -> Sweeps:
    """Slip ratio sweeps at four loads and one more with camber.

    Parameters
    ----------
    tires, condition, regime, session, rng
        As in :func:`measure_lateral`.

    Returns
    -------
    Sweeps
    """
    share = np.linspace(regime.load_low, regime.load_high, SLIP_LOADS)
    share = np.append(share, 0.5 * (regime.load_low + regime.load_high))
    loads = share[None, :] * tires["rated_load"].to_numpy()[:, None]
    cambers = np.append(np.zeros(SLIP_LOADS), regime.camber_range)
    true = in_contact(tires, _contact(tires, condition, regime, session, loads, cambers))
    command = np.linspace(-1.0, 1.0, SAMPLES) * regime.slip_ratio_range
    temperature = np.full(loads.shape, regime.preheat) + session.temperature
    step = 2.0 * regime.slip_ratio_range / (0.35 * SAMPLES)
    out = np.empty((*loads.shape, SAMPLES))
    # The belt's slip control has a zero error of its own, from the angle channel's session error.
    offset = session.angle * 1.5
    for k, slip in enumerate(command):
        fx = longitudinal(true, slip + offset, regime.speed, temperature)
        out[:, :, k] = fx
        heat = regime.heating * 0.5 * np.abs(fx * slip) * regime.speed
        temperature = temperature + step * (heat - (temperature - regime.ambient) / 25.0)
    scale = true.tires["rated_load"][:, :, None]
    out = out * session.gain[:, :, None] + rng.normal(0.0, 0.008, out.shape) * scale
    shape = (*loads.shape, SAMPLES // DECIMATE)
    return Sweeps(
        slip=_flat(np.broadcast_to(_decimate(command), shape)),
        normal_load=_flat(np.broadcast_to(loads[:, :, None], shape)),
        camber=_flat(np.broadcast_to(cambers[None, :, None], shape)),
        force=_flat(_decimate(out)),
    )


def _lateral_cases(tires: pd.DataFrame, regime: Regime) -> tuple[np.ndarray, np.ndarray]:
    """Loads (n, cases) in N and cambers (cases,) in rad."""
    share = np.linspace(regime.load_low, regime.load_high, LATERAL_LOADS)
    span = regime.load_high - regime.load_low
    tilted = np.repeat([regime.load_low + 0.25 * span, regime.load_low + 0.75 * span], 2)
    signs = np.tile([-1.0, 1.0], CAMBER_LOADS)
    cambers = np.concatenate([np.zeros(LATERAL_LOADS), signs * regime.camber_range])
    rated = tires["rated_load"].to_numpy()[:, None]
    return np.concatenate([share, tilted])[None, :] * rated, cambers


def _contact(
    tires: pd.DataFrame,
    condition: pd.DataFrame,
    regime: Regime,
    session: Session,
    loads: np.ndarray,
    cambers: np.ndarray,
) -> Contact:
    """Gather what the tire meets, day-to-day errors included."""

    def column(name: str) -> np.ndarray:
        return condition[name].to_numpy(dtype=float)[:, None]

    return Contact(
        normal_load=loads * session.load_gain,
        camber=np.broadcast_to(cambers[None, :], loads.shape),
        pressure=column("pressure") * regime.pressure,
        wear=column("wear"),
        adhesion=regime.adhesion * session.surface,
        hysteresis=regime.hysteresis * session.surface,
        curvature=regime.curvature_radius * tires["UNLOADED_RADIUS"].to_numpy()[:, None],
        conditioning=np.clip(regime.conditioning + session.stiffness, 0.0, 1.2),
    )


def _sweep_slip_angle(
    true: TrueTires, command: np.ndarray, regime: Regime, session: Session
) -> tuple[np.ndarray, np.ndarray]:
    """Integrate relaxation, rig compliance, tread temperature and filter over one sweep."""
    shape = true.normal_load.shape
    step = 2.0 * regime.slip_range / regime.sweep_rate / SAMPLES
    follow = 1.0 - np.exp(-regime.speed * step / np.maximum(true.relaxation_length, 0.05))
    smooth = 1.0 - np.exp(-step / max(regime.filter_time, 1e-3))
    slip = np.full(shape, command[0]) + session.angle
    temperature = np.full(shape, regime.preheat) + session.temperature
    fy, mz = lateral(true, slip, regime.speed, temperature)
    seen_fy, seen_mz = fy, mz
    out_fy = np.empty((*shape, command.size))
    out_mz = np.empty((*shape, command.size))
    for k, angle in enumerate(command):
        applied = angle + session.angle + regime.rig_compliance * fy
        slip = slip + follow * (applied - slip)
        fy, mz = lateral(true, slip, regime.speed, temperature)
        seen_fy = seen_fy + smooth * (fy - seen_fy)
        seen_mz = seen_mz + smooth * (mz - seen_mz)
        out_fy[:, :, k], out_mz[:, :, k] = seen_fy, seen_mz
        heat = regime.heating * np.abs(fy * slip) * regime.speed
        temperature = temperature + step * (heat - (temperature - regime.ambient) / 25.0)
    return out_fy, out_mz


def _directions(curve: np.ndarray, regime: Regime) -> np.ndarray:
    """Mix of the average of both directions and of the up sweep alone."""
    up, down = curve[:, :, :SAMPLES], curve[:, :, SAMPLES:][:, :, ::-1]
    weight = 0.5 * regime.both_directions
    return (1.0 - weight) * up + weight * down


def _symmetrise(curve: np.ndarray, share: float) -> np.ndarray:
    """Remove a share of the even part; cases with camber are mirrored onto each other."""
    flat = curve[:, :LATERAL_LOADS]
    tilted = curve[:, LATERAL_LOADS:]
    partner = tilted.reshape(len(curve), CAMBER_LOADS, 2, -1)[:, :, ::-1, :].reshape(tilted.shape)
    mirrored = np.concatenate([flat, partner], axis=1)[:, :, ::-1]
    return curve - 0.5 * share * (curve + mirrored)


def _decimate(values: np.ndarray) -> np.ndarray:
    """Average neighbouring samples."""
    return values.reshape(*values.shape[:-1], -1, DECIMATE).mean(axis=-1)


def _flat(values: np.ndarray) -> np.ndarray:
    """(n, cases, samples) to (n, points)."""
    return np.ascontiguousarray(values.reshape(len(values), -1))
