"""What each stage of a fit finds: its output, its coefficients, their bounds and starting values."""

from __future__ import annotations

from dataclasses import dataclass

PURE_SLIP_RATIO = 0.02
"""Below this magnitude of slip ratio a point counts as pure lateral slip."""
PURE_SLIP_ANGLE = 0.01
"""Below this magnitude of slip angle (rad) a point counts as pure longitudinal slip."""
PURE_SLIP = {"slip_angle": PURE_SLIP_ANGLE, "slip_ratio": PURE_SLIP_RATIO}
"""Slip -> magnitude up to which it counts as none."""

BOUNDS: dict[str, tuple[float, float, float]] = {
    "PCY1": (1.0, 2.5, 1.35),
    "PDY1": (0.01, 4.0, 1.0),
    "PDY2": (-2.0, 2.0, -0.1),
    "PDY3": (-100.0, 100.0, 0.0),
    "PEY1": (-15.0, 1.0, -0.5),
    "PEY2": (-15.0, 15.0, 0.0),
    "PEY3": (-10.0, 10.0, 0.0),
    "PEY4": (-300.0, 300.0, 0.0),
    "PEY5": (-1000.0, 1000.0, 0.0),
    "PKY1": (-200.0, 200.0, -20.0),
    "PKY2": (0.2, 20.0, 1.8),
    "PKY3": (-15.0, 15.0, 0.0),
    "PKY4": (0.2, 8.0, 2.0),
    "PKY5": (-600.0, 600.0, 0.0),
    "PKY6": (-10.0, 10.0, 0.0),
    "PKY7": (-10.0, 10.0, 0.0),
    "PHY1": (-0.1, 0.1, 0.0),
    "PHY2": (-0.1, 0.1, 0.0),
    "PHY3": (-1.5, 1.5, 0.0),
    "PVY1": (-0.5, 0.5, 0.0),
    "PVY2": (-0.5, 0.5, 0.0),
    "PVY3": (-5.0, 5.0, 0.0),
    "PVY4": (-10.0, 10.0, 0.0),
    "PCX1": (1.0, 2.5, 1.6),
    "PDX1": (0.01, 4.0, 1.1),
    "PDX2": (-2.0, 2.0, -0.1),
    "PDX3": (-100.0, 100.0, 0.0),
    "PEX1": (-15.0, 1.0, 0.0),
    "PEX2": (-15.0, 15.0, 0.0),
    "PEX3": (-15.0, 15.0, 0.0),
    "PEX4": (-2.0, 2.0, 0.0),
    "PKX1": (1.0, 200.0, 25.0),
    "PKX2": (-100.0, 100.0, 0.0),
    "PKX3": (-3.0, 3.0, 0.0),
    "PHX1": (-0.1, 0.1, 0.0),
    "PHX2": (-0.1, 0.1, 0.0),
    "PVX1": (-0.5, 0.5, 0.0),
    "PVX2": (-0.5, 0.5, 0.0),
    "QBZ1": (0.5, 60.0, 10.0),
    "QBZ2": (-40.0, 40.0, 0.0),
    "QBZ3": (-40.0, 40.0, 0.0),
    "QBZ4": (-10.0, 10.0, 0.0),
    "QBZ5": (-10.0, 10.0, 0.0),
    "QBZ9": (0.0, 60.0, 8.0),
    "QCZ1": (0.7, 2.2, 1.15),
    "QDZ1": (-0.5, 0.5, 0.1),
    "QDZ2": (-0.5, 0.5, 0.0),
    "QDZ3": (-10.0, 10.0, 0.0),
    "QDZ4": (-100.0, 100.0, 0.0),
    "QDZ6": (-0.1, 0.1, 0.0),
    "QDZ7": (-0.1, 0.1, 0.0),
    "QDZ8": (-2.0, 2.0, 0.0),
    "QDZ9": (-2.0, 2.0, 0.0),
    "QDZ10": (-20.0, 20.0, 0.0),
    "QDZ11": (-20.0, 20.0, 0.0),
    "QEZ1": (-20.0, 1.0, -1.0),
    "QEZ2": (-15.0, 15.0, 0.0),
    "QEZ3": (-15.0, 15.0, 0.0),
    "QEZ4": (-3.0, 3.0, 0.0),
    "QEZ5": (-60.0, 60.0, 0.0),
    "QHZ1": (-0.1, 0.1, 0.0),
    "QHZ2": (-0.1, 0.1, 0.0),
    "QHZ3": (-2.0, 2.0, 0.0),
    "QHZ4": (-2.0, 2.0, 0.0),
    "RBX1": (0.5, 80.0, 10.0),
    "RBX2": (0.0, 80.0, 8.0),
    "RBX3": (-800.0, 800.0, 0.0),
    "RCX1": (0.5, 2.0, 1.0),
    "REX1": (-8.0, 1.0, -0.5),
    "REX2": (-8.0, 8.0, 0.0),
    "RHX1": (-0.1, 0.1, 0.0),
    "RBY1": (0.5, 80.0, 10.0),
    "RBY2": (0.0, 80.0, 8.0),
    "RBY3": (-0.3, 0.3, 0.0),
    "RBY4": (-2000.0, 2000.0, 0.0),
    "RCY1": (0.5, 2.0, 1.0),
    "REY1": (-8.0, 1.0, -0.2),
    "REY2": (-8.0, 8.0, 0.0),
    "RHY1": (-0.1, 0.1, 0.0),
    "RHY2": (-0.1, 0.1, 0.0),
    "RVY1": (-1.0, 1.0, 0.0),
    "RVY2": (-1.0, 1.0, 0.0),
    "RVY3": (-5.0, 5.0, 0.0),
    "RVY4": (0.0, 150.0, 10.0),
    "RVY5": (0.5, 4.0, 1.9),
    "RVY6": (-80.0, 80.0, -10.0),
    "SSZ1": (-1.0, 1.0, 0.0),
    "SSZ2": (-1.0, 1.0, 0.0),
    "SSZ3": (-5.0, 5.0, 0.0),
    "SSZ4": (-5.0, 5.0, 0.0),
    "QSX1": (-1.0, 1.0, 0.0),
    "QSX2": (-10.0, 10.0, 0.0),
    "QSX3": (-2.0, 2.0, 0.0),
    "QSX4": (-40.0, 40.0, 1.0),
    "QSX5": (-4.0, 4.0, 0.5),
    "QSX6": (0.0, 6.0, 1.0),
    "QSX7": (-4.0, 4.0, 0.0),
    "QSX8": (-15.0, 15.0, 1.0),
    "QSX9": (-5.0, 5.0, 0.1),
    "QSX10": (-5.0, 5.0, 0.1),
    "QSX11": (-6.0, 6.0, 1.0),
    "QSX12": (-50.0, 50.0, 0.0),
    "QSY1": (-0.1, 0.1, 0.01),
    "QSY2": (-2.0, 2.0, 0.0),
    "QSY3": (-0.1, 0.1, 0.0),
    "QSY4": (-0.01, 0.01, 0.0),
    "QSY5": (-5.0, 5.0, 0.0),
    "QSY6": (-5.0, 5.0, 0.0),
    "QSY7": (0.0, 2.5, 1.0),
    "QSY8": (-2.5, 2.5, 0.0),
}
"""Coefficient -> lower bound, upper bound, start. Pressure coefficients: -3 to 3 from 0."""

