"""Tables of a small fleet's files."""

from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table import from_models


def table_of(files):
    """Tires of ``.tir`` texts by path; the folder is the category."""
    models = ((path, path.split("/")[-2], read_tir(text.encode("latin-1"))) for path, text in files.items())
    return from_models(models)
