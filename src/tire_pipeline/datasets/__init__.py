"""Kedro datasets: tire property files and recordings, folders of them, model states, pages."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tire_pipeline.datasets.tables.csv_table import CsvTableDataset
    from tire_pipeline.datasets.tables.frame_parts import FramePartsDataset
    from tire_pipeline.datasets.tables.ingest_store import IngestStoreDataset
    from tire_pipeline.datasets.tables.previewed import ParquetTableDataset
    from tire_pipeline.datasets.tables.report_parts import ReportPartsDataset
    from tire_pipeline.datasets.tables.table_parts import TablePartsDataset
    from tire_pipeline.datasets.text_files.computed_folder import ComputedFolderDataset
    from tire_pipeline.datasets.text_files.html_page import HtmlPageDataset
    from tire_pipeline.datasets.text_files.json_file import JsonFileDataset, JsonItemsDataset
    from tire_pipeline.datasets.text_files.made_files import MadeFilesDataset
    from tire_pipeline.datasets.text_files.text_folder import TextFolderDataset
    from tire_pipeline.datasets.trained_models.model_state import StateDataset
    from tire_pipeline.datasets.trained_models.release import ReleaseDataset
    from tire_pipeline.datasets.users_files.folder import FolderDataset
    from tire_pipeline.datasets.users_files.recording_folder import RecordingFolderDataset
    from tire_pipeline.datasets.users_files.tir_file import TirDataset
    from tire_pipeline.datasets.users_files.tir_folder import TirFolderDataset

_MODULE_OF_DATASET = {
    "ComputedFolderDataset": "text_files.computed_folder",
    "CsvTableDataset": "tables.csv_table",
    "FolderDataset": "users_files.folder",
    "FramePartsDataset": "tables.frame_parts",
    "HtmlPageDataset": "text_files.html_page",
    "IngestStoreDataset": "tables.ingest_store",
    "JsonFileDataset": "text_files.json_file",
    "JsonItemsDataset": "text_files.json_file",
    "MadeFilesDataset": "text_files.made_files",
    "ParquetTableDataset": "tables.previewed",
    "RecordingFolderDataset": "users_files.recording_folder",
    "ReleaseDataset": "trained_models.release",
    "ReportPartsDataset": "tables.report_parts",
    "StateDataset": "trained_models.model_state",
    "TablePartsDataset": "tables.table_parts",
    "TextFolderDataset": "text_files.text_folder",
    "TirDataset": "users_files.tir_file",
    "TirFolderDataset": "users_files.tir_folder",
}

__all__ = [
    "ComputedFolderDataset",
    "CsvTableDataset",
    "FolderDataset",
    "FramePartsDataset",
    "HtmlPageDataset",
    "IngestStoreDataset",
    "JsonFileDataset",
    "JsonItemsDataset",
    "MadeFilesDataset",
    "ParquetTableDataset",
    "RecordingFolderDataset",
    "ReleaseDataset",
    "ReportPartsDataset",
    "StateDataset",
    "TablePartsDataset",
    "TextFolderDataset",
    "TirDataset",
    "TirFolderDataset",
]


def __getattr__(name: str) -> Any:
    """Import what is asked for, so that a run says that it starts before pandas and numba are loaded."""
    if name in _MODULE_OF_DATASET:
        return getattr(import_module(f"{__name__}.{_MODULE_OF_DATASET[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
