"""The regimes as a Markdown table, so that the documentation cannot say anything else."""

from __future__ import annotations

from tire_pipeline.fleet.rig.regimes import COMMON, MANUFACTURER_FIELDS, REGIMES


def regimes_markdown() -> str:
    """Table of every manufacturer's regime beside the common one; equal values are left blank.

    Returns
    -------
    str
    """
    names = ["common", *REGIMES]
    lines = ["| | " + " | ".join(names) + " |", "|---" * (len(names) + 1) + "|"]
    for field in MANUFACTURER_FIELDS:
        common = getattr(COMMON, field)
        cells = [f"{common:g}"]
        for regime in REGIMES.values():
            value = getattr(regime, field)
            cells.append("" if value == common else f"{value:g}")
        lines.append(f"| `{field}` | " + " | ".join(cells) + " |")
    return "\n".join(lines)
