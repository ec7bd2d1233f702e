"""The rig: runs a schedule on a tire with chosen effects and records it with noise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
import scipy

from tire_pipeline.concealed.brush_rig import brush
from tire_pipeline.concealed.brush_rig.artefacts import ArtefactDetails, apply_artefact
from tire_pipeline.concealed.brush_rig.constants import TireConstants
from tire_pipeline.concealed.brush_rig.schedule import CHANNELS
from tire_pipeline.concealed.brush_rig.unknown_effects import act_on_forces, play
from tire_pipeline.concealed.effect_names import ARTEFACTS

RIG_FORCES = ("fx", "fy")
"""Outputs that are recorded."""

IN_BRUSH: dict[str, int] = {
    "friction_scale": brush.E_FRICTION,
    "stiffness_scale": brush.E_STIFFNESS,
    "load_sensitivity": brush.E_LOAD,
    "camber": brush.E_CAMBER,
    "combined_slip": brush.E_COUPLING,
    "inflation_pressure": brush.E_PRESSURE,
    "temperature": brush.E_TEMPERATURE,
    "speed_dependence": brush.E_SPEED,
    "relaxation_length": brush.E_RELAXATION,
    "wear": brush.E_WEAR,
    "plysteer_conicity": brush.E_PLY,
    "turn_slip": brush.E_TURN,
    "nonuniformity": brush.E_NONUNIFORM,
    "compliance": brush.E_COMPLIANCE,
    "surface_change": brush.E_SURFACE,
    "slip_rate": brush.E_SLIP_RATE,
    "load_rate": brush.E_LOAD_RATE,
    "friction_memory": brush.E_MEMORY,
}
"""Effect -> place of its strength in the brush's vector."""


@dataclass(frozen=True)
class SensorNoise:
    """Standard deviations of the channels' noise, SI, and its colour.

    Attributes
    ----------
    sigma : mapping
        Channel -> standard deviation.
    colour : mapping
        Channel -> correlation of the coloured part from one sample to the next.
    coloured_share : float
        Share of the variance that is coloured; the rest is white.
    """

    sigma: Mapping[str, float]
    colour: Mapping[str, float]
    coloured_share: float


def draw_noise(rng: np.random.Generator, constants: TireConstants, largest: float) -> SensorNoise:
    """Draw the noise of a rig; force noise is 0.25 to 0.7% of the largest force ``largest``, N."""
    force = float(rng.uniform(0.0025, 0.007)) * largest
    sigma = {
        "slip_angle": float(rng.uniform(5e-5, 2.5e-4)),
        "slip_ratio": float(rng.uniform(2e-4, 6e-4)),
        "camber": float(rng.uniform(5e-5, 2e-4)),
        "normal_load": float(rng.uniform(0.001, 0.004)) * constants.nominal_load,
        "speed": float(rng.uniform(0.01, 0.04)),
        "pressure": float(rng.uniform(200.0, 600.0)),
        "tread_temperature": float(rng.uniform(0.2, 0.7)),
        "turn_slip": 2e-4,
        "fy": force,
        "fx": force * float(rng.uniform(0.6, 1.1)),
    }
    colour = {channel: float(rng.uniform(0.3, 0.9)) for channel in sigma}
    return SensorNoise(sigma, colour, float(rng.uniform(0.2, 0.6)))


def add_noise(frame: pd.DataFrame, noise: SensorNoise, rng: np.random.Generator) -> pd.DataFrame:
    """Return the frame with coloured and white noise on every channel but time."""
    out = frame.copy()
    n = len(out)
    for channel in out.columns:
        if channel == "time":
            continue
        rho = noise.colour[channel]
        white = rng.standard_normal(n)
        slow = scipy.signal.lfilter([np.sqrt(1.0 - rho**2)], [1.0, -rho], rng.standard_normal(n))
        share = noise.coloured_share
        total = np.sqrt(1.0 - share) * white + np.sqrt(share) * slow
        out[channel] = out[channel].to_numpy() + noise.sigma[channel] * total
    return out


@dataclass(frozen=True)
class BrushRig:
    """A rig with a brush tire: everything of a case that does not depend on the strengths of its effects."""

    constants: TireConstants
    character: np.ndarray
    slip_sign: float
    details: Mapping[str, ArtefactDetails]
    largest: Mapping[str, float]
    n_bristles: int

    def run(
        self, schedule: pd.DataFrame, strengths: Mapping[str, float], *, time0: float = 0.0
    ) -> pd.DataFrame:
        """Run a schedule; the result is free of noise and artefacts.

        Parameters
        ----------
        schedule : pandas.DataFrame
            ``time`` from 0 and :data:`schedule.CHANNELS`.
        strengths : mapping
            Effect -> strength; artefacts are left for :meth:`with_artefacts`.
        time0 : float
            Time of the first sample on the rig's clock, s.

        Returns
        -------
        pandas.DataFrame
            ``time``, the channels as the rig knows them, ``tread_temperature``, ``fx``, ``fy``,
            ``wear``.
        """
        rows = schedule[list(CHANNELS)].to_numpy(dtype=float).copy()
        known = rows.copy()
        if "backlash" in strengths:
            rows[:, 0] = play(rows[:, 0], strengths["backlash"])
        effects = np.zeros(brush.N_EFFECTS)
        for name, strength in strengths.items():
            if name in IN_BRUSH:
                effects[IN_BRUSH[name]] = strength
        roll = brush.roll_transient if "relaxation_length" in strengths else brush.roll_steady
        time = schedule["time"].to_numpy()
        dt = float(time[1] - time[0])
        out = roll(self.constants.vector(), effects, rows, dt, time0, self.n_bristles)
        fy = out[:, 1]
        for name, strength in strengths.items():
            fy = act_on_forces(
                name,
                strength,
                time=time + time0,
                slip_angle=rows[:, 0],
                normal_load=rows[:, 3],
                speed=rows[:, 4],
                fy=fy,
                character=self.character,
                nominal_load=self.constants.nominal_load,
            )
        frame = pd.DataFrame(known, columns=list(CHANNELS))
        frame.insert(0, "time", time + time0)
        frame["slip_angle"] *= self.slip_sign
        frame["tread_temperature"] = out[:, 3]
        frame["fx"], frame["fy"], frame["wear"] = out[:, 0], fy, out[:, 4]
        return frame

    def with_artefacts(self, frame: pd.DataFrame, strengths: Mapping[str, float]) -> pd.DataFrame:
        """Return the frame with those of the effects that are artefacts."""
        for name, strength in strengths.items():
            if name in ARTEFACTS:
                frame = apply_artefact(frame, name, strength, self.details[name], self.largest)
        return frame
