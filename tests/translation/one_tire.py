"""A tire with all coefficients of pure slip, and scale factors that are not one."""

# ruff: noqa: E501
TIRE = {
    "FNOMIN": 6000.0, "UNLOADED_RADIUS": 0.33,
    "PCX1": 1.6, "PDX1": 1.1, "PDX2": -0.1, "PDX3": 0.4, "PEX1": 0.2, "PEX2": 0.1, "PEX3": -0.05, "PEX4": 0.02,
    "PKX1": 22.0, "PKX2": -1.0, "PKX3": 0.2, "PHX1": 0.001, "PHX2": 0.0005, "PVX1": 0.003, "PVX2": 0.001,
    "PCY1": 1.4, "PDY1": 1.0, "PDY2": -0.15, "PDY3": 1.5, "PEY1": -0.6, "PEY2": -0.2, "PEY3": 0.05, "PEY4": 0.4,
    "PKY1": -18.0, "PKY2": 1.8, "PKY3": 0.4, "PHY1": 0.002, "PHY2": 0.001, "PHY3": 0.04, "PVY1": 0.01,
    "PVY2": -0.01, "PVY3": -0.1, "PVY4": -0.05,
    "QBZ1": 9.0, "QBZ2": -1.2, "QBZ3": 0.1, "QBZ4": 0.1, "QBZ5": -0.2, "QBZ9": 12.0, "QBZ10": 0.1, "QCZ1": 1.15,
    "QDZ1": 0.11, "QDZ2": -0.002, "QDZ3": 0.1, "QDZ4": 0.5, "QDZ6": 0.002, "QDZ7": 0.001, "QDZ8": -0.1,
    "QDZ9": -0.05, "QEZ1": -1.5, "QEZ2": 0.3, "QEZ3": 0.1, "QEZ4": 0.05, "QEZ5": 0.2, "QHZ1": 0.003, "QHZ2": 0.001,
    "QHZ3": 0.05, "QHZ4": 0.01,
}  # fmt: skip
SCALES = {
    "LMUY": 0.9,
    "LKY": 1.1,
    "LCY": 1.02,
    "LEY": 0.9,
    "LMUX": 0.95,
    "LKX": 1.05,
    "LTR": 0.9,
    "LRES": 1.1,
}
