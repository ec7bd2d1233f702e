"""Kedro datasets: tire property files and recordings, folders of them, model states, pages."""

from tire_pipeline.datasets.computed_folder import ComputedFolderDataset
from tire_pipeline.datasets.csv_table import CsvTableDataset
from tire_pipeline.datasets.folder import FolderDataset
from tire_pipeline.datasets.html_page import HtmlPageDataset
from tire_pipeline.datasets.ingest_store import IngestStoreDataset
from tire_pipeline.datasets.made_files import MadeFilesDataset
from tire_pipeline.datasets.recording_folder import RecordingFolderDataset
from tire_pipeline.datasets.release import ReleaseDataset
from tire_pipeline.datasets.state import StateDataset
from tire_pipeline.datasets.table_parts import TablePartsDataset
from tire_pipeline.datasets.text_folder import TextFolderDataset
from tire_pipeline.datasets.tir_file import TirDataset
from tire_pipeline.datasets.tir_folder import TirFolderDataset

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
