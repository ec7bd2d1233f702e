"""Recordings: from TYDEX, CSV, MDF4, MATLAB and Parquet files, and from driven vehicles."""

from tire_pipeline.recordings.axle import axle_recording
from tire_pipeline.recordings.check import Issue, check_recording
from tire_pipeline.recordings.dart import DART_CAR, read_dart
from tire_pipeline.recordings.join import join_recordings
from tire_pipeline.recordings.read import read_recording
from tire_pipeline.recordings.vehicle import Vehicle

__all__ = [
    "DART_CAR",
    "Issue",
    "Vehicle",
    "axle_recording",
    "check_recording",
    "join_recordings",
    "read_dart",
    "read_recording",
]
