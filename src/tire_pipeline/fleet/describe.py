"""The regimes as a Markdown table, so that the documentation cannot say anything else."""

from __future__ import annotations

from tire_pipeline.fleet.rig.regimes import COMMON, MANUFACTURER_FIELDS, REGIMES

RIG_SETTINGS = {
    "adhesion": "factor on friction by adhesion (fine grit)",
    "hysteresis": "factor on friction by hysteresis (coarse texture)",
    "curvature_radius": "1 / drum radius, 1/m; 0 is a flat belt",
    "rig_compliance": "slip angle lost, rad per N of side force",
    "speed": "m/s",
    "sweep_rate": "rad/s of slip angle",
    "filter_time": "time constant of the force filter, s",
    "both_directions": "1: mean of both sweep directions; 0: one of them",
    "preheat": "tread temperature at the start, degC",
    "ambient": "temperature of its surroundings, degC",
    "heating": "K per J of friction work",
    "conditioning": "share of the run-in that is done before",
    "pressure": "test pressure over nominal pressure",
    "load_low": "lowest load over rated load",
    "load_high": "highest load over rated load",
    "slip_range": "largest slip angle, rad",
    "camber_range": "largest camber, rad",
    "slip_ratio_range": "largest slip ratio",
    "symmetrise": "share of conicity and ply steer that is removed",
}
"""What each setting of a rig is, with its unit."""


def regimes_markdown() -> str:
    """Table of every manufacturer's regime beside the common one; equal values are left blank.

    Returns
    -------
    str
    """
    head = ["setting", "common", *REGIMES]
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    for field in MANUFACTURER_FIELDS:
        common = getattr(COMMON, field)
        cells = [f"{common:g}"]
        for regime in REGIMES.values():
            value = getattr(regime, field)
            cells.append("" if value == common else f"{value:g}")
        lines.append(f"| `{field}`: {RIG_SETTINGS[field]} | " + " | ".join(cells) + " |")
    return "\n".join(lines)
