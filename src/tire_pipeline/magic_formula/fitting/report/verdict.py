"""Whether a fit is plausible as a tire, and the likely reason if it is not."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

import numpy as np

from tire_pipeline.channels import (
    ALIGNING_MOMENT,
    ANGLE_CHANNELS,
    FORCES_OF_MOMENT,
    SLIP_OF_FORCE,
    TANGENTIAL_FORCES,
    TIRE_RADII,
)
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import BOUNDS, PURE_SLIP
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.camber_thrust import camber_thrust
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
_NO_FRICTION = 0.03
"""Largest force over load below which a poor fit is one of another unit: wet ice has 0.1."""
_SOFT_FRICTION, _SOFT_STIFFNESS = 0.35, 8.0
"""Friction, and slip stiffness over load, that no tire has both. One for trucks has a stiffness of 5, but a
friction of 0.7 (16 public files); on snow and ice, where friction is as low, the stiffness stays."""
_FOLLOWS = 0.3
"""Share of the force over load that the slip has to explain; correlation of the larger forces with load."""
_ONE_SIGN, _NO_SIGN = 0.8, 0.4
"""Agreement in sign of force and slip from which the slip stiffness has one sign, and below which it has
none, whatever a fit leaves."""
_LOADS_DIFFER = 0.3
"""Spread of loads, over the middle one, from which the larger forces have to follow it."""
_OTHER_SIGN = 0.02
"""Share of slips of the other sign up to which a recording has one direction only."""
_FROM_ZERO = 0.3
"""The small slips, over the large ones, up to which the slip stiffness shows."""
_OF_CAMBER_SIGN = "axes or signs; the data are in SAE axes, or camber has the other sign than in ISO W."
_OF_TRAIL_SIGN = "axes or signs; beside fy, mz over slip_angle has the other sign than a tire's."
_SMALL_SLIP = 1e-3
"""rad; either way, for slopes while rolling straight."""
_SLIP_BINS = 20
_ROWS_OF_BIN = 5


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
    fy: the fit leaves ...% of the largest magnitude. Likely reason: a channel that does not belong; ...
    """


