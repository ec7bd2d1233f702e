"""Files that are hashed together, where tasks are done: opening many takes long on a shared disk."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from tire_pipeline.retraining.scan.places import UNREADABLE, Place

FILES_HASHED = 1000
"""So many files are hashed together: a tenth of a second on a local disk."""


@dataclass(frozen=True)
class HashTogether:
    """Hashes the content of some files.

    Attributes
    ----------
    place : Place
    names : sequence of str
        As the place gives them.
    """

    place: Place
    names: Sequence[str]
    label = ""

    def __call__(self) -> dict[str, str]:
        """Name -> fingerprint (:meth:`.Place.fingerprints`).

        Raises
        ------
        UnreachableError
            An object store does not answer.
        """
        return dict(self.place.fingerprints(self.names))

    def split(self) -> dict[str, HashTogether]:
        """Each file by itself: to find the one that ends its process."""
        return {name: HashTogether(self.place, (name,)) for name in self.names}

    def join(self, parts: list[dict[str, str]]) -> dict[str, str]:
        """What those of :meth:`split` gave, as if this one had been done."""
        return {name: digest for part in parts for name, digest in part.items()}

    def lost(self, reason: str) -> dict[str, str]:
        """The result for a file that ends its process: reading it is tried anyway, to get the reason."""
        return dict.fromkeys(self.names, f"{UNREADABLE}{reason}")


def hash_in_blocks(place: Place, names: Sequence[str]) -> dict[str, HashTogether]:
    """Divide the files; each block by the name of its first file."""
    some = (names[start : start + FILES_HASHED] for start in range(0, len(names), FILES_HASHED))
    return {block[0]: HashTogether(place, block) for block in some}
