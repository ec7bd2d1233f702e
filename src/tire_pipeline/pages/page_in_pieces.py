"""A page that is too large to be in memory at once."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class PageInPieces:
    """A page whose text is made while it is written.

    Attributes
    ----------
    make : callable
        Begins to make it: gives its pieces, one after the other.

    Examples
    --------
    >>> str(PageInPieces(lambda: iter(["<p>", "tires"])))
    '<p>tires'
    """

    make: Callable[[], Iterator[str]]

    def __iter__(self) -> Iterator[str]:
        """Its pieces."""
        return self.make()

    def __str__(self) -> str:
        return "".join(self)
