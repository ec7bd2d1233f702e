"""Names of effects and kinds of cases, as the issue and the mismatch catalogue spell them."""

from __future__ import annotations

PHYSICS: tuple[str, ...] = (
    "friction_scale",
    "stiffness_scale",
    "load_sensitivity",
    "camber",
    "combined_slip",
    "inflation_pressure",
    "temperature",
    "speed_dependence",
    "relaxation_length",
    "wear",
    "plysteer_conicity",
    "turn_slip",
    "nonuniformity",
    "compliance",
    "surface_change",
)
"""Physics that a case can conceal, one name an effect."""

ARTEFACTS: tuple[str, ...] = (
    "force_offset",
    "force_gain",
    "load_gain",
    "load_offset",
    "slip_angle_offset",
    "slip_ratio_offset",
    "camber_offset",
    "time_delay",
    "low_pass",
    "crosstalk",
    "sensor_drift",
    "sign_convention",
    "unit_error",
    "clipping",
    "stuck_channel",
)
"""What a rig or its wiring does to a recording."""

UNKNOWN_EFFECTS: tuple[str, ...] = (
    "backlash",
    "stick_slip",
    "load_rate",
    "slip_rate",
    "drum_seam",
    "rig_resonance",
    "friction_memory",
    "quantisation",
)
"""What no catalogue entry describes: it must stay unnamed."""

CASE_KINDS: tuple[str, ...] = ("nothing", "single", "pair", "ambiguous", "artefact", "unknown")
"""Kinds of cases."""

AMBIGUOUS_SETS: tuple[tuple[str, ...], ...] = (
    ("relaxation_length", "time_delay", "low_pass"),
    ("temperature", "wear"),
    ("plysteer_conicity", "force_offset", "slip_angle_offset", "camber_offset"),
    ("camber_offset", "plysteer_conicity", "force_offset", "slip_angle_offset"),
)
"""Names that one recording cannot separate: at a single speed; without the temperature channel and
without cooling; at a single load, camber and roll direction; and the same with a misread camber.

The last two are recorded by the same schedule, so what looks alike in one does so in the other. The key of
the first published proof left ``camber_offset`` out of the third set; ``ambiguous covered, first key`` is
scored as it was. In the first eight proofs the tires of the second set did cool, so that their temperature
was near its end value soon and looked like a friction factor, and hardly ever like wear.
"""

HEAT_OR_WEAR = 1
"""Which of ``AMBIGUOUS_SETS`` is recorded with tires that keep their heat."""
