"""Runs the equations over tires and points: compiled where possible, else with NumPy, in bounded memory."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from itertools import pairwise

import numpy as np

from tire_pipeline.magic_formula.equations import numpy_form
from tire_pipeline.magic_formula.equations.jit import HAVE_NUMBA
from tire_pipeline.magic_formula.equations.numpy_form import OUTPUTS
from tire_pipeline.magic_formula.parameters.coefficients import are_moderate

if HAVE_NUMBA:
    from tire_pipeline.magic_formula.compiled import kernel

_NUMPY_CHUNK = 8192
"""Points at a time in the NumPy form: its temporaries stay below a few MiB."""
_THREAD_FROM = 30_000
"""Evaluations from which a second thread pays."""
_LARGEST_ANGLE = 1e4
"""Angles beyond this (rad) go to NumPy, whose sine is right for any argument."""

NO_SIGNS = np.ones(2 + len(OUTPUTS))
"""Signs of slip angle, camber and the outputs where points are in ISO W axes."""


def run(
    matrix: np.ndarray,
    family: int,
    points: Sequence[np.ndarray],
    signs: np.ndarray,
    wanted: Sequence[str],
    largest_angle: float,
    turn_slip: np.ndarray | None = None,
) -> np.ndarray:
    """Evaluate tires at points.

    Parameters
    ----------
    matrix : ndarray of shape (tires, len(COEFFICIENT_NAMES))
        Packed coefficients.
    family : {5, 6}
    points : six ndarrays of shape (tires, points)
        Slip angle, slip ratio, camber, load, speed, pressure; any strides, 0 too.
    signs : ndarray of shape (14,)
        Factors for slip angle, camber and the twelve outputs.
    wanted : sequence of str
        Names from ``OUTPUTS``.
    largest_angle : float
        The largest magnitude of slip angle and camber.
    turn_slip : ndarray of shape (tires, points), optional
        ISO sign; only the NumPy form supports it.

    Returns
    -------
    ndarray of shape (tires, len(wanted), points)
    """
    compiled = np.zeros(len(matrix), dtype=bool)
    if turn_slip is None and largest_angle <= _LARGEST_ANGLE:
        compiled = compiles(matrix)
    tires, count = points[0].shape
    out = np.empty((tires, len(wanted), count))
    if compiled.any() and not compiled.all():  # a tire's forces do not depend on the other tires
        for part in (compiled, ~compiled):
            some = [values[part] for values in points]
            out[part] = run(matrix[part], family, some, signs, wanted, largest_angle)
        return out
    rows = np.full(len(OUTPUTS), -1)
    for row, name in enumerate(wanted):
        rows[OUTPUTS.index(name)] = row
    if compiled.all():
        _run_compiled(matrix, family, points, signs, rows, out)
    else:
        _run_numpy(matrix, family, points, signs, rows, out, turn_slip)
    return out


def compiles(matrix: np.ndarray) -> np.ndarray:
    """Return for each tire whether compiled code exists and is valid for its coefficients."""
    return are_moderate(matrix) & HAVE_NUMBA


def run_point(vector: np.ndarray, family: int, point: Sequence[float]) -> tuple[float, ...]:
    """Evaluate one tire at one point (ISO signs) with compiled code: the twelve outputs, quickly."""
    return kernel.point_function(family)(vector, *point)


def _run_compiled(matrix, family, points, signs, rows, out):
    chosen = 0 if (rows[2:] < 0).all() else 1 if (rows[[2, 3, *range(5, 12)]] < 0).all() else 2
    function = kernel.kernel_for(family, chosen)
    threads = thread_count() if out.shape[0] * out.shape[2] >= _THREAD_FROM else 1
    if threads == 1:
        function(matrix, *points, signs, rows, out)
        return
    if out.shape[0] >= threads:
        cuts = np.linspace(0, out.shape[0], threads + 1).astype(int)
        parts = [(slice(a, b), slice(None)) for a, b in pairwise(cuts)]
    else:
        cuts = np.linspace(0, out.shape[2], threads + 1).astype(int)
        parts = [(slice(None), slice(a, b)) for a, b in pairwise(cuts)]
    jobs = [
        _pool(threads).submit(
            function,
            matrix[of_tires],
            *(x[of_tires, of_points] for x in points),
            signs,
            rows,
            out[of_tires, :, of_points],
        )
        for of_tires, of_points in parts
    ]
    for job in jobs:
        job.result()


def _run_numpy(matrix, family, points, signs, rows, out, turn_slip):
    for t, vector in enumerate(matrix):
        for start in range(0, out.shape[2], _NUMPY_CHUNK):
            part = slice(start, min(start + _NUMPY_CHUNK, out.shape[2]))
            alpha, kappa, gamma, *others = (x[t, part] for x in points)
            turn = None if turn_slip is None else turn_slip[t, part]
            results = numpy_form.evaluate(
                vector, family, alpha * signs[0], kappa, gamma * signs[1], *others, turn
            )
            for k, row in enumerate(rows):
                if row >= 0:
                    out[t, row, part] = results[k] * signs[2 + k]


def thread_count() -> int:
    """Return the number of threads for large inputs: ``NUMBA_NUM_THREADS``, or the cores at hand."""
    given = os.environ.get("NUMBA_NUM_THREADS", "")
    if given.isdigit() and int(given) > 0:
        return int(given)
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@lru_cache(maxsize=4)
def _pool_of(threads: int, process: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads, thread_name_prefix="magic_formula")


def _pool(threads: int) -> ThreadPoolExecutor:
    # threads do not survive a fork, so each process has its own
    return _pool_of(threads, os.getpid())
