"""What `explain_mismatch` makes of the two real recordings, and of artefacts put into them.

Run: python benchmarks/real_recordings.py [tydex] [dart] [artefacts]

The recordings are those of ../shared/recordings (data/01_raw/recordings/README.md says where they are
published). docs/history/mismatch.md holds what this prints; tests/mismatch/real_recordings use
its parts.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import MismatchReport, explain_mismatch
from tire_pipeline.recordings import DART_CAR, axle_recording, read_dart, read_recording

RECORDINGS = Path(__file__).resolve().parents[2] / "shared" / "recordings"
FLAT = 0.002
INPUTS = ("slip_angle", "slip_ratio", "camber", "normal_load")
AXLE = ["slip_angle", "normal_load", "fy"]
Change = Callable[[pd.DataFrame], pd.DataFrame]


def rms(x: np.ndarray) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.asarray(x, float) ** 2)))


def error(tire: TireModel, recording: pd.DataFrame, name: str = "fy") -> float:
    """RMS of recorded minus simulated force, N."""
    inputs = {c: recording[c].to_numpy() for c in INPUTS if c in recording}
    return rms(recording[name].to_numpy() - getattr(tire.forces(**inputs, limits="ignore"), name))


def names(report: MismatchReport) -> list[str]:
    """Names of the effects found."""
    return [e.name for e in report.effects]


# TYDEX


@cache
def tydex() -> pd.DataFrame:
    """All points of the published TYDEX file."""
    return read_recording(RECORDINGS / "tydex" / "DT_195_65R15_demo.tdx")


def flat_points() -> np.ndarray:
    """Which points have no camber."""
    return tydex()["camber"].abs().to_numpy() < FLAT


@cache
def tydex_tire(flat: bool = True, half: int | str | None = None) -> TireModel:
    """Fit to the points at zero camber or to all, to the whole or to a half."""
    points = tydex_part(flat, half, True)
    return fit_magic_formula(points[["slip_angle", "camber", "normal_load", "fy"]]).model


def tydex_part(flat: bool, half: int | str | None, first: bool) -> pd.DataFrame:
    """Points at zero camber or all of them; a half of these (random, or "even", "odd"), or the other."""
    points = tydex()[flat_points()] if flat else tydex()
    if half is None:
        return points
    if isinstance(half, str):
        chosen = np.arange(len(points)) % 2 == ("even", "odd").index(half)
    else:
        chosen = np.random.default_rng(half).permutation(len(points)) < len(points) // 2
    return points[chosen if first else ~chosen]


def tydex_held(seed: int) -> np.ndarray:
    """Which of the cambered points are held out: 40% of them, at random."""
    return ~flat_points() & (np.random.default_rng(seed).random(len(tydex())) < 0.4)


def tydex_refit(seed: int) -> float:
    """Error on the held-out points of a whole formula that is fitted to all others."""
    held = tydex_held(seed)
    points = tydex()[["slip_angle", "camber", "normal_load", "fy"]]
    return error(fit_magic_formula(points[~held]).model, tydex()[held])


@cache
def tydex_camber(seed: int = 0) -> tuple[MismatchReport, float, float]:
    """Explain all but 40% of the cambered points; errors before and after on these 40%."""
    held = tydex_held(seed)
    report = explain_mismatch(tydex_tire(), tydex()[~held])
    rest = tydex()[held]
    after = rms(rest["fy"].to_numpy() - report.corrected.predict(rest)["fy"].to_numpy())
    return report, error(tydex_tire(), rest), after


def tydex_halves(half: int | str) -> MismatchReport:
    """Fit to a half of the 37 points at zero camber, explain the others."""
    return explain_mismatch(tydex_tire(True, half), tydex_part(True, half, False))


# DART


@cache
def drives(session: str, min_speed: float | None = None) -> tuple[pd.DataFrame, ...]:
    """Rear axle of each drive of a session."""
    files = sorted((RECORDINGS / "dart" / session).glob("*.csv"))
    return tuple(axle_recording(read_dart(f), DART_CAR, min_speed=min_speed) for f in files)


def joined(parts: tuple[pd.DataFrame, ...]) -> pd.DataFrame:
    """Drives one after the other, five seconds apart."""
    out, end = [], 0.0
    for part in parts:
        part = part.assign(time=part["time"] - part["time"].iloc[0] + end)
        end = float(part["time"].iloc[-1]) + 5.0
        out.append(part)
    return pd.concat(out, ignore_index=True)


@cache
def dart_tire(half: int = 0, min_speed: float | None = None) -> TireModel:
    """Fit the rear axle to every second drive on the rubber floor."""
    train = joined(drives("rubber_floor_ramps", min_speed)[half::2])
    return fit_magic_formula(train[AXLE]).model


def dart_other_half(half: int = 0, min_speed: float | None = None) -> tuple[MismatchReport, pd.DataFrame]:
    """Explain the drives that the model was not fitted to."""
    other = joined(drives("rubber_floor_ramps", min_speed)[1 - half :: 2])
    return explain_mismatch(dart_tire(half, min_speed), other), other


@cache
def dart_repair(
    fitted: int, half: int = 0, min_speed: float | None = None
) -> tuple[MismatchReport, float, float]:
    """Explain one drive of the second session; errors before and after on the other."""
    session, tire = drives("second_session", min_speed), dart_tire(half, min_speed)
    report = explain_mismatch(tire, session[fitted])
    other = session[1 - fitted]
    after = rms(other["fy"].to_numpy() - report.corrected.predict(other)["fy"].to_numpy())
    return report, error(tire, other), after


@cache
def dart_refit(fitted: int, on: int, min_speed: float | None = None) -> float:
    """Error on one drive of the second session of a whole formula fitted to the other, or to the same."""
    session = drives("second_session", min_speed)
    return error(fit_magic_formula(session[fitted][AXLE]).model, session[on])


# Artefacts


def stuck(r: pd.DataFrame) -> pd.DataFrame:
    """The force stands still over a tenth of the recording."""
    a, b = int(0.4 * len(r)), int(0.5 * len(r))
    force = r["fy"].to_numpy().copy()
    force[a:b] = force[a]
    return r.assign(fy=force)


def delayed(r: pd.DataFrame, seconds: float) -> pd.DataFrame:
    """The force comes later."""
    force = np.interp(r["time"] - seconds, r["time"], r["fy"])
    return r.assign(fy=force)


def largest(r: pd.DataFrame) -> float:
    """Largest force, N."""
    return float(r["fy"].abs().quantile(0.99))


ARTEFACTS: dict[str, tuple[Change, tuple[str, ...], bool]] = {
    "slip angle in degrees": (
        lambda r: r.assign(slip_angle=np.degrees(r["slip_angle"])),
        ("unit_error",),
        False,
    ),
    "load in lbf": (lambda r: r.assign(normal_load=r["normal_load"] / 4.4482216), ("unit_error",), False),
    "force in lbf": (lambda r: r.assign(fy=r["fy"] / 4.4482216), ("unit_error",), False),
    "force in kN": (lambda r: r.assign(fy=r["fy"] / 1000.0), ("unit_error",), False),
    "force mirrored": (lambda r: r.assign(fy=-r["fy"]), ("sign_convention",), False),
    "slip angle mirrored": (lambda r: r.assign(slip_angle=-r["slip_angle"]), ("sign_convention",), False),
    "slip angle off by 1.5 deg": (
        lambda r: r.assign(slip_angle=r["slip_angle"] + np.radians(1.5)),
        ("slip_angle_offset",),
        False,
    ),
    "force too large by 30%": (lambda r: r.assign(fy=1.3 * r["fy"]), ("force_gain",), False),
    "force off by 15% of the largest": (
        lambda r: r.assign(fy=r["fy"] + 0.15 * largest(r)),
        ("force_offset",),
        False,
    ),
    "force cut at half of the largest": (
        lambda r: r.assign(fy=r["fy"].clip(-0.5 * largest(r), 0.5 * largest(r))),
        ("clipping",),
        False,
    ),
    "force stuck for a tenth": (stuck, ("stuck_channel",), True),
    "force 1 s late": (lambda r: delayed(r, 1.0), ("time_delay", "low_pass"), True),
    "force drifts by 20% of the largest": (
        lambda r: r.assign(fy=r["fy"] + 0.2 * largest(r) * (r["time"] - r["time"].min()) / np.ptp(r["time"])),
        ("sensor_drift",),
        True,
    ),
}
"""What is done -> how, the artefacts' names that are right, whether it needs a time line."""


