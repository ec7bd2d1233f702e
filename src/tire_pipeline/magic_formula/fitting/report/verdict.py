"""Whether a fit is plausible as a tire, and the likely reason if it is not."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from tire_pipeline.channels import ANGLE_CHANNELS, SLIP_OF_FORCE, TANGENTIAL_FORCES
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.inputs import LOOKS_LIKE_DEGREES
from tire_pipeline.pages.numbers_in_words import in_digits

MOST_LEFT = 0.1
"""RMS of the residuals, over the largest force, beyond which a fit counts as failed."""
_PERCENT = 5.0
"""Slip ratios beyond this look like percent."""
_BACKWARDS = -1.2
"""A locked wheel has -1, less its noise; below that it would turn backwards."""
_MOST_FRICTION = 6.0
"""Largest force over load; racing tires at small loads reach 3, sensors near no load a little more."""
_FOLLOWS = 0.3
"""Share of the force over load that the slip has to explain."""
_SLIP_BINS = 20
_SMALL_SLIPS = 0.4
"""Share of the largest slips below which the slope of the force is looked at."""
_FEWEST_IN_GROUP = 10


class PoorFitWarning(UserWarning):
    """A fit leaves more than a tenth of the largest force, or its force falls with slip.

    See Also
    --------
    tire_pipeline.magic_formula.fit_magic_formula : Issues this warning.
    tire_pipeline.magic_formula.FitResult : ``poor`` holds the same sentences by output.

    Notes
    -----
    The residual is stated as RMS over the largest magnitude of the output. The warning names the
    likely reason: units, axes, or effects that a steady Magic Formula does not model.

    Examples
    --------
    >>> import warnings
    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.magic_formula import fit_magic_formula
    >>> slip_angle = np.linspace(-0.15, 0.15, 60)
    >>> points = pd.DataFrame({"slip_angle": slip_angle, "normal_load": 4000.0})
    >>> points["fy"] = 3000.0 * np.sin(200.0 * slip_angle)
    >>> with warnings.catch_warnings(record=True) as told:
    ...     fit = fit_magic_formula(points)
    >>> print(told[0].message)
    fy: the fit leaves ...% of the largest magnitude. Likely reason: something that a steady Magic Formula ...
    """


def poor_outputs(
    model: TireModel,
    points: Mapping[str, np.ndarray],
    forces: Mapping[str, np.ndarray],
    shares: Mapping[str, float],
    fitted: set[str],
    start: TireModel | None,
    at_bound: Collection[str] = (),
) -> dict[str, str]:
    """Return, for each implausible output, what is wrong and the likely reason.

    Parameters
    ----------
    model : TireModel
        The fitted one.
    points, forces : mapping of ndarray
        What was measured.
    shares : mapping of str to float
        RMS of the residuals over the largest magnitude, by output.
    fitted : set of str
        Outputs that a stage has fitted.
    start : TireModel, optional
        Its sign of the slip stiffness is the tire's own.
    at_bound : collection of str
        Coefficients that ended at the bound of what tires have.

    Returns
    -------
    dict of str to str
    """
    found = {}
    for output in sorted(fitted & set(forces)):
        wrong = []
        if shares[output] > MOST_LEFT:
            wrong.append(f"the fit leaves {100 * shares[output]:.0f}% of the largest magnitude")
        units = _units(output, points, forces[output]) or _level_units(output, at_bound)
        if units and not wrong:
            wrong.append("no tire is like that")
        if output in TANGENTIAL_FORCES and (
            _falls(model, output, points, start) or _turned(output, points, forces[output], start)
        ):
            wrong.append(f"the force falls with {SLIP_OF_FORCE[output]} in the tire's own convention")
        if wrong:
            found[output] = f"{'; '.join(wrong)}. {units or _reason(output, points, forces[output], start)}"
    return found


def _level_units(output: str, at_bound: Collection[str]) -> str:
    """Return which units to check if no tire has such a friction or slip stiffness."""
    letter = output[1].upper()
    if output in TANGENTIAL_FORCES and f"PD{letter}1" in at_bound:
        return (
            f"Likely reason: units; friction is beyond any tire's, look at those of {output} and normal_load."
        )
    if output in TANGENTIAL_FORCES and f"PK{letter}1" in at_bound:
        slip = SLIP_OF_FORCE[output]
        unit = "radians" if output == "fy" else "a ratio, no percent"
        return (
            "Likely reason: units; the slip stiffness is beyond any tire's, look at those of "
            f"{slip} ({unit}), {output} and normal_load."
        )
    return ""


def _turned(
    output: str, points: Mapping[str, np.ndarray], measured: np.ndarray, start: TireModel | None
) -> bool:
    """Whether the measured force falls with slip, in the tire's own convention, at every load and camber."""
    own = 1.0 if output == "fx" else None if start is None else _sign_of(output, start)
    if own is None:
        return False
    good = np.isfinite(measured)
    names = (SLIP_OF_FORCE[output], "normal_load", "camber")
    slip, load, camber = (points[name][good] for name in names)
    slopes = _slopes(slip, measured[good], load, camber)
    return bool(slopes.size) and bool((own * slopes < 0.0).all())


