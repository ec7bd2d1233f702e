"""``tire show``: what a .tir file holds."""

from __future__ import annotations

import math
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tire_pipeline.channels import shown_unit
from tire_pipeline.command.options import CAMBER_OPTION, FILE, LOAD_OPTION, output_options, radius_option
from tire_pipeline.command.outcome import NO_UNIT, CommandOutcome, Grid, digits, finish, three_digits
from tire_pipeline.pages.numbers_in_words import first_of
from tire_pipeline.unit_definitions import DEGREE

if TYPE_CHECKING:
    import pandas as pd

    from tire_pipeline.magic_formula import TireModel
    from tire_pipeline.magic_formula.key_figures import KeyFigure

_NAMES_SHOWN = 12
_SHAPE_AND_LEVEL = {"PCX1": "PDX1", "PCY1": "PDY1"}
"""The shape factor of a force, which means nothing without its level."""
_FIRST = (
    "cornering stiffness",
    "largest lateral friction",
    "slip stiffness",
    "largest longitudinal friction",
)
"""The key figures that a reader asks for first."""
_PEAKS = {
    "slip angle of the peak": "largest lateral friction",
    "slip ratio of the peak": "largest longitudinal friction",
}
"""Where a peak lies, which may be beyond the range of the file -> the force that has it."""
_MOMENT = ("QDZ", "SSZ")
"""Beginnings of the coefficients without which there is no trail, residual moment or arm of Fx."""


@click.command(help="Show what FILE.tir holds: version, ranges, key figures, what is missing, curves.")
@click.argument("file", type=FILE, metavar="FILE.tir")
@click.option(
    "--load", "loads", type=LOAD_OPTION, multiple=True, help="Normal load of a curve, N; can be repeated."
)
@click.option(
    "--camber", type=CAMBER_OPTION, default=0.0, show_default=True, help="Camber of the curves, deg."
)
@radius_option
@output_options("-o")
def command(file: Path, loads: tuple[float, ...], camber: float, radius: float | None, **output: Any) -> None:
    """Show a file."""
    from tire_pipeline.magic_formula.forces import MissingRadiusWarning
    from tire_pipeline.tir import read_tir

    model = read_tir(file, unloaded_radius=radius)
    warnings.simplefilter("ignore", MissingRadiusWarning)  # a note of the result says it
    finish(_outcome(model, file, loads, camber), f"{file.stem}_show", **output)


def _outcome(model: TireModel, file: Path, loads: tuple[float, ...], camber: float) -> CommandOutcome:
    from tire_pipeline.magic_formula.key_figures import key_figures
    from tire_pipeline.tir.reading.plausibility import unlike_iso
    from tire_pipeline.tir.reading.read import file_warnings

    figures = key_figures(model)
    ranges = {name: (low, high) for name, (*_, low, high) in model.ranges.items()}
    load = model.value("FNOMIN")
    factor, unit, _ = shown_unit("normal_load", load)
    lines = [
        f"Magic Formula {model.version}, nominal load {load * factor:g} {unit}, "
        f"{len(model.coefficients)} coefficients."
    ]
    lines += _in_short(figures)
    missing = _replaced(model)
    if missing:
        lines.append(f"Missing: {_missing(missing)}.")
    values = {figure.name: figure.value for figure in figures}
    lines += _gaps(model, values)
    turned = unlike_iso(model.coefficients)
    turned += [] if turned else _mirrored_camber(values["camber stiffness"] / DEGREE / load)
    lines += [f"{said}." for said in turned]
    odd = [said for said in file_warnings(model) if said not in turned]
    held = {f.name for f in figures if f.value == f.value}
    open_peaks = {peak for peak, force in _PEAKS.items() if force in held}
    key = Grid(
        ("quantity", "value", "unit"),
        [
            (f.name, three_digits(f.value), f.unit or NO_UNIT)
            for f in figures
            if f.value == f.value or f.name in open_peaks
        ],
        "At the nominal load, no camber",
    )
    valid = Grid(("valid for", "from", "to", "unit"), [_range(n, *ends) for n, ends in ranges.items()])
    data = {
        "file": file,
        "version": model.version,
        "coefficients": dict(model.coefficients),
        "missing": dict(model.defaulted),
        "ranges": ranges,
        "key_figures": {f.name: {"value": f.value, "unit": f.unit} for f in figures},
        "warnings": [*turned, *odd],
    }
    grids = [key, *([valid] if ranges else [])]

    def page() -> str:
        return _page(model, file, lines, grids, odd, loads, camber)

    return CommandOutcome(file.name, lines, data, page, grids, odd)