def injected(which: str) -> Iterator[tuple[str, tuple[str, ...], MismatchReport]]:
    """Put each artefact into a real recording that has none, and explain it."""
    for what in ARTEFACTS:
        if which == "dart" or not ARTEFACTS[what][2]:
            yield what, ARTEFACTS[what][1], explain_mismatch(*with_artefact(which, what))


def with_artefact(which: str, what: str) -> tuple[TireModel, pd.DataFrame]:
    """A model, and the half that it was not fitted to, with one artefact."""
    change = ARTEFACTS[what][0]
    if which == "dart":
        return dart_tire(0), change(joined(drives("rubber_floor_ramps")[1::2]))
    return tydex_tire(False, 0), change(tydex_part(False, 0, False))


def physics(report: MismatchReport) -> list[str]:
    """Names of the physical effects found."""
    return [e.name for e in report.effects if e.kind == "physics"]


def told(report: MismatchReport) -> str:
    """Verdict and names in one line."""
    found = [
        e.name + (f" (or {', '.join(e.alternatives)})" if e.alternatives else "") for e in report.effects
    ]
    return f"{report.verdict}: {', '.join(found) or 'no effect'}"


def main() -> None:
    parts = sys.argv[1:] or ["tydex", "dart", "artefacts"]
    if "tydex" in parts:
        for seed in range(5):
            report, before, after = tydex_camber(seed)
            print(
                f"TYDEX camber, held-out points {seed}: {before:.0f} N -> {after:.0f} N (the whole formula "
                f"refitted: {tydex_refit(seed):.0f} N), {told(report)}",
                flush=True,
            )
        draws = [tydex_camber(seed)[1:] for seed in range(20)]
        before, after = (rms(np.array(column)) for column in zip(*draws, strict=True))
        print(f"TYDEX camber, 20 draws together: {before:.0f} N -> {after:.0f} N", flush=True)
        report = explain_mismatch(tydex_tire(), tydex()[~flat_points()])
        f = report.fit["fy"]
        print(
            f"TYDEX camber, all cambered points, each held out once: {f.rms_before:.0f} N -> "
            f"{f.rms_after:.0f} N, {told(report)}",
            flush=True,
        )
        for half in (*range(10), "even", "odd"):
            print(f"TYDEX zero camber, half {half}: {told(tydex_halves(half))}", flush=True)
    if "dart" in parts:
        for min_speed in (None, 1.0):
            print(f"DART, min_speed {min_speed}")
            for half in (0, 1):
                report, other = dart_other_half(half, min_speed)
                f = report.fit["fy"]
                before = error(dart_tire(half, min_speed), other)
                print(
                    f"  fitted to half {half}: other half {before:.3f} N of {largest(other):.2f} N (noise "
                    f"{f.noise_floor:.3f} N, after {f.rms_after:.3f} N), {told(report)}",
                    flush=True,
                )
                for fitted in (0, 1):
                    report, before, after = dart_repair(fitted, half, min_speed)
                    naive, best = (dart_refit(d, 1 - fitted, min_speed) for d in (fitted, 1 - fitted))
                    print(
                        f"  second session, fitted on drive {fitted}: the other's error {before:.3f} -> "
                        f"{after:.3f} N ({100 * (1 - after / before):.0f}% gone; a whole formula refitted: "
                        f"{naive:.3f} N; fitted to the other itself: {best:.3f} N), {told(report)}",
                        flush=True,
                    )
    if "artefacts" in parts:
        for which in ("tydex", "dart"):
            for what, right, report in injected(which):
                ok = bool(set(right) & set(names(report))) and not physics(report)
                print(f"{which}: {what}: {'right' if ok else 'WRONG'}, {told(report)}", flush=True)


if __name__ == "__main__":
    main()
