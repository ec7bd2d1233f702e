"""How often something comes out right in draws of the small rig's noise."""

from __future__ import annotations

from collections.abc import Callable

from tire_pipeline.concealed.scoring.rows import share_row

DRAWS = range(8)
EXPECTED = 0.9
"""Share of right draws that the interval (95%, Wilson) must not lie below."""


def check_most(right: Callable[[int], bool], what: str) -> None:
    """Ask each draw, say the share that is right with its interval and which are wrong, and check it."""
    told = [right(seed) for seed in DRAWS]
    row = share_row(what, told)
    wrong = [seed for seed, ok in zip(DRAWS, told, strict=True) if not ok]
    print(f"{row['value']:.2f} ({row['low']:.2f} to {row['high']:.2f}) of {row['n']}; wrong: {wrong}")
    assert row["high"] >= EXPECTED
