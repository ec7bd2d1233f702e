"""The head of a report: three sentences, and remarks beside them."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Head:
    """What a report says first.

    Parameters
    ----------
    causes : str
        Verdict and what was found; a sentence without its full stop.
    spot : str
        Where recording and simulation differ; a clause, "" where that says nothing.
    size : str
        How much, before and after; a clause, "" where nothing was corrected.
    todo : str
        What to do next; a sentence, "" where nothing is to be done.
    notes : tuple of str
        What a reader must know beside it, the most important first; each in sentences.
    equation : str
        What is known of the unexplained residual, in sentences; "" where nothing is.
    """

    causes: str
    spot: str = ""
    size: str = ""
    todo: str = ""
    notes: tuple[str, ...] = ()
    equation: str = ""

    @property
    def remarks(self) -> tuple[str, ...]:
        """Everything that stands beside the three sentences."""
        return (*self.notes, *filter(None, [self.equation]))

    @property
    def text(self) -> str:
        """The three sentences: verdict and names; where and how much; what to do next."""
        middle = "; ".join(filter(None, [self.spot, self.size]))
        sentences = [f"{part[:1].upper()}{part[1:]}." for part in (self.causes, middle) if part]
        return " ".join(filter(None, [*sentences, self.todo]))

    def beside(self, *notes: str) -> Head:
        """Return the head with notes before its own; empty ones are none."""
        return replace(self, notes=(*filter(None, notes), *self.notes))
