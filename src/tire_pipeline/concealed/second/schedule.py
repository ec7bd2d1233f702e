"""What the rig is told to do: sweeps of slip at loads, cambers and speeds, one section after the other."""

from dataclasses import dataclass

import numpy as np

from tire_pipeline.concealed.second.roll import Course
from tire_pipeline.concealed.second.tire import Tire

RATE = 100.0  # Hz
BLEND = 0.5  # s, from one section's level to the next
LARGEST_CAMBER = np.radians(3.0)
REFERENCE_LOADS = (0.4, 0.8, 1.2, 1.6, 2.0)  # over nominal load


@dataclass(frozen=True)
class Section:
    """One sweep: which slip is swept how far, and what is held. Angles in rad, load in N, speed in m/s."""

    swept: str  # "slip_angle" or "slip_ratio"
    amplitude: float
    held: float  # the other slip
    load: float
    camber: float
    speed: float
    seconds: float
    wave: str = "triangle"
    turns: int = 1


def _wave(section: Section, samples: int) -> np.ndarray:
    """From 0 up, down and back, `turns` times, (samples,)."""
    phase = section.turns * np.linspace(0.0, 1.0, samples)
    if section.wave == "sine":
        return section.amplitude * np.sin(2.0 * np.pi * phase)
    return section.amplitude * (2.0 / np.pi) * np.arcsin(0.995 * np.sin(2.0 * np.pi * phase))


def _blended(levels: np.ndarray, samples: np.ndarray) -> np.ndarray:
    """Levels held for so many samples each, with a half cosine from one to the next."""
    steps = np.repeat(levels, samples)
    begins = np.cumsum(samples)[:-1]
    width = int(BLEND * RATE)
    for begin, before, after in zip(begins, levels[:-1], levels[1:], strict=True):
        part = steps[begin : begin + width]
        part[:] = before + (after - before) * 0.5 * (1.0 - np.cos(np.pi * np.arange(part.size) / width))
    return steps


def played(sections: list[Section], tire: Tire) -> Course:
    """The sections one after the other at 100 Hz, at the tire's nominal pressure."""
    samples = np.array([round(section.seconds * RATE) for section in sections])
    slips = {"slip_angle": np.zeros(samples.sum()), "slip_ratio": np.zeros(samples.sum())}
    at = 0
    for section, count in zip(sections, samples, strict=True):
        slips[section.swept][at : at + count] = _wave(section, count)
        at += count
    for name, other in (("slip_angle", "slip_ratio"), ("slip_ratio", "slip_angle")):
        held = np.array([section.held if section.swept == other else 0.0 for section in sections])
        slips[name] += _blended(held, samples)
    n = int(samples.sum())
    return Course(
        time=np.arange(n) / RATE,
        slip_angle=slips["slip_angle"],
        slip_ratio=slips["slip_ratio"],
        camber=_blended(np.array([section.camber for section in sections]), samples),
        normal_load=_blended(np.array([section.load for section in sections]), samples),
        speed=_blended(np.array([section.speed for section in sections]), samples),
        pressure=np.full(n, tire.nominal_pressure),
        turn_slip=np.zeros(n),
        surface=np.ones(n),
    )


def pattern(sections: list[Section], rng: np.random.Generator) -> np.ndarray:
    """A level from -1 to 1 for each section, the ends among them, blended, (n,)."""
    samples = np.array([round(section.seconds * RATE) for section in sections])
    levels = rng.permutation(np.linspace(-1.0, 1.0, len(sections)))
    return _blended(levels, samples)


def drawn_sections(
    rng: np.random.Generator, tire: Tire, rows: int, quick: bool, speeds: bool
) -> list[Section]:
    """Sweeps of some seconds each that fill `rows` samples.

    Parameters
    ----------
    quick
        Sweep several times in a section, so that slip changes by some tens of degrees a second.
    speeds
        Travel each section at its own speed, from half to one and a half of the nominal one.
    """
    count = max(round(rows / RATE / rng.uniform(5.0, 8.0)), 2)
    ends = np.linspace(0, rows, count + 1).astype(int)
    only_side = rng.random() < 0.25
    sections = []
    for index, samples in enumerate(np.diff(ends)):
        kind = "side" if only_side else ("side", "length", "side", "both", "side")[index % 5]
        to_side = kind == "side" or (kind == "both" and rng.random() < 0.5)
        amplitude = np.radians(rng.uniform(5.0, 12.0)) if to_side else rng.uniform(0.08, 0.18)
        held = 0.0
        if kind == "both":
            held = rng.choice([-1.0, 1.0]) * (
                rng.uniform(0.02, 0.08) if to_side else np.radians(rng.uniform(1.5, 6.0))
            )
        sections.append(
            Section(
                swept="slip_angle" if to_side else "slip_ratio",
                amplitude=float(amplitude * rng.choice([-1.0, 1.0])),
                held=float(held),
                load=float(tire.nominal_load * rng.uniform(0.4, 1.9)),
                camber=float(rng.uniform(-1.0, 1.0) * LARGEST_CAMBER * (rng.random() < 0.6)),
                speed=tire.nominal_speed * float(rng.uniform(0.5, 1.5) if speeds else 1.0),
                seconds=float(samples / RATE),
                wave=str(rng.choice(["triangle", "sine"])),
                turns=int(rng.integers(2, 7)) if quick else 1,
            )
        )
    order = rng.permutation(len(sections))
    return [sections[i] for i in order]


def reference_sections(tire: Tire) -> tuple[list[Section], list[Section]]:
    """The sweeps a tire model is fitted to: side force at loads and cambers; driving, braking, combined."""
    speed, load = tire.nominal_speed, tire.nominal_load
    side = [
        Section("slip_angle", np.radians(12.0), 0.0, part * load, camber, speed, 4.0)
        for part in REFERENCE_LOADS
        for camber in (0.0, LARGEST_CAMBER, -LARGEST_CAMBER)
    ]
    length = [Section("slip_ratio", 0.18, 0.0, part * load, 0.0, speed, 4.0) for part in REFERENCE_LOADS]
    length += [Section("slip_ratio", 0.18, 0.0, load, LARGEST_CAMBER, speed, 4.0)]
    length += [
        Section("slip_ratio", 0.18, np.radians(angle), part * load, 0.0, speed, 4.0)
        for part in (0.6, 1.4)
        for angle in (-2.0, 4.0, -6.0)
    ]
    length += [Section("slip_angle", np.radians(10.0), 0.05, load, 0.0, speed, 4.0)]
    return side, length
