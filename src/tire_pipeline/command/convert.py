"""``tire convert``: a .tir file as another version."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from tire_pipeline.command.compare import compared
from tire_pipeline.command.options import FILE, check_target, output_options, radius_option
from tire_pipeline.command.outcome import CommandOutcome, finish


@click.command(
    help="Write FILE.tir as another version; say what the version cannot keep, and how forces change."
)
@click.argument("file", type=FILE, metavar="FILE.tir")
@click.option("--to", "version", required=True, help="5.0, 5.1, 5.2, PAC2002, 6.1 or 6.2.")
@click.option("-o", "--output", "target", type=FILE, help="The file to write; else FILE_VERSION.tir.")
@click.option("--overwrite", is_flag=True, help="Replace a file of that name.")
@radius_option
@output_options()
def command(
    file: Path,
    version: str,
    target: Path | None,
    overwrite: bool,
    radius: float | None,
    **output: Any,
) -> None:
    """Convert a file."""
    from tire_pipeline.magic_formula import conversion_notes
    from tire_pipeline.tir import read_tir, write_tir

    target = Path(f"{file.stem}_{version}.tir") if target is None else target
    check_target(target, overwrite, file)
    model = read_tir(file, unloaded_radius=radius)
    converted = model.to_version(version)
    notes = conversion_notes(model, version)
    said = f"converted from {model.version} to {version} by tire_pipeline; source file: {file.name}"
    write_tir(converted, target, comments=[said, *notes], overwrite=overwrite)
    again = read_tir(target)
    both = {file.name: model, target.name: again}
    result = compared(both, title=f"{file.name} as Magic Formula {version}", notes=notes)
    outcome = CommandOutcome(
        result.title,
        result.lines,
        {**result.data, "file": file, "output": target, "to": version, "notes": notes},
        result.page,
        result.grids[1:],
        notes,
        [target],
    )
    finish(outcome, f"{target.stem}_convert", **output)