def _mirrored_camber(thrust: float) -> list[str]:
    """Say that camber pushes the tire away from the side to which it leans, by as much as none does.

    Parameters
    ----------
    thrust : float
        Side force over the load to the side of the lean, 1/rad.
    """
    from tire_pipeline.magic_formula.parameters.camber_thrust import LEAST_THRUST

    if not thrust < -LEAST_THRUST:
        return []
    return [
        "With camber the side force points away from the side to which the wheel leans "
        f"({digits(three_digits(-thrust))} times the load per rad): the file was made in other axes than ISO "
        "W, or with the camber of the other sign"
    ]


def _in_short(figures: list[KeyFigure]) -> list[str]:
    """How stiff the tire is and how well it grips, in a sentence; nothing of what it does not give."""
    known = [
        f"{figure.name} {digits(three_digits(figure.value))} {figure.unit}".strip()
        for figure in figures
        if figure.name in _FIRST and figure.value > 0.0
    ]
    return [f"At the nominal load: {', '.join(known)}."] if known else []


def _gaps(model: TireModel, figures: dict[str, float]) -> list[str]:
    """What a simulation with this file lacks."""
    gaps = []
    relaxes = any(value > 0.0 for name, value in figures.items() if "relaxation" in name)
    if not relaxes and not model.lacks_radius:  # a note says what a missing radius leaves out
        gaps.append("There are no relaxation lengths: forces follow the slip at once.")
    if all(model.value(name) == 0.0 for name in ("RBX1", "RBY1")):
        gaps.append("There is no combined slip: braking and cornering do not weaken each other.")
    if not model.value("PDX1"):
        gaps.append("There is no longitudinal force: PDX1 is 0 or missing.")
    if not model.value("PDY1"):
        gaps.append("There is no side force: PDY1 is 0 or missing.")
    elif math.isnan(figures["cornering stiffness"]):
        gaps.append("The side force does not follow the slip angle: the cornering stiffness (PKY1) is 0.")
    if not any(value for name, value in model.coefficients.items() if name.startswith(_MOMENT)):
        gaps.append("There is no aligning moment.")
    if not model.ranges:
        gaps.append("No ranges are stated: the file does not say for which slips and loads it is valid.")
    return gaps


def _replaced(model: TireModel) -> dict[str, float]:
    """What the file lacks and a value stands in for; of a radius or a whole force a sentence speaks."""
    none = tuple(name for name, level in _SHAPE_AND_LEVEL.items() if not model.value(level))
    return {name: value for name, value in model.defaulted.items() if value == value and name not in none}


def _missing(missing: dict[str, float]) -> str:
    return f"{first_of(list(missing), _NAMES_SHOWN)} (0 is used, or the value that changes nothing)"


def _range(name: str, low: float, high: float) -> tuple[str, float, float, str]:
    factor, unit, _ = shown_unit(name, max(abs(low), abs(high)))
    return name.replace("_", " "), low * factor, high * factor, unit or NO_UNIT


def _by_section(model: TireModel) -> dict[str, pd.DataFrame]:
    """The coefficients with their meaning, in the sections of a .tir file and in their order."""
    import pandas as pd

    from tire_pipeline.tir.format.layout import describe, home_section

    given = pd.DataFrame(
        [
            (home_section(name), name, value, describe(home_section(name), name))
            for name, value in model.coefficients.items()
        ],
        columns=["section", "coefficient", "value", "meaning"],
    )
    return {
        str(section).replace("_", " ").capitalize(): rows.drop(columns="section")
        for section, rows in given.groupby("section", sort=False)
    }


def _page(
    model: TireModel,
    file: Path,
    lines: list[str],
    grids: list[Grid],
    odd: list[str],
    loads: tuple[float, ...],
    camber: float,
) -> str:
    import pandas as pd

    from tire_pipeline.magic_formula.plots import draw_models
    from tire_pipeline.reporting import Figure, Table, Text, render_page

    figure = draw_models({file.name: model}, loads=loads or None, camber=math.radians(camber))
    absent = pd.DataFrame(_replaced(model).items(), columns=["coefficient", "value used"])
    parts: list[Any] = [Text(lines, emphasis=True), Figure(*figure, heading="Curves")]
    if odd:
        parts.append(Text(odd, heading="What is unusual in the file"))
    headings = ("Key figures", "Ranges")
    for grid, heading in zip(grids, headings, strict=False):
        frame = pd.DataFrame(grid.rows, columns=list(grid.header))
        parts.append(Table(frame, grid.title, heading, digits=4, unlike=True))
    if len(absent):
        parts.append(
            Table(
                absent,
                "Not in the file. The value used is 0, or the one that changes nothing in the equations.",
                "Missing",
                most_rows=400,
            )
        )
    for section, given in _by_section(model).items():
        parts.append(Table(given, "SI units.", section, digits=8, unlike=True))
    return render_page(file.name, parts, footer=f"tire show {file.name}")
