"""Remarks beside a report's head: what the corrected model or the recording leaves out, and why."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

from tire_pipeline.channels import INPUT_CHANNELS
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.proof.measured import OutputFit
from tire_pipeline.mismatch.report.contents import EffectReport
from tire_pipeline.mismatch.report.words import newtons
from tire_pipeline.pages.first_letter import first_large

_NOTE = re.compile(rf"({'|'.join(INPUT_CHANNELS)}) is (?:.+ and )?left out: (.+?)(?:\. (?=[A-Z]).*)?")


def on_withheld(names: Sequence[str]) -> str:
    """Say which named effects are not in the corrected model."""
    if not names:
        return ""
    titles = " and ".join(catalogue()[n].title for n in names)
    return f"The corrected model leaves out {titles}: sweeps that its fit has not seen do not confirm it."


def on_part(names: Sequence[str], part: float) -> str:
    """Say how much of a change the corrected model adds."""
    if not names or round(100.0 * part) >= 100:
        return ""
    return (
        f"The corrected model applies {100.0 * part:.0f}% of the correction that was found: sweeps that its "
        "fit has not seen confirm at least that much, with 84% certainty."
    )


def on_several(effects: Sequence[EffectReport]) -> str:
    """Say what the corrected model adds where several explanations are open."""
    if not any(effect.alternatives for effect in effects):
        return ""
    return (
        "The recording leaves several explanations open, which differ on other recordings: there the "
        "corrected model adds only what they agree on. A written .tir file holds the likeliest one."
    )


def on_moments(spared: Mapping[str, OutputFit]) -> str:
    """Say which moments the corrected model leaves as they were: forces alone are fitted.

    Parameters
    ----------
    spared : mapping of str to OutputFit
        The errors that they would have with what was found.
    """
    worse = [
        f"{o.capitalize()} {newtons(f.rms_before)} N m before, {newtons(f.rms_after)} N m after"
        for o, f in spared.items()
    ]
    if not worse:
        return ""
    return (
        f"What was found is fitted to forces and would make moments worse (RMS error: {'; '.join(worse)}): "
        "the corrected model leaves these as they were."
    )


def on_expected(names: Sequence[str]) -> str:
    """Say which effects act in every tire, vary in the recording, and are too small here to be named."""
    if not names:
        return ""
    titles = " and ".join(catalogue()[n].title for n in names)
    acts, it, is_ = (
        ("act", "them", "their effects are") if len(names) > 1 else ("acts", "it", "its effect is")
    )
    return (
        f"{first_large(titles)} {acts} on every tire, and the tire model has no coefficient for "
        f"{it}: in this recording {is_} too small to be distinguished from the misfit of the formula."
    )


def reasons(notes: Iterable[str]) -> dict[str, str]:
    """Return why each channel that was recorded is left out, by what the notes say.

    Examples
    --------
    >>> reasons(["pressure is left out: 7.5 to 8 Pa is no tire's. State its unit"])
    {'pressure': "7.5 to 8 Pa is no tire's"}
    """
    found = (_NOTE.fullmatch(note) for note in notes)
    return {match[1]: match[2] for match in found if match}


def with_reasons(text: str, left_out: Mapping[str, str]) -> str:
    """Return a text that does not call a channel *not recorded* which was left out.

    Examples
    --------
    >>> with_reasons("pressure is not recorded", {"pressure": "its unit cannot be told"})
    'pressure is left out (its unit cannot be told)'
    """
    for channel, why in left_out.items():
        text = text.replace(f"{channel} is not recorded", f"{channel} is left out ({why})")
    return text


def state_units(notes: Iterable[str]) -> str:
    """Return what to do next where a channel is left out because of its unit; "" if none is.

    Examples
    --------
    >>> state_units(["pressure is left out: 75 Pa is no tire's, and its unit cannot be told. State it"])
    'State the unit of pressure, which is left out, and explain again.'
    """
    of = [channel for channel, why in reasons(notes).items() if "unit" in why]
    return f"State the unit of {' and '.join(of)}, which is left out, and explain again." if of else ""