PRESSURE_BOUNDS = (-3.0, 3.0, 0.0)

LOAD = frozenset(
    [
        "PDY2",
        "PEY2",
        "PHY2",
        "PVY2",
        "PKY2",
        "PKY4",
        "PDX2",
        "PEX2",
        "PKX2",
        "PKX3",
        "PHX2",
        "PVX2",
        "QBZ2",
        "QDZ2",
        "QDZ7",
        "QEZ2",
        "QHZ2",
        "REX2",
        "REY2",
        "RHY2",
        "RVY2",
    ]
)
"""Coefficients that need loads that differ."""
LOAD_SQUARED = frozenset(["PEX3", "QBZ3", "QEZ3"])
CAMBER = frozenset(
    [
        "PDY3",
        "PEY4",
        "PEY5",
        "PKY3",
        "PKY5",
        "PHY3",
        "PKY6",
        "PVY3",
        "PDX3",
        "QBZ4",
        "QBZ5",
        "QDZ3",
        "QDZ4",
        "QDZ8",
        "QDZ10",
        "QEZ5",
        "QHZ3",
        "RBX3",
        "RBY4",
        "RVY3",
        "SSZ3",
        "QSX2",
        "QSX12",
        "QSX14",
        "QSY5",
    ]
)
"""Coefficients that need camber."""
CAMBER_AND_LOAD = frozenset(["PVY4", "PKY7", "QDZ9", "QDZ11", "QHZ4", "SSZ4", "QSY6"])
ONE_SIDED_SLIP = frozenset(["PHY1", "PHY2", "PVY1", "PVY2", "PEY3", "QDZ6", "QDZ7", "QEZ4", "QHZ1", "QHZ2"])
"""Coefficients that need slip angles of both signs."""
ONE_SIDED_RATIO = frozenset(["PHX1", "PHX2", "PVX1", "PVX2", "PEX4"])
"""Coefficients that need slip ratios of both signs."""
BY_PRESSURE = frozenset(
    ["PPY1", "PPY2", "PPY3", "PPY4", "PPY5", "PPX1", "PPX2", "PPX3", "PPX4", "PPZ1", "PPZ2"]
)
BY_SPEED = frozenset(["QSY3", "QSY4"])


