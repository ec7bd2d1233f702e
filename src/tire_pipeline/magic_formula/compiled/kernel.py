"""One fused, compiled loop over tires and operating points.

Points pass through in blocks that stay in the first-level cache, so the loop needs no memory beyond inputs
and outputs. A kernel is compiled once for a set of outputs and kept on disk.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numba import njit, types

from tire_pipeline.channels import PLANE_FORCES, TANGENTIAL_FORCES
from tire_pipeline.magic_formula.compiled import fast_math as fast_math  # teaches numba the operations
from tire_pipeline.magic_formula.compiled.unpacking import unpack
from tire_pipeline.magic_formula.equations.equations_52 import evaluate_52
from tire_pipeline.magic_formula.equations.equations_61 import (
    NO_TURN_SLIP,
    evaluate_61,
    rolling_load_factor,
)
from tire_pipeline.magic_formula.equations.jit import checksum_with_equations, compiled
from tire_pipeline.magic_formula.equations.numpy_form import OUTPUTS, SATURATION

SAMPLES_TOGETHER = 256
"""Points in a block."""


SETS: tuple[tuple[str, ...], ...] = (TANGENTIAL_FORCES, PLANE_FORCES, OUTPUTS)
"""The sets of outputs that kernels exist for, from the cheapest to the whole."""

_POINT_TABLE = types.Array(types.float64, 2, "A", readonly=True)
_VECTOR = types.Array(types.float64, 1, "C", readonly=True)
_SIGNATURE = types.void(
    types.Array(types.float64, 2, "C", readonly=True),
    _POINT_TABLE,
    _POINT_TABLE,
    _POINT_TABLE,
    _POINT_TABLE,
    _POINT_TABLE,
    _POINT_TABLE,
    _VECTOR,
    types.Array(types.int64, 1, "C", readonly=True),
    types.Array(types.float64, 3, "A"),
)


@lru_cache(maxsize=1)
def _stamp() -> int:
    """Return a number made from the sources of a kernel: part of the key that it is kept under."""
    return int(checksum_with_equations(__name__)[:15], 16)


@lru_cache(maxsize=8)
def kernel_for(family: int, chosen: int) -> Callable[..., Any]:
    """Return the compiled loop of a family (5 or 6) that stores the outputs ``SETS[chosen]``.

    It is called with the packed coefficients (tires, coefficients); slip angle, slip ratio, camber, load,
    speed and pressure, each (tires, points) and of any strides; the signs (slip angle, camber, the twelve
    outputs); the row of ``out`` for each of the twelve outputs, or -1; and ``out`` (tires, rows, points).
    """
    build = _build_52 if family == 5 else _build_61
    return build(_stamp(), chosen >= 1, chosen >= 2)


@njit(error_model="numpy")
def _take_in(w, t, start, m, alpha, kappa, gamma, fz, speed, pressure, signs):
    """Copy one block of inputs, ISO signs applied and magnitudes held below ``SATURATION``."""
    for i in range(m):
        w[i] = min(max(alpha[t, start + i] * signs[0], -SATURATION), SATURATION)
        w[SAMPLES_TOGETHER + i] = min(max(kappa[t, start + i], -SATURATION), SATURATION)
        w[2 * SAMPLES_TOGETHER + i] = min(max(gamma[t, start + i] * signs[1], -SATURATION), SATURATION)
        w[3 * SAMPLES_TOGETHER + i] = min(fz[t, start + i], SATURATION)
        w[4 * SAMPLES_TOGETHER + i] = min(max(speed[t, start + i], -SATURATION), SATURATION)
        w[5 * SAMPLES_TOGETHER + i] = min(max(pressure[t, start + i], -SATURATION), SATURATION)


@njit(error_model="numpy")
def _give_out(w, t, start, m, signs, rows, out):
    """Copy one block of outputs to where they were asked for."""
    for k in range(12):
        row = rows[k]
        if row >= 0:
            for i in range(m):
                out[t, row, start + i] = w[(7 + k) * SAMPLES_TOGETHER + i] * signs[2 + k]


@njit(error_model="numpy", forceinline=True)
def _keep(w, i, loaded, values, moments, others):
    """Store the outputs of one point, 0 where there is no load."""
    w[7 * SAMPLES_TOGETHER + i] = values[0] if loaded else 0.0
    w[8 * SAMPLES_TOGETHER + i] = values[1] if loaded else 0.0
    if moments:
        w[11 * SAMPLES_TOGETHER + i] = values[4] if loaded else 0.0
    if others:
        w[9 * SAMPLES_TOGETHER + i] = values[2] if loaded else 0.0
        w[10 * SAMPLES_TOGETHER + i] = values[3] if loaded else 0.0
        w[12 * SAMPLES_TOGETHER + i] = values[5] if loaded else 0.0
        w[13 * SAMPLES_TOGETHER + i] = values[6] if loaded else 0.0
        w[14 * SAMPLES_TOGETHER + i] = values[7] if loaded else 0.0
        w[15 * SAMPLES_TOGETHER + i] = values[8] if loaded else 0.0
        w[16 * SAMPLES_TOGETHER + i] = values[9] if loaded else 0.0
        w[17 * SAMPLES_TOGETHER + i] = values[10] if loaded else 0.0
        w[18 * SAMPLES_TOGETHER + i] = values[11] if loaded else 0.0


def _build_52(stamp: int, moments: bool, others: bool) -> Callable[..., Any]:
    def forces_52(matrix, alpha, kappa, gamma, fz, speed, pressure, signs, rows, out):
        if stamp < 0:
            return
        w = np.empty(19 * SAMPLES_TOGETHER)
        n = out.shape[2]
        for t in range(out.shape[0]):
            p = unpack(matrix[t])
            for start in range(0, n, SAMPLES_TOGETHER):
                m = min(SAMPLES_TOGETHER, n - start)
                _take_in(w, t, start, m, alpha, kappa, gamma, fz, speed, pressure, signs)
                for i in range(m):
                    load = w[3 * SAMPLES_TOGETHER + i]
                    loaded = not load <= 0.0
                    load = load if loaded else p.FNOMIN
                    values = evaluate_52(
                        p,
                        w[i],
                        w[SAMPLES_TOGETHER + i],
                        w[2 * SAMPLES_TOGETHER + i],
                        load,
                        w[4 * SAMPLES_TOGETHER + i],
                    )
                    _keep(w, i, loaded, values, moments, others)
                _give_out(w, t, start, m, signs, rows, out)

    return compiled(forces_52, _SIGNATURE)


def _build_61(stamp: int, moments: bool, others: bool) -> Callable[..., Any]:
    def forces_61(matrix, alpha, kappa, gamma, fz, speed, pressure, signs, rows, out):
        if stamp < 0:
            return
        w = np.empty(19 * SAMPLES_TOGETHER)
        n = out.shape[2]
        for t in range(out.shape[0]):
            p = unpack(matrix[t])
            per_pascal = 1.0 / p.NOMPRES if p.NOMPRES > 0.0 else 0.0
            for start in range(0, n, SAMPLES_TOGETHER):
                m = min(SAMPLES_TOGETHER, n - start)
                _take_in(w, t, start, m, alpha, kappa, gamma, fz, speed, pressure, signs)
                for i in range(m):
                    w[5 * SAMPLES_TOGETHER + i] = (w[5 * SAMPLES_TOGETHER + i] - p.NOMPRES) * per_pascal
                if others:
                    for i in range(m):
                        load = w[3 * SAMPLES_TOGETHER + i]
                        load = p.FNOMIN if load <= 0.0 else load
                        w[6 * SAMPLES_TOGETHER + i] = rolling_load_factor(
                            p, load, w[5 * SAMPLES_TOGETHER + i]
                        )
                for i in range(m):
                    load = w[3 * SAMPLES_TOGETHER + i]
                    loaded = not load <= 0.0
                    load = load if loaded else p.FNOMIN
                    values = evaluate_61(
                        p,
                        w[i],
                        w[SAMPLES_TOGETHER + i],
                        w[2 * SAMPLES_TOGETHER + i],
                        load,
                        w[4 * SAMPLES_TOGETHER + i],
                        w[5 * SAMPLES_TOGETHER + i],
                        w[6 * SAMPLES_TOGETHER + i] if others else 1.0,
                        NO_TURN_SLIP,
                    )
                    _keep(w, i, loaded, values, moments, others)
                _give_out(w, t, start, m, signs, rows, out)

    return compiled(forces_61, _SIGNATURE)


@lru_cache(maxsize=2)
def point_function(family: int) -> Callable[..., tuple[float, ...]]:
    """Return the compiled function for one point: packed coefficients and six numbers in, twelve out."""
    stamp = _stamp()

    def point_52(c, alpha, kappa, gamma, fz, speed, pressure):
        p = unpack(c)
        loaded = not fz <= 0.0 and stamp > 0
        load = min(fz, SATURATION) if loaded else p.FNOMIN
        values = evaluate_52(p, _held(alpha), _held(kappa), _held(gamma), load, _held(speed))
        return _unloaded(values, loaded)

    def point_61(c, alpha, kappa, gamma, fz, speed, pressure):
        p = unpack(c)
        loaded = not fz <= 0.0 and stamp > 0
        load = min(fz, SATURATION) if loaded else p.FNOMIN
        dpi = (_held(pressure) - p.NOMPRES) / p.NOMPRES if p.NOMPRES > 0.0 else 0.0
        by_load = rolling_load_factor(p, load, dpi)
        values = evaluate_61(
            p, _held(alpha), _held(kappa), _held(gamma), load, _held(speed), dpi, by_load, NO_TURN_SLIP
        )
        return _unloaded(values, loaded)

    numbers = [types.float64] * 6
    signature = types.UniTuple(types.float64, 12)(_VECTOR, *numbers)
    return compiled(point_52 if family == 5 else point_61, signature)


@njit(error_model="numpy", forceinline=True)
def _held(x):
    return min(max(x, -SATURATION), SATURATION)


@njit(error_model="numpy", forceinline=True)
def _unloaded(values, loaded):
    return (
        values[0] if loaded else 0.0,
        values[1] if loaded else 0.0,
        values[2] if loaded else 0.0,
        values[3] if loaded else 0.0,
        values[4] if loaded else 0.0,
        values[5] if loaded else 0.0,
        values[6] if loaded else 0.0,
        values[7] if loaded else 0.0,
        values[8] if loaded else 0.0,
        values[9] if loaded else 0.0,
        values[10] if loaded else 0.0,
        values[11] if loaded else 0.0,
    )
