"""Names of the channels that a tire is evaluated at, and of what it gives, in the order that arrays take."""

from __future__ import annotations

SLIP_AND_LOAD = ("slip_angle", "slip_ratio", "camber", "normal_load")
"""What every force depends on: rad, -, rad, N."""

POINT_CHANNELS = (*SLIP_AND_LOAD, "speed", "pressure")
"""An operating point, in the order in which the equations take it: m/s and Pa. Turn slip comes last."""

ANGLE_CHANNELS = ("slip_angle", "camber")
"""Angles of an operating point, rad."""

OPERATING_CHANNELS = (*POINT_CHANNELS, "tread_temperature")
"""What a recording may be looked at over: an operating point, and degC."""

FORCE_CHANNELS = ("fx", "fy", "mx", "my", "mz")
"""Forces (N) and moments (N m) in ISO W axes."""

RECORDED_CHANNELS = ("time", *OPERATING_CHANNELS, "turn_slip", *FORCE_CHANNELS)
"""Columns of a recording that have a meaning: s, an operating point, 1/m, forces and moments."""

TANGENTIAL_FORCES = ("fx", "fy")
"""Forces in the plane of the road, N."""
