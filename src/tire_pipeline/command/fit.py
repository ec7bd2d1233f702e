"""``tire fit``: recordings -> a tire model as a .tir file."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tire_pipeline.command.options import FILE, check_target, output_options, read_runs, reading_options
from tire_pipeline.command.outcome import CommandOutcome, Grid, finish, percent

if TYPE_CHECKING:
    from tire_pipeline.magic_formula import FitResult


@click.command(
    help="Fit a tire model to the recordings RUN (one tire; steady state, transients left out) and write it."
)
@click.argument("runs", type=FILE, nargs=-1, required=True, metavar="RUN...")
@click.option("-o", "--output", "target", type=FILE, required=True, help="The .tir file to write.")
@click.option("--version", default="5.2", show_default=True, help="Version of the Magic Formula.")
@click.option(
    "--start",
    type=FILE,
    help="A .tir file to start from; coefficients that the data leave open keep its values.",
)
@click.option("--nominal-load", type=float, help="FNOMIN, N. Default: that of --start, or the median load.")
@click.option(
    "--unloaded-radius",
    "--radius",
    "radius",
    type=click.FloatRange(0.0, min_open=True),
    metavar="METRES",
    help="Unloaded radius of the tire, m. Default: that of --start or of the recording.",
)
@click.option("--overwrite", is_flag=True, help="Replace a file of that name.")
@reading_options
@output_options()
def command(
    runs: tuple[Path, ...],
    target: Path,
    version: str,
    start: Path | None,
    nominal_load: float | None,
    radius: float | None,
    overwrite: bool,
    axes: tuple[str, ...],
    units: tuple[str, ...],
    names: tuple[str, ...],
    format_: str | None,
    **output: Any,
) -> None:
    """Fit a model."""
    from tire_pipeline.magic_formula import fit_magic_formula
    from tire_pipeline.recordings import join_recordings
    from tire_pipeline.recordings.issue import issue_in_words
    from tire_pipeline.recordings.slip_definition import slip_ratio_defined_otherwise
    from tire_pipeline.recordings.spikes import without_spikes
    from tire_pipeline.tir import read_tir, write_tir
    from tire_pipeline.tir.format.values import COMPUTED_DIGITS

    check_target(target, overwrite, *runs, *([start] if start else []))
    recordings, remarked = {}, []
    for name, run in read_runs(runs, axes=axes, units=units, names=names, format_=format_).items():
        recordings[name], remarks = without_spikes(run)
        remarked += [
            f"{name}: {said}" for said in [*remarks, *map(issue_in_words, slip_ratio_defined_otherwise(run))]
        ]
    several = len(recordings) > 1
    joined = join_recordings(recordings, forces_of_any=True) if several else next(iter(recordings.values()))
    result = fit_magic_formula(
        joined,
        version,
        None if start is None else read_tir(start),
        nominal_load=nominal_load,
        unloaded_radius=radius,
    )
    if start is None:
        result = replace(result, model=result.model_with_ranges)
    said = ", ".join(f"{name} {percent(value)}" for name, value in _fitted(result).items())
    write_tir(
        result.model,
        target,
        comments=[
            f"fitted by tire_pipeline to {', '.join(recordings)}",
            *_poor(result),
            f"RMS of residuals over the largest magnitude: {said}",
            *result.undetermined,
        ],
        digits=COMPUTED_DIGITS,
        overwrite=overwrite,
    )
    notes = [*remarked, *joined.attrs.get("notes", []), *result.notes]
    finish(_outcome(result, list(recordings), target, notes), f"{target.stem}_fit", **output)


def _fitted(result: FitResult) -> dict[str, float]:
    """The misfit of the outputs that were fitted."""
    return {name: value for name, value in result.relative_rms.items() if name not in result.not_fitted}


def _poor(result: FitResult) -> list[str]:
    """Fits that are not plausible for a tire, one sentence an output."""
    return [f"POOR FIT of {name.capitalize()}, not to be used: {text}" for name, text in result.poor.items()]


def _outcome(result: FitResult, runs: list[str], target: Path, notes: list[str]) -> CommandOutcome:
    model = result.model
    sizes = ", ".join(f"{n.capitalize()} {percent(v)}" for n, v in _fitted(result).items())
    lines = [
        *_poor(result),
        f"Magic Formula {model.version} fitted to {', '.join(runs)}: "
        f"{len(result.standard_errors)} coefficients, FNOMIN = {model.value('FNOMIN'):g} N.",
        f"RMS of the residuals, as a share of the largest magnitude: {sizes}.",
    ]
    if result.not_fitted:
        names = ", ".join(name.capitalize() for name in result.not_fitted)
        lines.append(f"{names}: recorded, but at no points that determine a coefficient; not fitted.")
    residuals = Grid(
        ("output", "load (N)", "camber (deg)", "points", "bias", "RMS", "largest", "RMS (%)"),
        [
            _row(row)
            for row in result.residuals.itertuples(index=False)
            if row.output not in result.not_fitted
        ],
        "Residuals, model minus measured, N or N m",
    )
    data = {
        "recordings": runs,
        "output": target,
        "version": model.version,
        "coefficients": dict(model.coefficients),
        "standard_errors": dict(result.standard_errors),
        "relative_rms": _fitted(result),
        "not_fitted": list(result.not_fitted),
        "poor": dict(result.poor),
        "undetermined": result.undetermined,
        "notes": notes,
    }

    def page() -> str:
        return _page(result, lines, residuals, notes, target)

    said = [f"not determined by the data: {text}" for text in result.undetermined]
    return CommandOutcome(target.name, lines, data, page, notes=[*said, *notes], written=[target])


def _row(row: Any) -> tuple[Any, ...]:
    camber = round(math.degrees(row.camber)) + 0
    name = str(row.output).capitalize()
    load = float(row.normal_load)
    return name, load, camber, int(row.count), row.bias, row.rms, row.largest, row.rms_percent


def _certain(value: float, error: float) -> tuple[float, float]:
    """Return a coefficient with the decimals that two digits of its standard error have; without one, all."""
    if not math.isfinite(error) or error <= 0.0:
        return value, error
    return round(value, 1 - math.floor(math.log10(error))), float(f"{error:.2g}")


def _page(result: FitResult, lines: list[str], residuals: Grid, notes: list[str], target: Path) -> str:
    import pandas as pd

    from tire_pipeline.errors import DomainError
    from tire_pipeline.magic_formula.fitting.report.plots import draw_fit
    from tire_pipeline.magic_formula.plots import draw_models
    from tire_pipeline.reporting import Figure, Table, Text, render_page

    parts: list[Any] = [Text(lines, emphasis=True)]
    try:
        parts.append(Figure(*draw_fit(result.model, result.measured), heading="Fit"))
    except DomainError:
        parts.append(Figure(*draw_models({target.name: result.model}), heading="The fitted model"))
    table = pd.DataFrame(
        [(n, *_certain(result.model.value(n), error)) for n, error in result.standard_errors.items()],
        columns=["coefficient", "value", "standard error"],
    )
    if result.undetermined:
        parts.append(Text(result.undetermined, heading="Not determined by the data"))
    if notes:
        parts.append(Text(notes, heading="Notes"))
    frame = pd.DataFrame(residuals.rows, columns=list(residuals.header))
    parts.append(
        Table(
            frame,
            f"{residuals.title}; loads and cambers in groups. RMS (%): of the largest magnitude.",
            "Residuals",
        )
    )
    said = "A dash: the coefficient ended at its bound."
    parts.append(Table(table, said, "Coefficients", digits=5, unlike=True, most_rows=400))
    return render_page(target.name, parts, footer=f"Made by tire fit, with {target.name}.")