def poor_outputs(
    model: TireModel,
    points: Mapping[str, np.ndarray],
    forces: Mapping[str, np.ndarray],
    shares: Mapping[str, float],
    fitted: set[str],
    start: TireModel | None,
    at_bound: Collection[str] = (),
    inputs: str = "",
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
    inputs : str
        What no tire has of load, pressure and radius, as a likely reason; or nothing.

    Returns
    -------
    dict of str to str
    """
    found = {}
    for output in sorted(fitted & set(forces)):
        wrong = []
        if shares[output] > MOST_LEFT:
            wrong.append(f"the fit leaves {100 * shares[output]:.0f}% of the largest magnitude")
        seen = _measured(output, points, forces[output])
        if output in TANGENTIAL_FORCES and (
            _falls(model, output, points, start) or _turned(output, seen, start)
        ):
            wrong.append(f"the force falls with {SLIP_OF_FORCE[output]} in the tire's own convention")
        of_sign = ""
        if output == "fy" and _away_from_the_lean(points, forces[output]):
            wrong.append("with camber, the side force points away from the side to which the wheel leans")
            of_sign = _OF_CAMBER_SIGN
        if output == ALIGNING_MOMENT and _negative_trail(model, seen):
            wrong.append("the pneumatic trail is negative: Mz turns the wheel out of its run")
            of_sign = _OF_TRAIL_SIGN
        units, levels = _units(output, points, seen) or inputs, _levels(model, output, seen, at_bound)
        if (units or levels or _lost_sign(output, seen, _NO_SIGN)) and not wrong:
            wrong.append("no tire is like that")
        if wrong:
            reason = units or _beyond_reach(output, seen, forces)
            reason = (
                reason or of_sign or _signs(output, seen, start) or _without_force(output, points, forces)
            )
            reason = reason or _strange(output, seen) or levels or _ELSE
            found[output] = f"{'; '.join(wrong)}. Likely reason: {reason}"
    return found


class _Measured(NamedTuple):
    """An output where it was measured, and the slip and the load there, each of shape (n,)."""

    slip: np.ndarray
    load: np.ndarray
    force: np.ndarray


def _measured(output: str, points: Mapping[str, np.ndarray], measured: np.ndarray) -> _Measured:
    good = np.isfinite(measured)
    slip = points[SLIP_OF_FORCE.get(output, "slip_angle")]
    return _Measured(slip[good], points["normal_load"][good], measured[good])


def _one_direction(seen: _Measured) -> bool:
    """Whether the slip has one sign but for a few points: an offset stands for a part of the level then."""
    if not seen.slip.size:
        return False
    return bool(min(np.mean(seen.slip > 0.0), np.mean(seen.slip < 0.0)) < _OTHER_SIGN)


def _without_small_slips(seen: _Measured) -> bool:
    """Whether one direction was measured at large slips only, where a force hardly changes with the slip."""
    small, large = np.quantile(np.abs(seen.slip), [0.05, 0.95]) if seen.slip.size else (0.0, 0.0)
    return _one_direction(seen) and bool(small > _FROM_ZERO * large)


def _levels(model: TireModel, output: str, seen: _Measured, at_bound: Collection[str]) -> str:
    """Return which units to check if no tire has such a friction or slip stiffness."""
    if output not in TANGENTIAL_FORCES:
        return ""
    if _without_small_slips(seen):
        return _no_friction(output, seen)
    letter, slip = output[1].upper(), SLIP_OF_FORCE[output]
    unit = "radians" if output == "fy" else "a ratio, no percent"
    look = f"look at those of {slip} ({unit}), {output} and normal_load"
    for name, what in ((f"PD{letter}1", "friction"), (f"PK{letter}1", "the slip stiffness")):
        if name in at_bound and not (what == "friction" and _one_direction(seen)):
            low, high, _ = BOUNDS[name]
            least = abs(model.value(name)) < 0.5 * min(abs(high), high - low)
            return f"units; {what} is {'below' if least else 'beyond'} any tire's, {look}."
    friction = abs(model.value(f"PD{letter}1"))
    if _one_direction(seen):
        friction = max(friction, _friction(seen))
    load = model.value("FNOMIN")
    name = "slip_stiffness" if output == "fx" else "cornering_stiffness"
    forces = model.forces(normal_load=load, limits="ignore", outputs=(name,))
    stiffness = abs(float(getattr(forces, name))) / load
    if 0.0 < friction < _SOFT_FRICTION and stiffness < _SOFT_STIFFNESS:
        return (
            f"units; friction of {in_digits(friction)} and a slip stiffness of {in_digits(stiffness)} times "
            f"the load are both below any tire's, {look} (newtons)."
        )
    return ""


def _agreement(slip: np.ndarray, force: np.ndarray) -> float:
    """Return 1 where force and slip have one sign at every point, -1 where they have opposite ones."""
    product = slip * force
    total = float(np.abs(product).sum())
    return float(product.sum()) / total if total > 0.0 else 0.0


def _turned(output: str, seen: _Measured, start: TireModel | None) -> bool:
    """Whether the measured force has the other sign, and the other slope, than the tire's own convention.

    Beyond its largest value the force falls with slip; and with an offset of the slip it has the other sign.
    """
    own = 1.0 if output == "fx" else None if start is None else _sign_of(output, start)
    if own is None or seen.force.size == 0:
        return False
    slope = _agreement(seen.slip - np.median(seen.slip), seen.force - np.median(seen.force))
    return own * _agreement(seen.slip, seen.force) < -_ONE_SIGN and own * slope < -0.5


def _falls(model: TireModel, output: str, points: Mapping[str, np.ndarray], start: TireModel | None) -> bool:
    """Whether the slip stiffness has the wrong sign at some of the points."""
    at: Any = {name: points[name] for name in ("camber", "normal_load")}
    if model.family == 6:
        at["pressure"] = points["pressure"]
    stiffness = "slip_stiffness" if output == "fx" else "cornering_stiffness"
    found = getattr(model.forces(limits="ignore", outputs=(stiffness,), **at), stiffness)
    return bool((found * _sign_of(output, model if start is None else start) <= 0.0).any())


def _away_from_the_lean(points: Mapping[str, np.ndarray], fy: np.ndarray) -> bool:
    """Whether the measured side force points away from the side to which the wheel leans, in ISO W axes."""
    free = np.abs(points["slip_ratio"]) < PURE_SLIP["slip_ratio"]
    slip, camber, load = (points[name][free] for name in ("slip_angle", "camber", "normal_load"))
    return camber_thrust(slip, camber, load, fy[free]) > 0.0


def _negative_trail(model: TireModel, seen: _Measured) -> bool:
    """Whether the moment goes with the slip angle as the side force does; small slips have to be known."""
    if not seen.slip.size or _without_small_slips(seen) or not _swept("slip_angle", seen.slip):
        return False
    either = np.array([-_SMALL_SLIP, _SMALL_SLIP])
    load = float(np.median(seen.load))
    at = model.forces(slip_angle=either, normal_load=load, limits="ignore", outputs=("fy", "mz"))
    return bool(np.diff(at.fy)[0] * np.diff(at.mz)[0] > 0.0)


def _sign_of(output: str, tire: TireModel) -> float:
    """Return the sign of force over slip of a tire's own convention."""
    return 1.0 if output == "fx" else float(np.sign(tire.coefficients.get("PKY1", -1.0)))


def _units(output: str, points: Mapping[str, np.ndarray], seen: _Measured) -> str:
    """Return which channel's unit is wrong, or nothing."""
    for angle in ANGLE_CHANNELS:
        if np.abs(points[angle]).max() > LOOKS_LIKE_DEGREES:
            return f"units; {angle} looks like degrees, it has to be in radians."
    if np.abs(points["slip_ratio"]).max() > _PERCENT or np.quantile(points["slip_ratio"], 0.02) < _BACKWARDS:
        return "units; slip_ratio looks like percent, it has to be a ratio."
    if output in TANGENTIAL_FORCES and _friction(seen) > _MOST_FRICTION:
        return (
            f"units; {output} reaches {in_digits(_friction(seen))} times the load, "
            f"look at the units of {output} and normal_load (newtons)."
        )
    return ""


def _beyond_reach(output: str, seen: _Measured, forces: Mapping[str, np.ndarray]) -> str:
    """Return that the aligning moment has a longer arm than any wheel's radius, or nothing."""
    sizes = [float(np.nanmax(np.abs(forces[o]), initial=0.0)) for o in TANGENTIAL_FORCES if o in forces]
    force = max(sizes, default=0.0)
    if output != ALIGNING_MOMENT or not force or not seen.force.size:
        return ""
    arm = float(np.quantile(np.abs(seen.force), 0.98)) / force
    if not arm > TIRE_RADII[1]:
        return ""
    return (
        f"units; {output} has an arm of {in_digits(arm)} m over the forces, longer than any wheel's radius: "
        f"look at the units of {output} and the forces."
    )


def _friction(seen: _Measured) -> float:
    """Return the largest force over the load but for odd samples."""
    return float(np.quantile(np.abs(seen.force) / seen.load, 0.98)) if seen.force.size else 0.0


def _signs(output: str, seen: _Measured, start: TireModel | None) -> str:
    """Return what is wrong with the signs of a poor fit, or nothing."""
    name = SLIP_OF_FORCE.get(output, "slip_angle")
    if output in TANGENTIAL_FORCES and _turned(output, seen, start):
        whose = "the start model's" if output == "fy" else "a tire's (braking: negative slip_ratio and fx)"
        return f"axes or signs; {output} over {name} has the other sign than {whose}."
    if _lost_sign(output, seen, _ONE_SIGN):
        return (
            f"signs; the size of {output} follows that of {name}, its sign does not, as if axes changed "
            "within the recording or one of the two had lost its sign."
        )
    return ""


def _lost_sign(output: str, seen: _Measured, least: float) -> bool:
    """Whether the size of a force grows with that of the slip, but agrees in sign by less than ``least``."""
    if output not in TANGENTIAL_FORCES or abs(_agreement(seen.slip, seen.force)) >= least:
        return False
    size, slip = np.abs(seen.force / seen.load), np.abs(seen.slip)
    return _explained(slip, size) > _FOLLOWS and float(np.corrcoef(slip, size)[0, 1]) > _FOLLOWS


def _without_force(output: str, points: Mapping[str, np.ndarray], forces: Mapping[str, np.ndarray]) -> str:
    """Return that a force is missing of which a moment is made, or nothing: it comes from the model then."""
    lacking = [o for o in FORCES_OF_MOMENT.get(output, ()) if o not in forces]
    lacking = [o for o in lacking if _swept(SLIP_OF_FORCE[o], points[SLIP_OF_FORCE[o]])]
    if not lacking:
        return ""
    names = " and ".join(lacking)
    were, them = ("was", "it") if len(lacking) == 1 else ("were", "them")
    return (
        f"{names} {were} not recorded, and {output} contains {them}: record {them}, or leave out such rows."
    )


def _not_driven(output: str, seen: _Measured) -> str:
    """Return that the slip was not swept, or nothing: a side effect of what was swept is no tire's force."""
    name = SLIP_OF_FORCE.get(output, "slip_angle")
    if not seen.slip.size or _swept(name, seen.slip):
        return ""
    return (
        f"{name} was not swept; {output} is what ply steer, conicity, camber and the other slip make of it. "
        f"The file says nothing of {output} over {name}: record sweeps of it."
    )


def _swept(name: str, slip: np.ndarray) -> bool:
    """Whether a slip goes beyond what counts as none, but for odd rows."""
    return float(np.quantile(np.abs(slip), 0.95)) > PURE_SLIP[name]


def _strange(output: str, seen: _Measured) -> str:
    """Return which channel of a poor fit does not belong to the others, or nothing."""
    name = SLIP_OF_FORCE.get(output, "slip_angle")
    where = "(another wheel, another run, or a shift in time)."
    if _explained(seen.slip, seen.force / seen.load) < _FOLLOWS:
        if not_driven := _not_driven(output, seen):
            return not_driven
        if output not in TANGENTIAL_FORCES:
            alone = _one_direction(seen)
        elif said := _no_friction(output, seen):
            return said
        else:
            alone = _without_small_slips(seen)
        if alone:
            return (
                f"one direction only; {name} has one sign throughout, and {output} hardly changes with it: "
                "record both directions, through zero."
            )
        return f"a channel that does not belong; {output} hardly follows {name} {where}"
    if output not in TANGENTIAL_FORCES:
        return ""
    if said := _no_friction(output, seen):
        return said
    large = np.abs(seen.slip) >= np.median(np.abs(seen.slip))
    load, force = seen.load[large], np.abs(seen.force[large])
    differ = np.ptp(np.quantile(load, [0.02, 0.98])) > _LOADS_DIFFER * np.median(load)
    if differ and np.ptp(force) > 0.0 and np.corrcoef(load, force)[0, 1] < _FOLLOWS:
        return f"a channel that does not belong; {output} hardly follows normal_load {where}"
    return ""


def _no_friction(output: str, seen: _Measured) -> str:
    """Return which units to check if a force is far too small for its load, or nothing."""
    if _friction(seen) >= _NO_FRICTION:
        return ""
    return (
        f"units; {output} reaches no more than {in_digits(_friction(seen))} times the load, "
        f"look at the units of {output} and normal_load (newtons)."
    )


_ELSE = (
    "something that a steady Magic Formula does not know (transients, temperature, a channel in other units, "
    "axes or time than the rest); see the residuals by load and camber."
)


def _explained(slip: np.ndarray, normalised: np.ndarray) -> float:
    """Return the share of the variance that lies between bins of the slip, less what chance puts there."""
    number = min(_SLIP_BINS, slip.size // _ROWS_OF_BIN)
    edges = np.unique(np.quantile(slip, np.linspace(0.0, 1.0, number + 1))) if number > 1 else np.empty(0)
    total = float(np.var(normalised)) if slip.size else 0.0
    if edges.size < 3 or total == 0.0:
        return 0.0
    bins = np.clip(np.searchsorted(edges, slip, side="right") - 1, 0, edges.size - 2)
    count = np.bincount(bins)
    mean = np.bincount(bins, normalised) / np.maximum(count, 1)
    share = float(np.sum(count * (mean - normalised.mean()) ** 2) / (normalised.size * total))
    return 1.0 - (1.0 - share) * (slip.size - 1) / (slip.size - np.count_nonzero(count))
