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
    remarks : tuple of str
        What a reader must know beside it, the most important first; each in sentences.
    """

    causes: str
    spot: str = ""
    size: str = ""
    todo: str = ""
    remarks: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The three sentences: verdict and names; where and how much; what to do next."""
        middle = "; ".join(filter(None, [self.spot, self.size]))
        sentences = [f"{part[:1].upper()}{part[1:]}." for part in (self.causes, middle) if part]
        return " ".join(filter(None, [*sentences, self.todo]))

    def beside(self, *remarks: str) -> Head:
        """Return the head with remarks before its own; empty ones are none."""
        return replace(self, remarks=(*filter(None, remarks), *self.remarks))
