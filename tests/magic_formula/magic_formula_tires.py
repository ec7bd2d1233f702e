"""Two made-up tires with every term at work, for tests that need no public data."""

from tire_pipeline.magic_formula import TireModel

_BOTH = {
    "FNOMIN": 4200.0, "UNLOADED_RADIUS": 0.32, "LONGVL": 16.7,
    "PCX1": 1.6, "PDX1": 1.15, "PDX2": -0.1, "PDX3": 2.0, "PEX1": 0.3, "PEX2": 0.1, "PEX3": 0.05,
    "PEX4": 0.1, "PKX1": 25.0, "PKX2": 3.0, "PKX3": 0.2, "PHX1": -0.001, "PHX2": 0.0005,
    "PVX1": 0.01, "PVX2": 0.004,
    "PCY1": 1.4, "PDY1": 1.05, "PDY2": -0.15, "PDY3": 1.5, "PEY1": -0.6, "PEY2": -0.3, "PEY3": 0.1,
    "PEY4": -5.0, "PKY1": -22.0, "PKY2": 1.9, "PKY3": 0.4, "PHY1": 0.002, "PHY2": 0.001,
    "PVY1": 0.02, "PVY2": -0.01, "PVY3": -0.4, "PVY4": -0.1,
    "QBZ1": 9.0, "QBZ2": -1.0, "QBZ3": 0.3, "QBZ4": 0.2, "QBZ5": -0.3, "QBZ9": 12.0, "QBZ10": 0.2,
    "QCZ1": 1.15, "QDZ1": 0.1, "QDZ2": -0.01, "QDZ3": 0.2, "QDZ4": 2.0, "QDZ6": 0.003, "QDZ7": -0.001,
    "QDZ8": -0.2, "QDZ9": 0.05, "QEZ1": -1.5, "QEZ2": 0.3, "QEZ3": 0.1, "QEZ4": 0.2, "QEZ5": -2.0,
    "QHZ1": 0.004, "QHZ2": -0.002, "QHZ3": 0.1, "QHZ4": 0.02,
    "RBX1": 12.0, "RBX2": 9.0, "RCX1": 1.05, "REX1": -0.4, "REX2": 0.1, "RHX1": 0.004,
    "RBY1": 11.0, "RBY2": 8.0, "RBY3": 0.02, "RCY1": 1.02, "REY1": -0.3, "REY2": 0.1,
    "RHY1": 0.005, "RHY2": 0.002, "RVY1": 0.03, "RVY2": -0.02, "RVY3": -0.3, "RVY4": 12.0,
    "RVY5": 1.9, "RVY6": -10.0, "SSZ1": 0.02, "SSZ2": 0.01, "SSZ3": 0.3, "SSZ4": -0.1,
    "QSX1": 0.002, "QSX2": 0.6, "QSX3": 0.04, "QSY1": 0.009, "QSY2": 0.01, "QSY3": 0.0005,
    "QSY4": 0.00003, "PTX1": 1.5, "PTX2": 0.3, "PTX3": 0.2, "PTY1": 1.8, "PTY2": 2.1,
    "LFZO": 0.93, "LCX": 1.04, "LMUX": 0.95, "LEX": 1.1, "LKX": 0.97, "LHX": 1.2, "LVX": 0.9,
    "LCY": 0.98, "LMUY": 0.92, "LEY": 1.05, "LKY": 1.06, "LHY": 0.9, "LVY": 1.1, "LTR": 0.95,
    "LRES": 1.1, "LXAL": 1.02, "LYKA": 0.96, "LVYKA": 1.05, "LS": 0.9, "LMX": 1.1, "LVMX": 0.95,
    "LMY": 1.07,
}  # fmt: skip
_ONLY_52 = {"PHY3": 0.03, "LGAX": 1.1, "LGAY": 0.95, "LGAZ": 1.05}
_ONLY_61 = {
    "NOMPRES": 220000.0, "PPX1": -0.4, "PPX2": 0.2, "PPX3": -0.1, "PPX4": -0.2, "PKY4": 1.8,
    "PKY5": 5.0, "PKY6": -0.8, "PKY7": 0.1, "PEY5": 10.0, "PPY1": 0.4, "PPY2": 0.7, "PPY3": -0.1,
    "PPY4": 0.05, "PPY5": -0.5, "QDZ10": 0.5, "QDZ11": -0.8, "PPZ1": -0.3, "PPZ2": 0.2, "RBX3": 40.0,
    "RBY4": 60.0, "QSX4": 3.0, "QSX5": 0.4, "QSX6": 1.1, "QSX7": 0.5, "QSX8": 3.0, "QSX9": 0.1,
    "QSX10": 0.4, "QSX11": 0.8, "QSX12": 0.3, "QSX13": 0.002, "QSX14": 0.04, "PPMX1": -0.1,
    "QSY5": 0.05, "QSY6": -0.03, "QSY7": 0.9, "QSY8": -0.4, "LKYC": 0.9, "LKZC": 1.08,
    "LONGITUDINAL_STIFFNESS": 380000.0, "LATERAL_STIFFNESS": 180000.0, "PCFX1": 0.1, "PCFX2": -0.05,
    "PCFX3": 0.2, "PCFY1": 0.2, "PCFY2": -0.1, "PCFY3": 0.3, "PDXP1": 0.4, "PDXP2": 0.1, "PDXP3": 0.2,
    "PKYP1": 1.0, "PDYP1": 0.4, "PDYP2": 0.1, "PDYP3": 0.2, "PDYP4": 0.1, "PHYP1": 1.0, "PHYP2": 0.15,
    "PHYP3": 0.05, "PHYP4": -4.0, "PECP1": 0.5, "PECP2": 0.1, "QDTP1": 10.0, "QCRP1": 0.2, "QCRP2": 0.1,
    "QBRP1": 0.1, "QDRP1": 1.0,
}  # fmt: skip


def tire_52() -> TireModel:
    return TireModel.from_coefficients({**_BOTH, **_ONLY_52}, "5.2")


def tire_61() -> TireModel:
    return TireModel.from_coefficients({**_BOTH, **_ONLY_61}, "6.1")
