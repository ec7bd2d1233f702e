"""Questions that come before any explanation, and what they stop while they are open."""

from __future__ import annotations

from dataclasses import dataclass

from tire_pipeline.mismatch.effects.sensor.repairs import AS_WELL


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
    removed : float, optional
        Share of the squared mismatch that is gone if what is asked is so. A set of effects that removes as
        much answers the question, and so does one effect that explains the mismatch alone: both need less to
        be assumed.
    figures : int
        How many properties of the tire are off if what is asked is so. As many effects assume no less.
    """

    why: str
    todo: str
    verdict: str = ""
    removed: float | None = None
    figures: int = 0

    def answered(self, left: float, by_one: bool) -> bool:
        """Whether sets of effects answer the question.

        Parameters
        ----------
        left : float
            Smallest share of the squared mismatch that a likely set of fewer effects than ``figures`` leaves.
        by_one : bool
            Whether one effect alone is likely to explain the mismatch.
        """
        return self.removed is not None and (by_one or left <= AS_WELL * (1.0 - self.removed))
