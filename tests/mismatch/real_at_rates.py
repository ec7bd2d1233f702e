"""Real and simulated recordings at 2 to 500 Hz: what is explained, and sweeps that no fit has seen."""

from __future__ import annotations

import warnings
from functools import cache

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared

from tire_pipeline.concealed.real.sources import Sweep, sweeps
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch

RATES = (2, 5, 20, 100, 500)
"""Hz. Recordings of 100 Hz are averaged to fewer, and brought to 500 by straight lines, as loggers do."""

FIT = ["slip_angle", "normal_load", "fy"]
INPUTS = ("slip_angle", "slip_ratio", "camber", "normal_load", "speed", "pressure")
LOADS = (800.0, 1350.0, 1900.0, 2450.0)
"""Between the five levels of calspan, N."""

LEFT_OUT = (2, 4)


@cache
def real(source: str) -> tuple[Sweep, ...]:
    shared(f"recordings/{source}")
    return sweeps(shared("recordings"), source)


def at_rate(frame: pd.DataFrame, rate: float) -> pd.DataFrame:
    """One uninterrupted piece at another rate."""
    time = frame["time"].to_numpy()
    now = 1.0 / np.median(np.diff(time))
    if rate < 0.99 * now:
        count = round(now / rate)
        rows = len(frame) // count * count
        mean = frame.iloc[:rows].to_numpy().reshape(-1, count, frame.shape[1]).mean(axis=1)
        return pd.DataFrame(mean, columns=frame.columns)
    if rate > 1.01 * now:
        stamps = np.arange(time[0], time[-1], 1.0 / rate)
        return pd.DataFrame({n: np.interp(stamps, time, frame[n]) for n in frame}).assign(time=stamps)
    return frame


def joined(parts, rate: float) -> pd.DataFrame:
    return pd.concat([at_rate(part.frame, rate) for part in parts], ignore_index=True)


def flat_belt(rate: float, hidden: str = "nothing") -> tuple[TireModel, pd.DataFrame, pd.DataFrame]:
    """A fit to 82 kPa without camber; three loads of what is hidden from it; the two other loads."""
    chosen = [s for s in real("calspan") if _leans(s) == ("camber" in hidden)]
    chosen = [s for s in chosen if _low(s) == ("pressure" in hidden)]
    held = [int(np.searchsorted(LOADS, s.load)) in LEFT_OUT for s in chosen]
    given = [s for s, left in zip(chosen, held, strict=True) if not left]
    unseen = [s for s, left in zip(chosen, held, strict=True) if left]
    return belt_tire(rate), joined(given, rate), joined(unseen, rate)


@cache
def belt_tire(rate: float) -> TireModel:
    known = [s for s in real("calspan") if not _leans(s) and not _low(s)]
    return fit_magic_formula(joined(known, rate)[FIT]).model


def _leans(sweep: Sweep) -> bool:
    return sweep.camber > 0.01


def _low(sweep: Sweep) -> bool:
    return sweep.pressure < 76e3


def drives(session: str) -> list[Sweep]:
    return [s for s in real("dart") if s.name.startswith(session)]


@cache
def car_tire(rate: float) -> TireModel:
    """A fit to every second drive on the rubber floor."""
    return fit_magic_formula(joined(drives("rubber")[::2], rate)[FIT]).model


def second_session(rate: float, fitted: int) -> tuple[TireModel, pd.DataFrame, pd.DataFrame]:
    """One drive of the second session, and the other."""
    given, unseen = (at_rate(drives("second")[i].frame, rate) for i in (fitted, 1 - fitted))
    return car_tire(rate), given, unseen


def free_drive(rate: float) -> tuple[TireModel, pd.DataFrame, pd.DataFrame]:
    """The first half of the free drive, and the second."""
    whole = at_rate(drives("free")[0].frame, rate)
    half = len(whole) // 2
    return car_tire(rate), whole.iloc[:half], whole.iloc[half:].reset_index(drop=True)


def points() -> tuple[TireModel, pd.DataFrame, pd.DataFrame]:
    """A fit to the points without camber; 60% of the cambered ones; the others."""
    table = pd.concat([s.frame for s in real("tydex")], ignore_index=True)
    flat = table["camber"].abs() < 0.002
    held = ~flat & (np.random.default_rng(0).random(len(table)) < 0.4)
    tire = fit_magic_formula(table[flat][["slip_angle", "camber", "normal_load", "fy"]]).model
    return tire, table[~held].reset_index(drop=True), table[held].reset_index(drop=True)


def forces(tire: TireModel, recording: pd.DataFrame, output: str = "fy") -> np.ndarray:
    """What ``tire.forces`` gives at the recorded rows."""
    channels = {n: recording[n].to_numpy() for n in INPUTS if n in recording}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        out = tire.forces(**channels, limits="ignore", outputs=("fx", "fy"))
    return np.asarray(getattr(out, output), float)


def rms(x) -> float:
    return float(np.sqrt(np.mean(np.square(np.asarray(x, float)))))


def simulated(tire, rate, friction, seed):
    """The small rig at another rate, with another friction: a run to explain, and another one."""
    parts = []
    for run in (seed, seed + 100):
        rng = np.random.default_rng(run)
        t = np.arange(0.0, 150.0, 1.0 / rate)
        slip = 0.18 * np.sin(2.0 * np.pi * t / 7.5 + run)
        load = np.array([3000.0, 5500.0, 1800.0, 4200.0])[(t // 15.0).astype(int) % 4]
        fy = friction * tire.forces(slip_angle=slip / friction, normal_load=load).fy
        channels = {"time": t, "slip_angle": slip + rng.normal(0.0, 1e-4, t.size)}
        channels |= {"normal_load": load + rng.normal(0.0, 8.0, t.size)}
        channels["fy"] = fy + rng.normal(0.0, 25.0, t.size)
        parts.append(pd.DataFrame(channels))
    return tire, *parts


def check_before(tire, given, report):
    """The error before is what ``tire.forces`` leaves; so is that after, if nothing is in."""
    for output, fit in report.fit.items():
        if output not in ("fx", "fy"):
            continue
        plain = forces(tire, given, output)
        assert fit.rms_before == pytest.approx(rms(given[output] - plain), rel=1e-9)
        came = report.corrected.as_it_came.predict(given)[output]
        np.testing.assert_allclose(came, plain, rtol=1e-9, atol=1e-9 * np.abs(plain).max())
        if not report.effects and (report.unnamed is None or report.unnamed.physics is None):
            now = report.corrected.predict(given)[output]
            np.testing.assert_allclose(now, plain, rtol=1e-9, atol=1e-9 * np.abs(plain).max())
            assert fit.rms_after == fit.rms_before


def check_unseen(tire, given, unseen):
    report = explain_mismatch(tire, given)
    check_before(tire, given, report)
    for output in set(report.fit) & {"fx", "fy"}:
        assert report.fit[output].rms_after <= report.fit[output].rms_before
        after = rms(unseen[output] - report.corrected.predict(unseen)[output])
        assert after <= rms(unseen[output] - forces(tire, unseen, output)) * (1.0 + 1e-9), report
    return report
