"""Questions that come before any explanation, and what they stop while they are open."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Question:
    """A question that the recording does not answer.

    Parameters
    ----------
    why : str
        What is open, with figures.
    todo : str
        What settles it.
    verdict : str
        The report's verdict if nothing can be explained before it is settled; "" if effects can be looked
        for all the same, and only no corrected file may be written.
    by_sets : bool
        Whether sets of effects may be likelier than what is asked, and then answer it.
    likely : bool
        Whether it stays open unless they answer it. If not, it is asked only if it is likelier than any set.
    short : str
        What is open in two words, beside a verdict.
    """

    why: str
    todo: str
    verdict: str = ""
    by_sets: bool = False
    likely: bool = True
    short: str = "axes open"
