"""Names, units, places and sizes in the words that engineers use."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np

from tire_pipeline.channels import shown_unit
from tire_pipeline.mismatch.discrepancy.gaussian_form import GaussianForm
from tire_pipeline.mismatch.effects import Effect, catalogue
from tire_pipeline.pages.numbers_in_words import in_digits

_FINEST = {"slip_angle": 5e-5, "camber": 5e-5, "slip_ratio": 1e-4}
"""Smaller values are written as 0, SI: no rig controls them so closely."""


def shown(axis: str, value: float) -> str:
    """Return a value of an axis in the unit that engineers use."""
    return f"{figure(axis, value)} {shown_unit(axis, value)[1]}".strip()


def figure(axis: str, value: float, size: float | None = None) -> str:
    """Return a value of an axis without its unit, which is that for values of some size."""
    factor = shown_unit(axis, value if size is None else size)[0]
    return "0" if abs(value) < _FINEST.get(axis, 0.0) else in_digits(value * factor)


def ends(axis: str, low: float, high: float) -> tuple[str, str]:
    """Return both ends of a range in the axis' unit, by :func:`same_decimals`; what no rig controls is 0.

    Examples
    --------
    >>> ends("time", 52.9, 60.0), ends("normal_load", 2600.0, 7785.0)
    (('52.9', '60.0'), ('2.60', '7.79'))
    """
    factor = shown_unit(axis, max(abs(low), abs(high)))[0]
    low, high = (0.0 if abs(value) < _FINEST.get(axis, 0.0) else value * factor for value in (low, high))
    return same_decimals(low, high)


def same_decimals(low: float, high: float) -> tuple[str, str]:
    """Return two numbers with the same decimals: as many as three digits of the larger one need.

    Decimals that both have as zeros are left out.

    Examples
    --------
    >>> same_decimals(52.9, 60.0), same_decimals(0.0523, 96.2), same_decimals(0.0, 60.0)
    (('52.9', '60.0'), ('0.1', '96.2'), ('0', '60'))
    """
    size = max(abs(low), abs(high))
    most = max(2 - int(np.floor(np.log10(size))), 0) if 0.0 < size < np.inf else 0
    exact = [round(value, most) for value in (low, high)]
    decimals = next((d for d in range(most) if [round(value, d) for value in exact] == exact), most)
    a, b = (_with_decimals(value, decimals) for value in (low, high))
    return a, b


def _with_decimals(value: float, decimals: int) -> str:
    if not np.isfinite(value):
        return "–"
    return f"{value:,.{decimals}f}" if round(value, decimals) else "0"


def label(axis: str) -> str:
    """Return the name of an axis in words."""
    return shown_unit(axis, 0.0).label


def interval(axis: str, low: float, high: float) -> str:
    """Return ``load 2.1 to 4.3 kN``, or ``speed 22.2 m/s`` where both ends are written alike."""
    size = max(abs(low), abs(high))
    _, unit, name = shown_unit(axis, size)
    a, b = ends(axis, low, high)
    return f"{name} {a if a == b else f'{a} to {b}'} {unit}".strip()


def gaussian(form: GaussianForm) -> str:
    """Return a Gaussian process in a sentence."""
    lengths = []
    for name, length in form.lengths.items():
        channel = name.removeprefix("rate of ")
        factor, unit, text = shown_unit(channel, length)
        per = "/s" if name != channel else ""
        lead = f"rate of {text}" if per else text
        lengths.append(f"{lead} ({length * factor:.2g} {unit}{per})".replace(" )", ")").replace("( ", "("))
    share = (
        "" if form.explained != form.explained else f"; it predicts {100.0 * max(form.explained, 0.0):.0f}%"
    )
    where = ", ".join(lengths)
    low = form.explained < 0.2
    return (
        f"{form.output.capitalize()}: {newtons(form.size)} N, changing with {where}{share}"
        + (" of the residual on sweeps that its fit has not seen" if share else "")
        + (": it depends on something that is not recorded, or lives in time as well" if low else "")
    )


_LONG_NUMBER = re.compile(r"(?<![\w.])\d+\.\d+(?:e[+-]?\d+)?", re.IGNORECASE)


def short_equation(text: str) -> str:
    """Return an equation whose numbers have the digits that a reader needs.

    Examples
    --------
    >>> short_equation("(-0.794313400734)*fy_slip*(lag(s, 0.0144927536232) - s)")
    '(-0.7943)*fy_slip*(lag(s, 0.01449) - s)'
    """
    return _LONG_NUMBER.sub(lambda found: f"{float(found[0]):.4g}", text)


def newtons(value: float) -> str:
    """Return a force with sensible digits."""
    return f"{value:,.0f}" if abs(value) >= 20.0 else f"{value:.2g}"


def in_words(text: str) -> str:
    """Return a text with the titles of effects in place of their names."""
    names = sorted(catalogue(), key=len, reverse=True)
    return re.sub(rf"\b({'|'.join(n for n in names if '_' in n)})\b", lambda m: catalogue()[m[1]].title, text)


def listed(texts: Sequence[str]) -> str:
    """Return ``a``, ``a or b``, ``a, b, or c``.

    Examples
    --------
    >>> listed(["wear", "temperature", "drift"])
    'wear, temperature, or drift'
    """
    return ", ".join([*texts[:-1], f"or {texts[-1]}"]) if len(texts) > 2 else " or ".join(texts)


def shortened(text: str) -> str:
    """Return what was found in a channel as it stands after the effect's title.

    Examples
    --------
    >>> shortened("pressure is wrong by 0.001 (kPa taken for Pa)")
    'pressure: kPa taken for Pa'
    """
    return re.sub(r"^(\S+) is wrong by \S+ \((.+)\)$", r"\1: \2", text)


def condition(text: str) -> str:
    """Return ``slip angle beyond ±4.2 deg`` from ``|slip_angle| above 0.0735 rad``."""
    found = re.fullmatch(r"\|(\w+)\| above (\S+) \S+", text)
    if found is None:
        return text
    value = float(found[2])
    beyond = "above " if found[1] == "normal_load" else "beyond ±"
    return f"{label(found[1])} {beyond}{shown(found[1], value)}"


def not_looked_for(absent: Mapping[str, str]) -> str:
    """Return in one sentence which effects could not be tested, by reason; "" if all could.

    Parameters
    ----------
    absent : mapping
        Name of an effect -> why the fit leaves it out. What is looked for without a fit is not among these.
    """
    by_reason: dict[str, list[str]] = {}
    for name, why in absent.items():
        if type(catalogue()[name]).detect is Effect.detect:
            by_reason.setdefault(why, []).append(catalogue()[name].title)
    reasons = [f"{', '.join(titles)} – {why}" for why, titles in by_reason.items()]
    return f"effects that could not be tested: {'; '.join(reasons)}" if reasons else ""


def place(axis: str, low: float, high: float, ranges: Mapping[str, tuple[float, float]]) -> str:
    """Return ``between 41 and 96 s``, ``at load above 4 kN``, ``at slip angle below -2 deg``."""
    size = max(abs(low), abs(high))
    _, unit, name = shown_unit(axis, size)
    a, b = ends(axis, low, high)
    lowest, highest = ranges.get(axis, (-np.inf, np.inf))
    near = 0.03 * (highest - lowest) if np.isfinite(highest - lowest) else 0.0
    if axis == "time":
        return f"between {a} and {b} s" if a != b else f"at {a} s"
    if a == b:
        return f"at {name} {a} {unit}".rstrip()
    if high >= highest - near and low > lowest + near:
        return f"at {name} above {a} {unit}".rstrip()
    if low <= lowest + near and high < highest - near:
        return f"at {name} below {b} {unit}".rstrip()
    return f"at {name} between {a} and {b} {unit}".rstrip()
