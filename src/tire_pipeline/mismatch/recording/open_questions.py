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
        What settles it; goes on with a sentence.
    verdict : str
        The report's verdict if nothing can be explained before it is settled; "" if effects can be looked
        for all the same, and only no corrected file may be written.
    by_sets : bool
        Whether sets of effects may be likelier than what is asked, and then answer it.
    likely : bool
        Whether it stays open unless they answer it. If not, it is asked only if it is likelier than any set.
    short : str
        What is open in two words, beside a verdict.
    stated : tuple of str
        Texts of the findings that ``why`` states: they are no causes beside it.
    """

    why: str
    todo: str
    verdict: str = ""
    by_sets: bool = False
    likely: bool = True
    short: str = "axes open"
    stated: tuple[str, ...] = ()

    def beside(self, causes: str) -> str:
        """Return the question in a sentence without its full stop, before what was found all the same.

        Parameters
        ----------
        causes : str
            A clause; "" if nothing was.
        """
        if self.verdict:
            return self.why
        found = f"{'beside that' if self.stated else 'as it was read'}, {causes}" if causes else ""
        return "; ".join(filter(None, [f"open: {self.why}", found]))
