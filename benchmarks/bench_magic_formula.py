"""The compiled Magic Formula beside the straightforward NumPy form of the same equations, in one run.

    python benchmarks/bench_magic_formula.py [--large] [--json FILE]

Prints, for 1, 1e3, 1e5 (and 1e7 with --large) points: the time of both and their ratio, on one thread and on
two; that of a bare compiled loop that only calls sin, cos and arctan as often as the equations do; the peak
of memory beyond inputs and outputs; and the cost of Jacobians in evaluations. The equations are those of MF
5.2 and 6.1, for Fx, Fy and Mz.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
import time
import tracemalloc
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "magic_formula"))

import numpy as np
from magic_formula_tires import tire_52, tire_61
from numba import njit

from tire_pipeline.magic_formula.derivatives import derive
from tire_pipeline.magic_formula.derivatives.gradients import gradients_of
from tire_pipeline.magic_formula.equations import equations_52, equations_61
from tire_pipeline.magic_formula.parameters.coefficients import Coefficients

WANTED = ("fx", "fy", "mz")
TIRES = {"5.2": tire_52(), "6.1": tire_61()}


def best(function, least_seconds=0.5, most=2000):
    """Return the shortest of repeated times: others' work on the machine only ever adds."""
    function()
    times, start = [], time.perf_counter()
    while len(times) < 3 or (time.perf_counter() - start < least_seconds and len(times) < most):
        begin = time.perf_counter()
        function()
        times.append(time.perf_counter() - begin)
    return min(times)


def points(count):
    rng = np.random.default_rng(0)
    return {
        "slip_angle": rng.uniform(-0.3, 0.3, count),
        "slip_ratio": rng.uniform(-0.5, 0.5, count),
        "camber": rng.uniform(-0.1, 0.1, count),
        "normal_load": rng.uniform(500, 9000, count),
        "speed": rng.uniform(5, 50, count),
        "pressure": rng.uniform(1.8e5, 2.6e5, count),
    }


def calls_of(family):
    """Count the sines, cosines and arctangents that Fx, Fy and Mz take, from the traced equations."""
    outputs = derive.traced(family)
    needed = derive.needed([outputs[0], outputs[1], outputs[4]])
    return {name: sum(y.operation == name for y in needed) for name in ("sin", "cos", "arctan")}


def bare_loop(calls):
    """Return a compiled loop that makes these calls a point, and nothing else."""
    sines, cosines, arctangents = calls["sin"], calls["cos"], calls["arctan"]

    @njit(fastmath={"contract"}, error_model="numpy")
    def loop(x, out):
        for i in range(x.size):
            total = 0.0
            for k in range(sines):
                total += np.sin(x[i] + k)
            for k in range(cosines):
                total += np.cos(x[i] + k)
            for k in range(arctangents):
                total += np.arctan(x[i] + k)
            out[i] = total

    return loop


def straightforward(tire, given):
    """Evaluate Fx, Fy and Mz with whole NumPy arrays, function by function."""
    p = Coefficients(*tire.packed.tolist())
    alpha, kappa, gamma, fz, _, pressure = given.values()
    fz0 = p.FNOMIN * p.LFZO
    dfz = (fz - fz0) / fz0
    if tire.family == 5:
        q, extra = equations_52, ()
        fx0, _, kx, _, _ = q.pure_longitudinal(p, kappa, gamma, fz, dfz)
        fy0, muy, ky, shy, svy, by_cy = q.pure_lateral(p, alpha, gamma, fz, dfz, fz0)
        fx = q.combined_longitudinal(p, fx0, alpha, kappa, dfz)
        fy, svyk = q.combined_lateral(p, fy0, muy, alpha, kappa, gamma, fz, dfz)
        fy_prime, more = fy - svyk, ()
    else:
        q, zetas = equations_61, equations_61.NO_TURN_SLIP
        dpi = (pressure - p.NOMPRES) / p.NOMPRES
        fx0, _, kx = q.pure_longitudinal(p, kappa, gamma, fz, dfz, dpi, zetas)
        fy0, muy, ky, shy, svy, by_cy = q.pure_lateral(p, alpha, gamma, fz, dfz, dpi, fz0, zetas)
        fx = fx0 * q.longitudinal_weight(p, alpha, kappa, gamma, dfz)
        gyk = q.lateral_weight(p, alpha, kappa, gamma, dfz)
        fy = fy0 * gyk + q.slip_ratio_side_force(p, muy, alpha, kappa, gamma, fz, dfz, 1.0)
        fy_prime = gyk * q.pure_lateral(p, alpha, 0.0 * gamma, fz, dfz, dpi, fz0, zetas)[0]
        extra, more = (dpi,), (1.0, zetas)
    ratio = kx / ky
    trail = q.pneumatic_trail(p, alpha, ratio, kappa, gamma, fz, dfz, *extra, *more)
    alpha_r = alpha + shy + svy / ky
    mzr = q.residual_torque(p, alpha, alpha_r, ratio, kappa, gamma, fz, dfz, *extra, by_cy, *more)
    arm = (p.SSZ1 + p.SSZ2 * fy / p.FNOMIN + (p.SSZ3 + p.SSZ4 * dfz) * gamma) * p.UNLOADED_RADIUS * p.LS
    return fx, fy, -trail * fy_prime + mzr + arm * fx