def _falls(model: TireModel, output: str, points: Mapping[str, np.ndarray], start: TireModel | None) -> bool:
    """Whether the slip stiffness has the wrong sign at some of the points."""
    at: Any = {name: points[name] for name in ("camber", "normal_load")}
    if model.family == 6:
        at["pressure"] = points["pressure"]
    stiffness = "slip_stiffness" if output == "fx" else "cornering_stiffness"
    found = getattr(model.forces(limits="ignore", outputs=(stiffness,), **at), stiffness)
    return bool((found * _sign_of(output, model if start is None else start) <= 0.0).any())


def _sign_of(output: str, tire: TireModel) -> float:
    """Return the sign of force over slip of a tire's own convention."""
    return 1.0 if output == "fx" else float(np.sign(tire.coefficients.get("PKY1", -1.0)))


def _units(output: str, points: Mapping[str, np.ndarray], measured: np.ndarray) -> str:
    """Return which channel's unit is wrong, or nothing."""
    for angle in ANGLE_CHANNELS:
        if np.abs(points[angle]).max() > LOOKS_LIKE_DEGREES:
            return f"Likely reason: units; {angle} looks like degrees, it has to be in radians."
    if np.abs(points["slip_ratio"]).max() > _PERCENT or np.quantile(points["slip_ratio"], 0.02) < _BACKWARDS:
        return "Likely reason: units; slip_ratio looks like percent, it has to be a ratio."
    friction = float(np.nanquantile(np.abs(measured) / points["normal_load"], 0.98))
    if output in TANGENTIAL_FORCES and friction > _MOST_FRICTION:
        return (
            f"Likely reason: units; {output} reaches {in_digits(friction)} times the load, "
            f"look at the units of {output} and normal_load (newtons)."
        )
    return ""


def _reason(
    output: str, points: Mapping[str, np.ndarray], measured: np.ndarray, start: TireModel | None
) -> str:
    """Return the likely reason in a sentence that says what to look at."""
    name = SLIP_OF_FORCE.get(output, "slip_angle")
    good = np.isfinite(measured)
    slip, load, force = points[name][good], points["normal_load"][good], measured[good]
    slopes = _slopes(slip, force, load, points["camber"][good])
    if output in TANGENTIAL_FORCES and _turned(output, points, measured, start):
        whose = "the start model's" if output == "fy" else "a tire's (braking: negative slip_ratio and fx)"
        return f"Likely reason: axes or signs; {output} over {name} has the other sign than {whose}."
    if (slopes > 0.0).any() and (slopes < 0.0).any():
        return (
            f"Likely reason: signs; {output} over {name} has one sign at some loads or cambers "
            "and the other at others, as if axes changed within the recording."
        )
    if _explained(slip, force / load) < _FOLLOWS:
        return (
            f"Likely reason: a channel that does not belong; {output} hardly follows {name} "
            "(another wheel, another run, or a shift in time)."
        )
    return (
        "Likely reason: something that a steady Magic Formula does not know (transients, temperature, a "
        "channel in other units, axes or time than the rest); see the residuals by load and camber."
    )


def _slopes(slip: np.ndarray, force: np.ndarray, load: np.ndarray, camber: np.ndarray) -> np.ndarray:
    """Return the slope of the force over the smaller slips at each load and camber."""
    reach = _SMALL_SLIPS * float(np.quantile(np.abs(slip), 0.98))
    small = np.abs(slip) <= reach
    group = 1000.0 * np.round(load / (0.25 * np.median(load))) + np.round(np.degrees(camber))
    found = []
    for value in np.unique(group[small]):
        x, y = slip[small & (group == value)], force[small & (group == value)]
        if x.size >= _FEWEST_IN_GROUP and np.ptp(x) > 0.5 * reach:
            slope, level = np.polyfit(x, y, 1)
            left = np.sum((y - level - slope * x) ** 2) / max(x.size - 2, 1)
            if slope**2 * np.sum((x - x.mean()) ** 2) > 16.0 * left:  # four standard errors
                found.append(slope)
    return np.array(found)


def _explained(slip: np.ndarray, normalised: np.ndarray) -> float:
    """Return the share of the variance that lies between bins of the slip."""
    edges = np.unique(np.quantile(slip, np.linspace(0.0, 1.0, _SLIP_BINS + 1)))
    total = float(np.var(normalised))
    if edges.size < 3 or total == 0.0:
        return 0.0
    bins = np.clip(np.searchsorted(edges, slip, side="right") - 1, 0, edges.size - 2)
    count = np.bincount(bins)
    mean = np.bincount(bins, normalised) / np.maximum(count, 1)
    return float(np.sum(count * (mean - normalised.mean()) ** 2) / (normalised.size * total))
