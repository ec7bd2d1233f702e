"""A flat-belt rig: how far the wheel follows what it is told, and what its sensors make of it."""

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from tire_pipeline.concealed.second.roll import FORCES, Course
from tire_pipeline.concealed.second.schedule import RATE
from tire_pipeline.concealed.second.tire import Tire

ENCODED = ("slip_angle", "slip_ratio", "camber", "normal_load", "speed", "pressure")
BITS = 16


@dataclass(frozen=True)
class Rig:
    """One rig: SI, standard deviations for noise."""

    servo_hz: float  # of the steering, camber and spindle servo
    servo_damping: float
    load_hz: float  # of the load control's resonance
    load_damping: float
    load_disturbance: float  # N
    runout: float  # N a turn of the wheel
    filter_hz: float  # anti-alias, the same for all channels
    jitter: float  # s
    angle_noise: float  # rad
    ratio_noise: float
    load_noise: float  # N
    speed_noise: float  # m/s
    force_noise: tuple[float, float, float]  # N, N, N m: white
    coloured: float  # over white, of noise with a memory
    memory: float  # s


def draw_rig(rng: np.random.Generator) -> Rig:
    """A rig: rates of its servos, noise and filters drawn from ranges that are a choice of this file.

    Parameters
    ----------
    rng
        Source of the draw.
    """
    return Rig(
        servo_hz=float(rng.uniform(3.0, 8.0)),
        servo_damping=float(rng.uniform(0.6, 0.9)),
        load_hz=float(rng.uniform(3.0, 9.0)),
        load_damping=float(rng.uniform(0.08, 0.3)),
        load_disturbance=float(rng.uniform(10.0, 40.0)),
        runout=float(rng.uniform(0.0, 60.0)),
        filter_hz=float(rng.uniform(15.0, 30.0)),
        jitter=float(rng.uniform(0.0, 3e-4)),
        angle_noise=float(np.radians(rng.uniform(0.003, 0.015))),
        ratio_noise=float(rng.uniform(1e-4, 5e-4)),
        load_noise=float(rng.uniform(5.0, 15.0)),
        speed_noise=float(rng.uniform(0.005, 0.03)),
        force_noise=(
            float(rng.uniform(10.0, 30.0)),
            float(rng.uniform(10.0, 30.0)),
            float(rng.uniform(0.5, 1.5)),
        ),
        coloured=float(rng.uniform(0.2, 0.8)),
        memory=float(rng.uniform(0.05, 0.4)),
    )


def _second_order(values: np.ndarray, hertz: float, damping: float) -> np.ndarray:
    """A mass on a spring that follows `values` at 100 Hz, at rest at the first: bilinear, gain one."""
    step = 2.0 * RATE / (2.0 * np.pi * hertz)
    ahead = np.array([1.0, 2.0, 1.0])
    back = np.array(
        [1.0 + 2.0 * damping * step + step**2, 2.0 - 2.0 * step**2, 1.0 - 2.0 * damping * step + step**2]
    )
    first = values[0]
    return first + np.asarray(lfilter(ahead / back[0], back / back[0], values - first))


def driven(told: Course, rig: Rig, tire: Tire, rng: np.random.Generator) -> Course:
    """What the wheel does when it is told `told`: servos lag, load swings and runs out, the belt droops."""
    n = told.time.size
    servo = {
        name: _second_order(getattr(told, name), rig.servo_hz, rig.servo_damping)
        for name in ("slip_angle", "slip_ratio", "camber")
    }
    swing = _second_order(rng.normal(0.0, 1.0, n), rig.load_hz, rig.load_damping)
    swing *= rig.load_disturbance / max(float(np.std(swing)), 1e-9)
    turned = np.cumsum(told.speed) / RATE / tire.radius
    runout = rig.runout * np.sin(turned + rng.uniform(0.0, 2.0 * np.pi))
    load = _second_order(told.normal_load, rig.load_hz, 0.7) + swing + runout
    droop = 0.01 * told.speed * np.abs(servo["slip_ratio"]) / 0.2
    return told._replace(
        **servo, normal_load=np.maximum(load, 200.0), speed=_second_order(told.speed - droop, 1.5, 0.8)
    )


def filtered(values: np.ndarray, rig: Rig) -> np.ndarray:
    """The anti-alias filter, the same on each channel, so that none lags behind another."""
    return _second_order(values, rig.filter_hz, 0.7071)


@dataclass(frozen=True)
class Noise:
    """What the sensors add, drawn once for a run: SI, (n,) a channel."""

    stamps: np.ndarray  # s that a sample is taken late
    channels: dict[str, np.ndarray]


def draw_noise(rig: Rig, n: int, rng: np.random.Generator) -> Noise:
    """Noise of all channels for n samples; forces have a white part and one with a memory."""
    sizes = {
        "slip_angle": rig.angle_noise,
        "slip_ratio": rig.ratio_noise,
        "camber": rig.angle_noise,
        "normal_load": rig.load_noise,
        "speed": rig.speed_noise,
        "pressure": 300.0,
        "tread_temperature": 0.3,
    }
    channels = {name: rng.normal(0.0, size, n) for name, size in sizes.items()}
    keep = np.exp(-1.0 / (RATE * rig.memory))
    for name, size in zip(FORCES, rig.force_noise, strict=True):
        driving = rng.normal(0.0, size * rig.coloured * np.sqrt(1.0 - keep**2), n)
        channels[name] = rng.normal(0.0, size, n) + lfilter([1.0], [1.0, -keep], driving)
    return Noise(rng.normal(0.0, rig.jitter, n), channels)


def noise_size(rig: Rig) -> np.ndarray:
    """Standard deviation of each force's noise, white and coloured together, (3,): N, N, N m."""
    return np.array(rig.force_noise) * np.sqrt(1.0 + rig.coloured**2)


def sensed(values: np.ndarray, name: str, time: np.ndarray, noise: Noise) -> np.ndarray:
    """A filtered channel as it is stored: taken at jittered times, with noise, in steps of 16 bits."""
    taken = np.interp(time + noise.stamps, time, values) + noise.channels[name]
    step = 2.2 * max(float(np.max(np.abs(values))), 1e-9) / 2**BITS
    return step * np.round(taken / step)
