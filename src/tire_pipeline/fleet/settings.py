"""What the demonstration fleet is made of: every number a user may change."""

from __future__ import annotations

from dataclasses import dataclass

from tire_pipeline.errors import DomainError

MANUFACTURERS: tuple[str, ...] = ("A", "B", "C", "D", "E", "F")
FOUR_TIRE_CATEGORIES: tuple[str, ...] = ("A", "B", "C", "D", "E")
FLEET_KINDS: tuple[str, ...] = ("additive", "interacting", "drifting")

# Shares of the 3,648 files: thesis, section 4.1 and Figure 4.1 (2,061 remain, D and E about 70%).
FULL_FILES = 3648
FULL_KEPT = 2061
FULL_MISSING = 320
FULL_TINY: dict[str, int] = {"G": 17, "H": 14, "I": 11, "J": 9, "K": 7}
KEPT_SHARES: dict[str, int] = {"A": 204, "B": 206, "C": 112, "D": 758, "E": 688, "F": 93}
MIN_CATEGORY = 24
SMALLEST_FLEET = 330


@dataclass(frozen=True)
class FleetSettings:
    """Settings of the demonstration fleet.

    Parameters
    ----------
    seed : int
        The same seed and settings give the same bytes.
    files : int
        Number of ``.tir`` files in the training fleet, those to be filtered out included.
    bias_size : float
        How far each manufacturer's regime lies from the common one: 1 is calibrated, 0 means the
        same surface, temperature, ranges and rig for all.
    kind : {"additive", "interacting", "drifting"}
        Whether the bias is alike for all tires, depends on compound and carcass, or whether
        manufacturers change their protocol half way.
    target : str
        The category whose files of the evaluation tires are sealed.
    compound_in_metadata : bool
        Write the compound class into the files (section ``[MODEL]``, key ``COMPOUND_CLASS``).
    paired_tires : int
        Physical tires of the training fleet that all six manufacturers measured.
    hidden_tires, tuning_tires : int
        Sizes of the two evaluation sets beside the four tires of the thesis.
    drifting : tuple of str
        Who changes protocol half way, for ``kind="drifting"``.
    variants : float
        Mean number of files of one physical tire in one category.
    threads : int
        Threads for the fits; has no influence on the result.

    Raises
    ------
    DomainError
        If a value is not allowed; the message says what is.
    """

    seed: int = 2025
    files: int = FULL_FILES
    bias_size: float = 1.0
    kind: str = "additive"
    target: str = "D"
    compound_in_metadata: bool = False
    paired_tires: int = 8
    hidden_tires: int = 100
    tuning_tires: int = 100
    drifting: tuple[str, ...] = ("E",)
    variants: float = 6.0
    threads: int = 2

    def __post_init__(self) -> None:
        where = "fleet settings"
        if self.kind not in FLEET_KINDS:
            raise DomainError(
                f"kind is {self.kind!r}", where=where, todo=f"use one of {', '.join(FLEET_KINDS)}"
            )
        if self.target not in FOUR_TIRE_CATEGORIES:
            raise DomainError(
                f"target is {self.target!r}",
                where=where,
                todo=f"use one of {', '.join(FOUR_TIRE_CATEGORIES)}",
            )
        if not 0.0 <= self.bias_size <= 1.5:
            raise DomainError(f"bias_size is {self.bias_size}", where=where, todo="use a value from 0 to 1.5")
        if self.files < SMALLEST_FLEET:
            raise DomainError(f"files is {self.files}", where=where, todo=f"use at least {SMALLEST_FLEET}")
        if min(self.hidden_tires, self.tuning_tires, self.threads) < 1:
            raise DomainError(
                "hidden_tires, tuning_tires and threads must be positive",
                where=where,
                todo="use 1 or more",
            )
        if not 0 <= self.paired_tires <= 12:
            raise DomainError(f"paired_tires is {self.paired_tires}", where=where, todo="use 0 to 12")
        if self.variants < 1.0:
            raise DomainError(f"variants is {self.variants}", where=where, todo="use 1 or more")
        unknown = set(self.drifting) - set(MANUFACTURERS)
        if unknown:
            raise DomainError(
                f"drifting names {sorted(unknown)}",
                where=where,
                todo=f"use some of {', '.join(MANUFACTURERS)}",
            )


@dataclass(frozen=True)
class FileCounts:
    """How many files of each sort a fleet holds.

    Attributes
    ----------
    kept : dict of str to int
        Files that remain after filtering, by category.
    copies : int
        Files with the same coefficients as another.
    missing : int
        Files in which a feature has no value.
    tiny : dict of str to int
        Files of categories under 20 files.
    """

    kept: dict[str, int]
    copies: int
    missing: int
    tiny: dict[str, int]


def file_counts(files: int) -> FileCounts:
    """Split a number of files as the thesis' 3,648 split (section 4.1).

    Parameters
    ----------
    files : int
        All files of the training fleet.

    Returns
    -------
    FileCounts
        Sums to ``files``; each of the six categories keeps at least 24.
    """
    scale = files / FULL_FILES
    kept_total = round(FULL_KEPT * scale)
    missing = round(FULL_MISSING * scale)
    tiny = {name: max(1, round(count * scale)) for name, count in FULL_TINY.items()}
    kept = {
        name: max(MIN_CATEGORY, int(share * kept_total / FULL_KEPT)) for name, share in KEPT_SHARES.items()
    }
    rest = kept_total - sum(kept.values())
    kept["D"] += rest - rest // 2
    kept["E"] += rest // 2
    copies = files - kept_total - missing - sum(tiny.values())
    return FileCounts(kept=kept, copies=copies, missing=missing, tiny=tiny)
