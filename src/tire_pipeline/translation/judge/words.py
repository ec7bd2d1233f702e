"""What the target measures differently, in the words of a tire engineer."""

from __future__ import annotations

import numpy as np

from tire_pipeline.translation.curves.features import CAMBER_ANGLE, GROUPS, LOADS

_LEAST_CHANGE = 0.005  # smaller changes are not mentioned
_CURVES = {"cornering stiffness": ("lateral", 0), "lateral grip": ("lateral", 1)}
_CURVES.update({"slip stiffness": ("longitudinal", 0), "longitudinal grip": ("longitudinal", 1)})
_WHY = {
    "cornering stiffness": "belt, drum, rig compliance, run-in or tread temperature",
    "lateral grip": "test surface or tread temperature",
    "slip stiffness": "belt, drum or tread temperature",
    "longitudinal grip": "test surface or tread temperature",
    "residual side force": "one-way sweeps, a filter, symmetrising or an angle error",
    "aligning torque": "contact length on belt or drum, pressure or grip",
    "camber thrust": "camber range or rig compliance",
}


def describe_bias(
    before: dict[str, np.ndarray],
    after: dict[str, np.ndarray],
    sure: np.ndarray,
    source: np.ndarray,
    target: str,
) -> list[str]:
    """Say for each file what the target measures differently, and what that usually comes from.

    Parameters
    ----------
    before, after : dict of ndarray
        Features by group of each tire as its source and as the target measures it
        (:func:`.bias_band.measured_by_both`).
    sure : ndarray of bool, shape (n, parts)
        Of which stiffness and friction the band tells whether the target measures more or less
        (:attr:`.bias_band.BiasBand.excludes_zero`); nothing is said of the others.
    source : ndarray of str, shape (n,)
        Source categories.
    target : str

    Returns
    -------
    list of str
        For example ``"D measures 6% more cornering stiffness than B, most at high load (belt, ...)"``,
        several
        parted by ``"; "``; empty where nothing moved.
    """
    moves = {
        name: np.expm1((after[group] - before[group])[:, part * LOADS.size : (part + 1) * LOADS.size])
        for name, (group, part) in _CURVES.items()
    }
    even, aligning, camber = _other_moves(before, after)
    said = []
    for i, organisation in enumerate(source):
        told = [name for k, name in enumerate(moves) if sure[i, k]]
        sentences = [s for name in told if (s := _sentence(name, moves[name][i], str(organisation), target))]
        if abs(even[i]) > _LEAST_CHANGE:
            more = "more" if even[i] > 0 else "less"
            sentences.append(
                f"{target} keeps {abs(even[i]):.1%} of the grip {more} residual side force "
                f"({_WHY['residual side force']})"
            )
        if abs(aligning[i]) > 4 * _LEAST_CHANGE:
            sentences.append(
                f"{target} measures {_percent(aligning[i])} aligning torque ({_WHY['aligning torque']})"
            )
        if abs(camber[i]) > 4 * _LEAST_CHANGE:
            sentences.append(
                f"{target} measures {_percent(camber[i])} camber thrust ({_WHY['camber thrust']})"
            )
        said.append("; ".join(sentences))
    return said


def _percent(change: float) -> str:
    return f"{abs(change):.1%} {'more' if change > 0 else 'less'}"


def _sentence(name: str, move: np.ndarray, source: str, target: str) -> str:
    size = float(move.mean())
    if np.abs(move).max() < _LEAST_CHANGE:
        return ""
    place = ""
    if move[-1] - move[0] > max(0.01, abs(size) / 3):
        place = ", most at high load" if size > 0 else ", most at low load"
    elif move[0] - move[-1] > max(0.01, abs(size) / 3):
        place = ", most at low load" if size > 0 else ", most at high load"
    return f"{target} measures {_percent(size)} {name} than {source}{place} ({_WHY[name]})"


def _other_moves(
    before: dict[str, np.ndarray], after: dict[str, np.ndarray]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Residual side force over grip (6000 N), relative change of aligning torque and of camber thrust."""
    reduced = (len(GROUPS[0].names) - 2 * LOADS.size) // (2 * LOADS.size)
    even = slice(2 * LOADS.size + LOADS.size * reduced, None)
    middle = slice(2 * reduced, 3 * reduced)
    residual = [np.abs(f["lateral"][:, even][:, middle]).mean(axis=1) for f in (before, after)]
    torque = [np.abs(f["aligning"][:, : LOADS.size * reduced]).mean(axis=1) for f in (before, after)]
    thrust = [np.abs(f["camber"]).mean(axis=1) / CAMBER_ANGLE for f in (before, after)]
    relative = [b / np.maximum(a, 1e-6) - 1.0 for a, b in (torque, thrust)]
    return residual[1] - residual[0], relative[0], relative[1]
