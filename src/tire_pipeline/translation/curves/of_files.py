"""Curves of every file: as it is, as translated, and the band of the target's own measurement."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tire_pipeline.channels import SLIP_OF_FORCE
from tire_pipeline.errors import TirePipelineError
from tire_pipeline.magic_formula import MissingRadiusWarning, TireModel
from tire_pipeline.progress import track
from tire_pipeline.translation.curves.bands import BAND_SLIP_RATIOS
from tire_pipeline.translation.curves.features import LOADS
from tire_pipeline.translation.result import Band, TranslationResult

DRAWN_OUTPUTS = tuple(SLIP_OF_FORCE)
_LATERAL_KEYS = ("PCY1", "PDY1", "PKY1", "PKY2")
_KEYS_OF_CURVE = {
    "fy": _LATERAL_KEYS,
    "fx": ("PCX1", "PDX1", "PKX1"),
    "mz": (*_LATERAL_KEYS, "QBZ1", "QDZ1"),
    "stiffness": _LATERAL_KEYS,
}
"""Without one of these a curve would be that of a value which stands in for what the file does not state."""


def file_curves(
    files: Sequence[str], models: Mapping[str, TireModel], result: TranslationResult
) -> dict[str, Any]:
    """Evaluate the files' own curves, and lay the bands of the translated ones beside them.

    Parameters
    ----------
    files : sequence of str
        The n files, row by row those of ``result``.
    models : mapping of str to TireModel
        As they were read.
    result : TranslationResult

    Returns
    -------
    dict
        ``files``; ``normal_load`` (l, N); ``slip`` (s, rad or 1); ``<output>_source``, ``_middle``, ``_low``,
        ``_high`` for fy, fx (N), mz (N m), each (n, l, s), and for stiffness (N/rad), each (n, l). NaN where
        a file was not translated, or its curve cannot be evaluated, or rests on a level that it does not
        state.
    """
    bands: dict[str, Band | None] = {name: result.bands.get(name) for name in DRAWN_OUTPUTS}
    loads = LOADS if result.normal_load is None else result.normal_load
    shape = (len(files), loads.size, BAND_SLIP_RATIOS.size)
    found: dict[str, Any] = {"files": list(files), "normal_load": loads, "slip": BAND_SLIP_RATIOS}
    sources = {name: np.full(shape, np.nan, dtype=np.float32) for name in DRAWN_OUTPUTS}
    sources["stiffness"] = np.full(shape[:2], np.nan, dtype=np.float32)
    for i, file in track(list(enumerate(files)), "drawing the files' own curves"):
        for name, values in _own_curves(models[file], loads).items():
            sources[name][i] = values
    for name, source in sources.items():
        band = result.stiffness if name == "stiffness" else bands[name]
        found[f"{name}_source"] = source
        for part in ("middle", "low", "high"):
            found[f"{name}_{part}"] = _part(band, part, source.shape)
    return found


def _part(band: Band | None, part: str, shape: tuple[int, ...]) -> np.ndarray:
    if band is None:
        return np.full(shape, np.nan, dtype=np.float32)
    known = np.isfinite(band.low)
    return np.where(known, getattr(band, part), np.nan).reshape(shape).astype(np.float32)


def _own_curves(model: TireModel, loads: np.ndarray) -> dict[str, np.ndarray]:
    """Curves of one model, without those that cannot be evaluated or whose levels it does not state."""
    load = loads[:, None]
    found = {}
    asked: dict[str, dict[str, Any]] = {
        **{o: {slip: BAND_SLIP_RATIOS, "normal_load": load} for o, slip in SLIP_OF_FORCE.items()},
        "stiffness": {"normal_load": loads},
    }
    for name, points in asked.items():
        if not model.coefficients.keys() >= set(_KEYS_OF_CURVE[name]):
            continue
        output = "cornering_stiffness" if name == "stiffness" else name
        try:
            with warnings.catch_warnings():  # the reading reports a missing radius; its moments are not drawn
                warnings.simplefilter("ignore", MissingRadiusWarning)
                values = getattr(model.forces(**points, limits="ignore", outputs=(output,)), output)
        except TirePipelineError:
            continue
        found[name] = np.abs(values) if name == "stiffness" else values
    return found