def check(version):
    """Stop if the two forms do not give the same."""
    tire, given = TIRES[version], points(1000)
    forces = tire.forces(**given, outputs=WANTED)
    for name, value in zip(WANTED, straightforward(tire, given), strict=True):
        np.testing.assert_allclose(getattr(forces, name), value, rtol=1e-9, atol=1e-9 * np.abs(value).max())


def compare(version, count, least):
    check(version)
    tire, given = TIRES[version], points(count)
    call = dict(given) if count > 1 else {name: float(x[0]) for name, x in given.items()}
    result = {"version": version, "points": count}
    for threads in (1, 2):
        os.environ["NUMBA_NUM_THREADS"] = str(threads)
        seconds = best(lambda: tire.forces(**call, outputs=WANTED), least)
        result[f"compiled_{threads}_us"] = 1e6 * seconds
    result["numpy_us"] = 1e6 * best(lambda: straightforward(tire, given), least)
    x, out = np.ascontiguousarray(given["slip_angle"]), np.empty(count)
    loop = bare_loop(calls_of(tire.family))
    result["bare_us"] = 1e6 * best(lambda: loop(x, out), least)
    result["times_numpy_1"] = result["numpy_us"] / result["compiled_1_us"]
    result["two_threads"] = result["compiled_1_us"] / result["compiled_2_us"]
    result["share_of_bare"] = result["bare_us"] / result["compiled_1_us"]
    return result


def jacobian_cost(version, count=4000):
    """Return the cost of derivatives over all coefficients of an output, in evaluations of that output."""
    os.environ["NUMBA_NUM_THREADS"] = "1"
    return {output: one_jacobian_cost(TIRES[version], output, count) for output in WANTED}


def one_jacobian_cost(tire, output, count):
    given = points(count)
    names = gradients_of(tire.family).OVER[output]
    space = {output: np.empty((len(names), count))}
    derivatives = best(lambda: tire.jacobian(names, **given, outputs=(output,), out=space))
    value = best(lambda: tire.forces(**given, outputs=(output,)))
    return {"coefficients": len(names), "evaluations": derivatives / value}


def memory(count):
    """Return the peak of what Python and NumPy allocate during a call, beyond its outputs (MiB)."""
    tire = TIRES["5.2"]
    given = {
        name: np.full(count, value) for name, value in zip(points(1), (0.1, 0.02, 0.01, 3e3), strict=False)
    }
    tire.forces(**{name: x[:100] for name, x in given.items()}, outputs=WANTED)
    tracemalloc.start()
    forces = tire.forces(**given, outputs=WANTED)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return (peak - sum(getattr(forces, name).nbytes for name in WANTED)) / 2**20


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--large", action="store_true", help="1e7 points too")
    parser.add_argument("--json", type=Path, help="write the figures here as well")
    options = parser.parse_args()
    counts = [1, 1000, 100_000] + ([10_000_000] if options.large else [])
    machine = (
        f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}"
    )
    print(machine)
    print("version  points   compiled us  two threads    NumPy us  x NumPy  x by two  share of bare loop")
    rows = []
    for version in TIRES:
        for count in counts:
            r = compare(version, count, 0.5 if count < 1e6 else 0.0)
            rows.append(r)
            print(
                f"{version:>7} {count:>8} {r['compiled_1_us']:>12.4g} {r['compiled_2_us']:>12.4g} "
                f"{r['numpy_us']:>11.4g} {r['times_numpy_1']:>8.3g} {r['two_threads']:>9.3g} "
                f"{r['share_of_bare']:>10.3g}"
            )
    jacobians = {version: jacobian_cost(version) for version in TIRES}
    for version, found in jacobians.items():
        for output, r in found.items():
            cost = f"{r['evaluations']:.2f} evaluations"
            print(f"{version} Jacobian of {output} over {r['coefficients']} coefficients: {cost}")
    largest = counts[-1]
    extra = memory(largest)
    print(f"memory beyond inputs and outputs at {largest} points: {extra:.1f} MiB")
    if options.json:
        result = {"machine": machine, "rows": rows, "jacobians": jacobians, "extra_mib": extra}
        options.json.write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
