"""``tire explain``: where a .tir file and recordings differ, and why."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tire_pipeline.channels import unit_of
from tire_pipeline.command.options import (
    FILE,
    check_target,
    output_options,
    radius_option,
    read_runs,
    reading_options,
    same_file,
)
from tire_pipeline.command.outcome import CommandOutcome, Grid, finish, three_digits
from tire_pipeline.errors import RecordingError, TirePipelineError

if TYPE_CHECKING:
    from tire_pipeline.mismatch import EffectReport, MismatchReport
    from tire_pipeline.mismatch.report.contents import HeldOutFit

NO_TIRE = "-"


@click.command(
    help="Say where FILE.tir and the recordings RUN differ, what the model left out, and how much of the "
    "error is gone on sweeps that took no part in the fit. Several recordings of the tire are explained "
    "together, in the order given. "
    "FILE.tir may be -, if the recordings hold the simulated force (simulated_fy or simulated_fx)."
)
@click.argument("file", type=FILE, metavar="FILE.tir")
@click.argument("runs", type=FILE, nargs=-1, required=True, metavar="RUN...")
@click.option(
    "--hold-out",
    type=FILE,
    metavar="RUN",
    help="A recording that is not used for the explanation: the explained model predicts it, and the page "
    "says how well.",
)
@click.option(
    "--without",
    "without",
    multiple=True,
    metavar="EFFECT",
    help="An effect of the catalogue that is not looked for; may be given several times.",
)
@click.option("--corrected", type=FILE, help="Write the corrected .tir file here.")
@click.option("--overwrite", is_flag=True, help="Replace a corrected file of that name.")
@radius_option
@reading_options
@output_options("-o")
def command(
    file: Path,
    runs: tuple[Path, ...],
    hold_out: Path | None,
    without: tuple[str, ...],
    corrected: Path | None,
    overwrite: bool,
    radius: float | None,
    axes: tuple[str, ...],
    units: tuple[str, ...],
    names: tuple[str, ...],
    format_: str | None,
    **output: Any,
) -> None:
    """Explain a mismatch."""
    from tire_pipeline.mismatch import Explainer, explain_recordings
    from tire_pipeline.recordings.conventions.canonical import notes_beside_assumed
    from tire_pipeline.reporting.mismatch.explained_recordings import check_effects
    from tire_pipeline.tir import read_tir

    models = [run for run in runs if run.suffix.lower() == ".tir"]
    if models and file.suffix.lower() != ".tir":
        raise RecordingError("this is no recording", where=str(models[0]), todo="give the .tir file first")
    if corrected is not None:
        if str(file) == NO_TIRE:
            raise RecordingError("without a .tir file there is none to correct", todo="leave --corrected out")
        check_target(corrected, overwrite, file, option="--corrected")
    check_effects(without, "--without")
    tire = None if str(file) == NO_TIRE else read_tir(file, unloaded_radius=radius)
    paths = list(runs) if hold_out is None or _among(hold_out, runs) in runs else [*runs, hold_out]
    read = read_runs(paths, axes=axes, units=units, names=names, format_=format_)
    by_path = dict(zip(paths, read, strict=True))
    held_out = by_path[_among(hold_out, runs)] if hold_out else None
    report = explain_recordings(tire, read, held_out=held_out, explainer=Explainer(without=without))
    if len(read) == 1:
        report.notes[:0] = notes_beside_assumed(next(iter(read.values())))
    written, refusal = [], None
    if corrected:
        try:
            written = [report.corrected.to_tir(corrected, overwrite=overwrite)]
        except TirePipelineError as error:
            refusal = error
    stem = runs[0].stem if str(file) == NO_TIRE else file.stem
    finish(_outcome(report, file, written), f"{stem}_explain", **output)
    if refusal is not None:  # after the result has been printed
        raise refusal


def _among(hold_out: Path, runs: tuple[Path, ...]) -> Path:
    """The recording that is meant: one of those given, by path or name, or a further file."""
    meant = [run for run in runs if same_file(run, hold_out)] or [r for r in runs if r.name == str(hold_out)]
    if len(meant) > 1:
        raise RecordingError(
            f"--hold-out {hold_out} may be {' or '.join(map(str, meant))}",
            todo="give the path of one of them",
        )
    return meant[0] if meant else hold_out


def _rows(effect: EffectReport) -> list[tuple[str, ...]]:
    """One row a parameter of an effect, or one without; a fault found without a fit names its channel."""
    name = f"{effect.name} of {effect.output}" if "found" in effect.evidence else effect.name
    return [(name, effect.kind, *row) for row in effect.rows() or [("", "", "", "")]]


def _outcome(report: MismatchReport, file: Path, written: list[Path]) -> CommandOutcome:
    grids = [_errors(report)]
    if report.effects:
        grids.append(_found(report.effects))
    if report.each:
        grids.append(_each(report.each))
    if report.held_out is not None:
        grids.append(_held_out(report.held_out))
    lines = [report.summary, *report.head.remarks]
    if report.assumed:
        lines.append(f"How the recording was read: {'; '.join(report.assumed)}.")
    return CommandOutcome(
        f"{file} and {', '.join(report.recordings)}: {report.stated_verdict}",
        lines,
        {"file": file, **report.to_dict()},
        lambda: _page(report),
        grids,
        report.notes,
        written,
    )


def _errors(report: MismatchReport) -> Grid:
    from tire_pipeline.mismatch.report.report_page import range_of

    return Grid(
        ("output", "noise", "RMS before", "RMS after", "95% interval", "unit"),
        [
            (
                name.capitalize(),
                *map(three_digits, (fit.noise_floor, fit.rms_before, fit.rms_after)),
                range_of(fit.rms_after_low, fit.rms_after_high),
                unit_of(name),
            )
            for name, fit in report.fit.items()
        ],
        "On held-out sweeps",
    )


def _found(effects: list[EffectReport]) -> Grid:
    return Grid(
        ("effect", "kind", "parameter", "value", "95% interval", ""),
        [row for effect in effects for row in _rows(effect)],
        "Found: parameters of the effects' equations, which the page shows. Where parameters of one "
        "effect act alike, each alone is less certain than the effect",
    )


def _each(fits: Sequence[HeldOutFit]) -> Grid:
    return Grid(
        ("recording", "output", "RMS before", "RMS after", "unit"),
        [
            (fit.recording, n.capitalize(), three_digits(e.rms_before), three_digits(e.rms_after), unit_of(n))
            for fit in fits
            for n, e in fit.errors.items()
        ],
        "In each recording that was explained",
    )


def _held_out(fit: HeldOutFit) -> Grid:
    from tire_pipeline.mismatch.report.report_page import range_of

    return Grid(
        ("output", "RMS before", "RMS after", "after, of before (95%)"),
        [
            (
                n.capitalize(),
                three_digits(e.rms_before),
                three_digits(e.rms_after),
                range_of(e.ratio_low, e.ratio_high),
            )
            for n, e in fit.errors.items()
        ],
        f"On {fit.recording}, which was held out",
    )


def _page(report: MismatchReport) -> str:
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        return report.to_html(Path(folder) / "page.html").read_text(encoding="utf-8")
