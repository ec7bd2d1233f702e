"""Recordings: from TYDEX, CSV, MDF4, MATLAB and Parquet files, and from driven vehicles."""

from tire_pipeline.recordings.axle.dart import DART_CAR, read_dart
from tire_pipeline.recordings.axle.single_track import axle_recording
from tire_pipeline.recordings.axle.vehicle import Vehicle
from tire_pipeline.recordings.check import check_recording
from tire_pipeline.recordings.issue import Issue
from tire_pipeline.recordings.join import join_recordings
from tire_pipeline.recordings.read import read_recording

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
