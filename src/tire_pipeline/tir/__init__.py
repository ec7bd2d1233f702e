"""The ``.tir`` text format: reading, writing, and the file kept as it is."""

from tire_pipeline.errors import TirError
from tire_pipeline.tir.reading.read import read_tir
from tire_pipeline.tir.sidecar import read_sidecar, write_sidecar
from tire_pipeline.tir.text.document import TirFile, parse_tir
from tire_pipeline.tir.writing.write import tir_bytes, write_tir

__all__ = [
    "TirError",
    "TirFile",
    "parse_tir",
    "read_sidecar",
    "read_tir",
    "tir_bytes",
    "write_sidecar",
    "write_tir",
]