@dataclass(frozen=True)
class Stage:
    """One stage: the output it fits, on which points, and over which coefficients.

    With ``braking_alone`` points at pure longitudinal slip join once it is known what the others determine.
    """

    title: str
    output: str
    points: str
    names: tuple[str, ...]
    only_6: tuple[str, ...] = ()
    not_6: tuple[str, ...] = ()
    braking_alone: bool = False

    def over(self, family: int) -> tuple[str, ...]:
        """Return the coefficients of a family of versions."""
        if family == 5:
            return self.names
        return tuple(n for n in self.names if n not in self.not_6) + self.only_6


def _names(text: str) -> tuple[str, ...]:
    return tuple(text.split())


STAGES: tuple[Stage, ...] = (
    Stage(
        "Fy at pure slip",
        "fy",
        "lateral",
        _names("PCY1 PDY1 PDY2 PDY3 PEY1 PEY2 PEY3 PEY4 PKY1 PKY2 PKY3 PHY1 PHY2 PHY3 PVY1 PVY2 PVY3 PVY4"),
        _names("PEY5 PKY4 PKY5 PKY6 PKY7 PPY1 PPY2 PPY3 PPY4 PPY5"),
        ("PHY3",),
    ),
    Stage(
        "Fy at combined slip",
        "fy",
        "combined",
        _names("RBY1 RBY2 RBY3 RCY1 REY1 REY2 RHY1 RHY2 RVY1 RVY2 RVY3 RVY4 RVY5 RVY6"),
        ("RBY4",),
        braking_alone=True,
    ),
    Stage(
        "Fx at pure slip",
        "fx",
        "longitudinal",
        _names("PCX1 PDX1 PDX2 PDX3 PEX1 PEX2 PEX3 PEX4 PKX1 PKX2 PKX3 PHX1 PHX2 PVX1 PVX2"),
        _names("PPX1 PPX2 PPX3 PPX4"),
    ),
    Stage(
        "Fx at combined slip",
        "fx",
        "combined",
        _names("RBX1 RBX2 RCX1 REX1 REX2 RHX1"),
        ("RBX3",),
    ),
    Stage(
        "Mz at pure slip",
        "mz",
        "lateral",
        _names(
            "QBZ1 QBZ2 QBZ3 QBZ4 QBZ5 QBZ9 QCZ1 QDZ1 QDZ2 QDZ3 QDZ4 QDZ6 QDZ7 QDZ8 QDZ9 QEZ1 QEZ2 QEZ3 "
            "QEZ4 QEZ5 QHZ1 QHZ2 QHZ3 QHZ4"
        ),
        _names("QDZ10 QDZ11 PPZ1 PPZ2"),
    ),
    Stage("Mz at combined slip", "mz", "combined", _names("SSZ1 SSZ2 SSZ3 SSZ4")),
    Stage(
        "Mx",
        "mx",
        "all",
        _names("QSX1 QSX2 QSX3"),
        _names("QSX4 QSX5 QSX6 QSX7 QSX8 QSX9 QSX10 QSX11 QSX12 PPMX1"),
    ),
    Stage("My", "my", "all", _names("QSY1 QSY2 QSY3 QSY4"), _names("QSY5 QSY6 QSY7 QSY8")),
)
"""In the order in which a fit goes through them: output by output, moments after forces."""
