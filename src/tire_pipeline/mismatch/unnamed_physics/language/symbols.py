"""Symbols of the equations: dimensionless groups of the channels, and the model's forces and slopes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass

import numpy as np

from tire_pipeline.channels import SLIP_AND_LOAD, SLIP_OF_FORCE, TANGENTIAL_FORCES
from tire_pipeline.mismatch.model.channels import least_spread
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate, simulate_moments
from tire_pipeline.mismatch.model.plain_forces import plain_forces
from tire_pipeline.mismatch.model.wheel import way_rolled
from tire_pipeline.mismatch.unnamed_physics.language.grammar import SymbolTable

Array = np.ndarray
SPAN = 20.0
"""degC that one of ``h`` stands for."""
_SLIP_DIFFERENCE = 2e-3
"""rad and 1, to each side: of the slope that a reader of a sidecar repeats."""
_LOAD_DIFFERENCE = 0.01
"""Of the load, to each side: the same."""
MEANING = {
    "s": "tan(slip_angle)",
    "k": "slip_ratio",
    "g": "camber, rad",
    "L": "normal_load / F0",
    "v": "speed / V0",
    "p": "pressure / P0",
    "h": "(tread_temperature - T0) / 20 K",
    "t": "time, s",
    "way": "way rolled since the first sample, m: at the mean |speed| of each two neighbours",
    "fx": "longitudinal force of the tire model with the named effects in full, N",
    "fy": "lateral force of the same, N",
    "mz": "aligning moment of the same, N m",
    "fx_slip": "d fx / d slip_ratio of the tire model as it came, N (central difference, step 0.002)",
    "fy_slip": "d fy / d slip_angle of the tire model as it came, N/rad (central difference, step 0.002 rad)",
    "fx_load": "normal_load d fx / d normal_load of the model as it came, N (central difference, step 1%)",
    "fy_load": "normal_load d fy / d normal_load of the model as it came, N (central difference, step 1%)",
    "F0": "nominal load, N",
    "R0": "radius, m",
    "V0": "nominal speed, m/s",
}
CHANNEL = {
    "s": "slip_angle",
    "k": "slip_ratio",
    "g": "camber",
    "L": "normal_load",
    "v": "speed",
    "p": "pressure",
    "h": "tread_temperature",
    "t": "time",
}
"""Symbol -> the channel that it is of."""


def held_within(symbol: str, x: Array) -> float:
    """Spread, in the symbol's unit, within which its channel counts as held."""
    return least_spread(CHANNEL[symbol], x) / (SPAN if symbol == "h" else 1.0)


@dataclass(frozen=True)
class NominalValues:
    """What the groups are made dimensionless with: N, m, m/s, Pa, degC."""

    F0: float
    R0: float
    V0: float
    P0: float
    T0: float


def table_of(
    data: Data,
    changes: Sequence[Change],
    nominal: NominalValues | None = None,
    moments: Sequence[str] = (),
) -> tuple[SymbolTable, NominalValues]:
    """Return the symbols at the samples of a recording.

    Parameters
    ----------
    data : Data
    changes : sequence of (name, parameters)
        Effects that are in.
    nominal : NominalValues, optional
        As another recording was explained with; taken from this one if left out.
    moments : sequence of str
        Moments that an equation may use, too.
    """
    nominal = _nominal(data) if nominal is None else nominal
    forces = simulate(data, changes) | (simulate_moments(data, changes, moments) if moments else {})
    columns = {**forces, **_slopes(data)}
    way = data.wheel.known_way
    return table_from(data.channels, data.time, data.start, columns, nominal, way), nominal


def table_from(
    channels: Mapping[str, Array],
    time: Array | None,
    start: Array,
    forces: Mapping[str, Array],
    nominal: NominalValues,
    rolled: Array | None = None,
) -> SymbolTable:
    """Return the symbols of channels in SI; one that was not recorded has none.

    ``rolled`` is the way since the first sample of the recording that was explained, m, shape (n,), if that
    is another one. Where it is NaN nobody knows it, and an equation in it is left out.
    """
    step = np.zeros(start.size)
    if time is not None:
        step[1:] = np.maximum(np.diff(time), 0.0)
        step[start] = 0.0
    way = step * np.abs(channels["speed"]) if "speed" in channels else np.zeros(start.size)
    columns = {**forces, **asdict(nominal)}
    columns = {n: np.broadcast_to(np.asarray(x, float), start.shape) for n, x in columns.items()}
    of: dict[str, tuple[str, Callable[[Array], Array]]] = {
        "s": ("slip_angle", np.tan),
        "k": ("slip_ratio", np.asarray),
        "g": ("camber", np.asarray),
        "L": ("normal_load", lambda x: x / nominal.F0),
        "v": ("speed", lambda x: x / nominal.V0),
        "p": ("pressure", lambda x: x / nominal.P0),
        "h": ("tread_temperature", lambda x: (x - nominal.T0) / SPAN),
    }
    for symbol, (name, group) in of.items():
        if name in channels:
            columns[symbol] = group(channels[name])
    if time is not None:
        columns["t"] = time
        if "speed" in channels:
            columns["way"] = np.nan_to_num(way_rolled(channels["speed"], time) if rolled is None else rolled)
    return SymbolTable(columns, step, way, start)


def _nominal(data: Data) -> NominalValues:
    def middle(name: str, otherwise: float) -> float:
        return float(np.median(data.channels[name])) if name in data.present else otherwise

    return NominalValues(
        F0=data.nominal.load,
        R0=data.nominal.radius,
        V0=abs(float(data.nominal.speed)) or 1.0 if "speed" in data.present else 1.0,
        P0=float(data.nominal.pressure) if "pressure" in data.present else 1.0,
        T0=round(middle("tread_temperature", 0.0), 1),
    )


def _slopes(data: Data) -> dict[str, Array]:
    """The tire model's own slopes along the recording."""
    names = SLIP_AND_LOAD
    speed, pressure = data.nominal.model_speed, data.nominal.model_pressure

    def at(**moved: Array) -> dict[str, Array]:
        points = {**{n: data.get(n) for n in names}, **moved}
        return plain_forces(data.tire, **points, speed=speed, pressure=pressure)

    out = {}
    for force in TANGENTIAL_FORCES:
        slip = SLIP_OF_FORCE[force]
        up, down = (at(**{slip: data.get(slip) + sign * _SLIP_DIFFERENCE})[force] for sign in (1.0, -1.0))
        out[f"{force}_slip"] = (up - down) / (2.0 * _SLIP_DIFFERENCE)
    load = data.get("normal_load")
    up_load, down_load = (at(normal_load=load * (1.0 + sign * _LOAD_DIFFERENCE)) for sign in (1.0, -1.0))
    for force in TANGENTIAL_FORCES:
        out[f"{force}_load"] = (up_load[force] - down_load[force]) / (2.0 * _LOAD_DIFFERENCE)
    return out
