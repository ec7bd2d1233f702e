"""The results of ``reproduce_thesis`` as files: every table as CSV, every figure as SVG."""

from __future__ import annotations

from tire_pipeline.pages.safe_csv import safe_table
from tire_pipeline.thesis.pages.figures import all_drawings
from tire_pipeline.thesis.result_tables import Results


def result_files(results: Results) -> dict[str, str]:
    """Return every table as CSV and every figure as SVG, by file name."""
    out = {f"{name}.csv": safe_table(frame).to_csv(index=False) for name, frame in results.frames.items()}
    out["tables_5_10_to_5_21.csv"] = safe_table(results.beside).to_csv(index=False)
    for name, drawn in all_drawings(results).items():
        out[f"{name}.svg"] = '<?xml version="1.0" encoding="UTF-8"?>\n' + str(drawn.svg)
    return out
