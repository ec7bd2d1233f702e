"""The report of a mismatch: verdict, effects, fit, and what to record next."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from tire_pipeline.mismatch.corrected import CorrectedModel
from tire_pipeline.mismatch.locate import Located

VERDICTS = ("agrees", "explained", "ambiguous", "partly explained", "unexplained")


@dataclass(frozen=True)
class EffectReport:
    """One effect that was found.

    Parameters
    ----------
    name, kind : str
        ``kind`` is ``"physics"`` or ``"artefact"``.
    alternatives : tuple of str
        Names that the data cannot exclude.
    confidence : float
        Probability that the cause is the name or one of its alternatives, calibrated on tuning cases.
    output : str
        Force in which it is largest.
    where : dict
        Channel -> (low, high), SI: holds the central 90% of its energy.
    when : list of (start, end)
        s; its RMS over 1 s is above the noise floor.
    share : float
        Share of the held-out mismatch that it removes.
    equation, source : str
    parameters : dict
        Name -> (value, standard error, unit).
    evidence : dict
        Gain in nats, Wilcoxon p, and so on.
    """

    name: str
    kind: str
    title: str
    alternatives: tuple[str, ...]
    confidence: float
    output: str
    where: dict[str, tuple[float, float]]
    when: list[tuple[float, float]]
    share: float
    equation: str
    source: str
    parameters: dict[str, tuple[float, float, str]]
    evidence: dict[str, float | str] = field(default_factory=dict)


@dataclass(frozen=True)
class OutputFit:
    """Errors of one output on sweeps that were left out of the fit, N (moments: no fit has seen them, N m).

    Parameters
    ----------
    noise_floor : float
    rms_before, rms_after : float
    rms_after_low, rms_after_high : float
        95% interval by resampling sweeps.
    recovered : float
        Share of the squared error above the noise floor that is gone.
    held_out_condition : str
        One condition left out as a whole, and ``rms_condition_before``, ``rms_condition_after``.
    """

    noise_floor: float
    rms_before: float
    rms_after: float
    rms_after_low: float
    rms_after_high: float
    recovered: float
    held_out_condition: str = ""
    rms_condition_before: float = float("nan")
    rms_condition_after: float = float("nan")


@dataclass(frozen=True)
class GaussianForm:
    """A Gaussian process for what is left of one output; it has no name.

    Parameters
    ----------
    output : str
    size, noise : float
        Its standard deviation, and that of the white noise beside it, N.
    lengths : dict
        Channel (or ``rate of <channel>``, per second) -> length over which it changes, SI.
    explained : float
        Share of what is left, as a square, that it predicts on sweeps left out of its fit.
    recovered : float
        The same of what is left above the noise.
    points : int
        Samples it was fitted to.
    """

    output: str
    size: float
    noise: float
    lengths: dict[str, float]
    explained: float
    recovered: float
    points: int


@dataclass(frozen=True)
class Remainder:
    """What is left above the noise, without a name.

    Parameters
    ----------
    size : dict
        Output -> RMS above noise, N.
    located : list of Located
    form : str
        A sparse equation for it (PySINDy), or nothing.
    significant : bool
        Whether it counts.
    statistic, nats : float
        Its power over that of noise at the worst scale, and what that is worth.
    gaussian : list of GaussianForm
        The output first in which most is left.
    """

    size: dict[str, float]
    located: list[Located]
    form: str
    significant: bool
    statistic: float = 0.0
    nats: float = 0.0
    gaussian: list[GaussianForm] = field(default_factory=list)


@dataclass
class MismatchReport:
    """What :func:`tire_pipeline.mismatch.explain_mismatch` returns; see ``docs/mismatch.md``."""

    verdict: str
    effects: list[EffectReport]
    fit: dict[str, OutputFit]
    next_experiment: str
    corrected: CorrectedModel
    summary: str
    located: list[Located]
    remainder: Remainder
    notes: list[str]
    candidates: list[dict[str, Any]]
    series: dict[str, Any] = field(default_factory=dict, repr=False)

    def to_dict(self) -> dict[str, Any]:
        """Return the report as plain JSON types (no arrays, no NaN)."""
        raw = {
            "verdict": self.verdict,
            "summary": self.summary,
            "effects": [asdict(e) for e in self.effects],
            "fit": {o: asdict(f) for o, f in self.fit.items()},
            "next_experiment": self.next_experiment,
            "located": [asdict(f) for f in self.located],
            "remainder": asdict(self.remainder),
            "notes": list(self.notes),
            "candidates": self.candidates,
            "corrected": [{"name": n, "parameters": dict(p)} for n, p in self.corrected.changes],
        }
        return json.loads(json.dumps(_plain(raw)))

    def to_json(self, path: str | Path) -> Path:
        """Write :meth:`to_dict` as a JSON file."""
        path = Path(path)
        path.write_text(json.dumps(self.to_dict(), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        return path

    def to_html(self, path: str | Path) -> Path:
        """Write the report as one HTML page that needs no network."""
        from tire_pipeline.mismatch.page import render

        path = Path(path)
        path.write_text(render(self), encoding="utf-8")
        return path


def _plain(x: Any) -> Any:
    if isinstance(x, Mapping):
        return {str(k): _plain(v) for k, v in x.items()}
    if isinstance(x, (list, tuple)):
        return [_plain(v) for v in x]
    if isinstance(x, np.bool_):
        return bool(x)
    if isinstance(x, (float, np.floating)):
        return float(x) if np.isfinite(x) else None
    if isinstance(x, np.integer):
        return int(x)
    return x
