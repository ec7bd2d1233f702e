"""The demonstration fleet: physical tires, six manufacturers' rigs and fits, ``.tir`` texts, sealed truth."""

from tire_pipeline.fleet.make import Fleet, make_fleet
from tire_pipeline.fleet.plan import FEATURES
from tire_pipeline.fleet.settings import MANUFACTURERS, FleetSettings
from tire_pipeline.fleet.truth import FleetTruth, true_curves
from tire_pipeline.fleet.write import read_truth_tables, write_fleet

__all__ = [
    "FEATURES",
    "MANUFACTURERS",
    "Fleet",
    "FleetSettings",
    "FleetTruth",
    "make_fleet",
    "read_truth_tables",
    "true_curves",
    "write_fleet",
]
