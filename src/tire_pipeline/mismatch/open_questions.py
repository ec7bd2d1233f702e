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
    """

    why: str
    todo: str
    verdict: str = ""

    @property
    def in_words(self) -> str:
        """The question in sentences."""
        lead = "Open: " if not self.verdict else ""
        text = f"{self.why[:1].upper()}{self.why[1:]}" if not lead else self.why
        todo = f"{self.todo[:1].upper()}{self.todo[1:]}"
        return f"{lead}{text}. {todo}. Nothing corrected is written before."
