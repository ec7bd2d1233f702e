"""The demonstration fleet: physical tires, six manufacturers' rigs and fits, ``.tir`` texts, sealed truth."""

from .make import Fleet, make_fleet
from .plan import FEATURES
from .settings import MANUFACTURERS, FleetSettings
from .truth import Truth, true_curves
from .write import read_truth_tables, write_fleet

__all__ = [
    "FEATURES",
    "MANUFACTURERS",
    "Fleet",
    "FleetSettings",
    "Truth",
    "make_fleet",
    "read_truth_tables",
    "true_curves",
    "write_fleet",
]
