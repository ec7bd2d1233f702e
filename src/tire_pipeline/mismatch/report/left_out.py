"""Channels that were recorded and are left out: a report says so, with the reason."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from tire_pipeline.channels import INPUT_CHANNELS

_NOTE = re.compile(rf"({'|'.join(INPUT_CHANNELS)}) is (?:.+ and )?left out: (.+?)(?:\. (?=[A-Z]).*)?")


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
