"""Kedro datasets: tire property files and recordings, folders of them, model states, pages."""

from tire_pipeline.datasets.models.release import ReleaseDataset
from tire_pipeline.datasets.models.state import StateDataset
from tire_pipeline.datasets.tables.csv_table import CsvTableDataset
from tire_pipeline.datasets.tables.ingest_store import IngestStoreDataset
from tire_pipeline.datasets.tables.table_parts import TablePartsDataset
from tire_pipeline.datasets.texts.computed_folder import ComputedFolderDataset
from tire_pipeline.datasets.texts.html_page import HtmlPageDataset
from tire_pipeline.datasets.texts.made_files import MadeFilesDataset
from tire_pipeline.datasets.texts.text_folder import TextFolderDataset
from tire_pipeline.datasets.users_files.folder import FolderDataset
from tire_pipeline.datasets.users_files.recording_folder import RecordingFolderDataset
from tire_pipeline.datasets.users_files.tir_file import TirDataset
from tire_pipeline.datasets.users_files.tir_folder import TirFolderDataset

__all__ = [
    "ComputedFolderDataset",
    "CsvTableDataset",
    "FolderDataset",
    "HtmlPageDataset",
    "IngestStoreDataset",
    "MadeFilesDataset",
    "RecordingFolderDataset",
    "ReleaseDataset",
    "StateDataset",
    "TablePartsDataset",
    "TextFolderDataset",
    "TirDataset",
    "TirFolderDataset",
]
