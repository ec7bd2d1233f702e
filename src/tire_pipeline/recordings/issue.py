"""What a check of a recording finds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Issue:
    """One finding.

    Parameters
    ----------
    name : str
        Such as `no_force_channel`.
    severity : {"error", "warning"}
        With an error the recording cannot be explained.
    where : str
        Channel and position, in words.
    advice : str
        What can be done.
    rows : tuple of (int, int)
        First and last row of each place, at most 20 of them.

    See Also
    --------
    tire_pipeline.recordings.check_recording : What finds it.

    Notes
    -----
    Rows are counted from zero.

    Examples
    --------
    >>> Issue("no_force_channel", "error", "the recording", "give fx, fy or mz").severity
    'error'
    """

    name: str
    severity: Literal["error", "warning"]
    where: str
    advice: str
    rows: tuple[tuple[int, int], ...] = ()

    def __str__(self) -> str:
        return f"{self.severity}: {self.name} ({self.where}) -> {self.advice}"


def issue_in_words(issue: Issue) -> str:
    """Return what is wrong and what to do, for notes that give no severity."""
    return f"{issue.where}: {issue.advice}"
