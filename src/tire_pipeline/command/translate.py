"""``tire translate``: a .tir file as another organisation would have measured the tire."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tire_pipeline.command.options import FILE, check_target, output_options, radius_option
from tire_pipeline.command.outcome import CommandOutcome, Grid, finish
from tire_pipeline.errors import DomainError
from tire_pipeline.pages.first_letter import first_large

if TYPE_CHECKING:
    from tire_pipeline.magic_formula import TireModel
    from tire_pipeline.translation.result import TranslationResult

USUAL_LOAD = 6000.0
_ASSUMED = (
    f"the translator does not say at which nominal load it has learned: {USUAL_LOAD:g} N, the default of "
    "normalize, is assumed; give --nominal-load if it was another"
)
_APPLIED = (
    "These differences are estimated from the training files. The less certain one is, the less of it is "
    "applied to the file."
)


@click.command(
    help="Write FILE.tir as the target organisation would have measured the tire, with a verdict and bands."
)
@click.argument("file", type=FILE, metavar="FILE.tir")
@click.option(
    "--model",
    "stored",
    type=FILE,
    help="Required. A fitted translator: its file, its versioned folder (the newest is taken) or a folder of "
    "releases.",
)
@click.option(
    "--from", "category", help="Who measured the tire. Default: the file's folder, if it is a known category."
)
@click.option("-o", "--output", "target", type=FILE, help="The file to write. Default: FILE_as_TARGET.tir.")
@click.option(
    "--nominal-load",
    type=float,
    help=f"Nominal load of the translator's training table, N. Default: the model's own, or {USUAL_LOAD:g}.",
)
@click.option(
    "--farthest",
    type=click.FloatRange(0.0, 3.0, min_open=True),
    default=1.0,
    show_default=True,
    help="Largest distance from the training data at which a tire is still translated; 1 is the edge.",
)
@click.option("--overwrite", is_flag=True, help="Replace a file of that name.")
@radius_option
@output_options()
def command(
    file: Path,
    stored: Path | None,
    category: str | None,
    target: Path | None,
    nominal_load: float | None,
    farthest: float,
    overwrite: bool,
    radius: float | None,
    **output: Any,
) -> None:
    """Translate a file."""
    from tire_pipeline.command.stored import no_translator, translator_state
    from tire_pipeline.tir import read_tir, write_tir
    from tire_pipeline.tir.format.values import COMPUTED_DIGITS
    from tire_pipeline.tir.reading.read import file_warnings
    from tire_pipeline.translation.base import judging, translator_from_state
    from tire_pipeline.translation.files.of_models import translate_models

    if stored is None:
        raise no_translator(Path())
    model = read_tir(file, unloaded_radius=radius)
    state, source = translator_state(stored)
    translator = judging(translator_from_state(state))
    target = Path(f"{file.stem}_as_{translator.target}.tir") if target is None else target
    check_target(target, overwrite, file)
    who = category or _folder(file, translator.categories)
    load = nominal_load or float(state.get("nominal_load", USUAL_LOAD))
    notes = file_warnings(model)
    notes += [] if nominal_load or "nominal_load" in state else [_ASSUMED]
    result, translated, comments = translate_models(
        translator, {file.name: (who, model)}, nominal_load=load, farthest=farthest
    )
    written = []
    for name, new in translated.items():
        said = comments[name]
        written.append(write_tir(new, target, comments=said, overwrite=overwrite, digits=COMPUTED_DIGITS))
    outcome = _outcome(file, model, translated.get(file.name), result, source, written, notes)
    finish(outcome, f"{file.stem}_translate", **output)


def _folder(file: Path, known: tuple[str, ...]) -> str:
    folder = file.resolve().parent.name
    if folder in known:
        return folder
    raise DomainError(
        "who measured this tire is not known",
        where=str(file),
        todo=f"add --from with one of {', '.join(known)}",
    )


def _outcome(
    file: Path,
    model: TireModel,
    translated: TireModel | None,
    result: TranslationResult,
    source: Path,
    written: list[Path],
    notes: list[str],
) -> CommandOutcome:
    said: Mapping[str, Any] = result.report.iloc[0].to_dict()
    bands = said.get("bias_band", "")
    lines = [
        f"Translation of {file.name}, measured by {said['source']}, to {said['target']}: {said['verdict']}.",
        *([f"{first_large(str(said['reason']))}."] if said["reason"] else []),
        *(f"{change}." for change in said["changes"].split("; ") if change),
        *([_APPLIED] if said["changes"] and translated is not None else []),
        *([f"Bias of {said['source']} against {said['target']} (90% bands): {bands}."] if bands else []),
    ]
    moved = [(r["coefficient"], r["from"], r["to"]) for r in result.coefficients.to_dict("records")]
    grid = Grid(("coefficient", "from", "to"), moved, "At the translator's nominal load")
    data = {
        "file": file,
        "model": source,
        **{name: said[name] for name in said if name != "file"},
        "coefficients": {name: [a, b] for name, a, b in moved},
    }

    def page() -> str:
        return _page(file, model, translated, result, lines, grid)

    return CommandOutcome(file.name, lines, data, page, notes=notes, written=written)


def _page(
    file: Path,
    model: TireModel,
    translated: TireModel | None,
    result: TranslationResult,
    lines: list[str],
    grid: Grid,
) -> str:
    import pandas as pd

    from tire_pipeline.reporting import Figure, Table, Text, render_page
    from tire_pipeline.reporting.translation.one_translation import draw_translation

    parts: list[Any] = [Text(lines, emphasis=True)]
    parts.append(Figure(*draw_translation(model, translated, result.bands), heading="Curves"))
    if grid.rows:
        frame = pd.DataFrame(grid.rows, columns=list(grid.header))
        said, heading = f"{grid.title}.", "Coefficients that moved"
        parts.append(Table(frame, said, heading, digits=5, unlike=True, most_rows=400))
    return render_page(file.name, parts, footer=f"tire translate {file.name}")
