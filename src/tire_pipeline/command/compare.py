"""``tire compare``: two .tir files beside each other."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tire_pipeline.channels import unit_of
from tire_pipeline.command.options import (
    CAMBER_OPTION,
    FILE,
    LOAD_OPTION,
    names_of,
    output_options,
    radius_option,
)
from tire_pipeline.command.outcome import NO_UNIT, CommandOutcome, Grid, finish, percent, three_digits
from tire_pipeline.errors import DomainError

if TYPE_CHECKING:
    from tire_pipeline.magic_formula import TireModel
    from tire_pipeline.magic_formula.compare import Difference

_ROUNDING_SHARE = 1e-9
"""Share of the largest force below which a difference is that of rounding."""


@click.command(help="Compare A.tir with B.tir: key figures, forces at pure slip, coefficients that differ.")
@click.argument("first", type=FILE, metavar="A.tir")
@click.argument("second", type=FILE, metavar="B.tir")
@click.option("--load", "loads", type=LOAD_OPTION, multiple=True, help="Normal load, N; can be repeated.")
@click.option("--camber", type=CAMBER_OPTION, default=0.0, show_default=True, help="Camber, deg.")
@radius_option
@output_options("-o")
def command(
    first: Path,
    second: Path,
    loads: tuple[float, ...],
    camber: float,
    radius: float | None,
    **output: Any,
) -> None:
    """Compare two files."""
    from tire_pipeline.tir import read_tir

    names = names_of([first, second])
    read = (read_tir(path, unloaded_radius=radius) for path in (first, second))
    models = dict(zip(names, read, strict=True))
    odd = [f"{name}: {text}" for name, model in models.items() for text in _unusual(model)]
    if not loads:
        _check_loads_in_common(models, odd)
    outcome = replace(compared(models, loads, camber), notes=odd)
    finish(outcome, f"{first.stem}_against_{second.stem}", **output)


def _unusual(model: TireModel) -> list[str]:
    """What is unusual in a file; of a missing radius a line of the result speaks."""
    from tire_pipeline.tir.reading.read import file_warnings

    said = file_warnings(model)
    return [text for text in said if "UNLOADED_RADIUS" not in text or not model.lacks_radius]


def _check_loads_in_common(models: dict[str, TireModel], odd: list[str]) -> None:
    """Raise where there is no load at which both files are valid: nothing there is of both tires."""
    ranges = {
        name: model.ranges["normal_load"][2:]
        for name, model in models.items()
        if "normal_load" in model.ranges
    }
    if len(ranges) < len(models) or max(low for low, _ in ranges.values()) <= min(
        high for _, high in ranges.values()
    ):
        return
    said = ", ".join(f"{name} from {low:,.0f} to {high:,.0f} N" for name, (low, high) in ranges.items())
    raise DomainError(
        f"there is no normal load at which both files are valid: {said}",
        todo="; ".join([*odd, "correct the units of the files, or state a load by --load"]),
    )


@contextmanager
def _missing_radius_is_said() -> Iterator[None]:
    """Suppress the warning of a missing radius: a line of the result says it."""
    from tire_pipeline.magic_formula.forces import MissingRadiusWarning

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissingRadiusWarning)
        yield


@_missing_radius_is_said()
def compared(
    models: dict[str, TireModel],
    loads: tuple[float, ...] = (),
    camber: float = 0.0,
    title: str = "",
    notes: Sequence[str] = (),
) -> CommandOutcome:
    """Compare two models by name, ``camber`` in degrees; ``notes`` for a section of their own on the page."""
    from tire_pipeline.magic_formula.compare import changed_values, compare_models
    from tire_pipeline.magic_formula.key_figures import key_figures, usual_loads

    (a, first), (b, second) = models.items()
    at = list(loads) or usual_loads([first, second])
    apart = compare_models(first, second, loads=at, camber=math.radians(camber))
    changed = changed_values(first, second)
    load = at[len(at) // 2]
    pairs = list(zip(key_figures(first, load), key_figures(second, load), strict=True))
    held = [(x, y) for x, y in pairs if not math.isnan(x.value) or not math.isnan(y.value)]
    figures = Grid(
        ("quantity", "A", "B", "change", "unit"),
        [
            (
                x.name,
                three_digits(x.value),
                three_digits(y.value),
                _change(x.value, y.value),
                x.unit or NO_UNIT,
            )
            for x, y in held
        ],
        f"At {load:,.0f} N, no camber. A dash: no such force, or no peak within the range of the file",
    )
    forces = Grid(
        ("output", "RMS", "largest", "unit", "RMS / largest"),
        [_row(d) for d in apart],
        f"B minus A, pure slip, {', '.join(f'{x:,.0f}' for x in at)} N",
    )
    lines = _lines(models, apart, len(changed))
    data = {
        "files": list(models),
        "versions": [first.version, second.version],
        "loads": at,
        "differences": {d.output: asdict(d) for d in apart},
        "key_figures": {x.name: {a: x.value, b: y.value, "unit": x.unit} for x, y in pairs},
        "coefficients": {name: [x, y] for name, x, y in changed},
    }

    @_missing_radius_is_said()
    def page() -> str:
        return _page(models, [figures, forces], changed, title, lines, notes, at, camber)

    return CommandOutcome(title or f"{a} and {b}", lines, data, page, [figures, forces])


def _lines(models: dict[str, TireModel], apart: list[Difference], changed: int) -> list[str]:
    (a, first), (b, second) = models.items()
    known = [d for d in apart if math.isfinite(d.share)]
    sizes = ", ".join(f"{d.output.capitalize()} {_percent(d.share)}" for d in known)
    lines = [
        f"RMS difference of the forces, as a share of the largest: {sizes or 'no force is in both files'}.",
        f"A is {a} (version {first.version}), B is {b} (version {second.version}).",
    ]
    opposite = [d.output.capitalize() for d in apart if d.opposite]
    if opposite:
        lines.append(
            f"{' and '.join(opposite)} of B {'has' if len(opposite) == 1 else 'have'} the other sign: "
            "the files are in different axes, and the differences say nothing about the tires."
        )
    for letter, which in (("A", 0), ("B", 1)):
        if lacks := [d.output.capitalize() for d in apart if d.lacking[which] and not all(d.lacking)]:
            lines.append(f"{letter} has no {' and no '.join(lacks)}.")
    lines.append(f"{changed} coefficient{'s differ' if changed != 1 else ' differs'}.")
    sides = [str(model.metadata.get("MODEL.TYRESIDE", "")) for model in (first, second)]
    if sorted(sides) == ["LEFT", "RIGHT"]:
        lines.append(
            f"A is a {sides[0].lower()} tire and B a {sides[1].lower()} one: each is taken as it was "
            "measured, and none is mirrored."
        )
    lines += [
        f"{name} states no UNLOADED_RADIUS, so its moments and relaxation lengths cannot be computed. State "
        "it (m) with --unloaded-radius."
        for name, model in models.items()
        if model.lacks_radius
    ]
    return lines


def _row(difference: Difference) -> tuple[Any, ...]:
    unit = unit_of(difference.output)
    rms, largest = difference.rms, difference.largest
    if all(difference.lacking):
        rms = largest = math.nan
    # The share is NaN where a model has no such output: that is a difference, not rounding.
    elif difference.share <= _ROUNDING_SHARE:
        rms = largest = 0.0
    return difference.output.capitalize(), rms, largest, unit, _percent(difference.share)


def _percent(share: float) -> str:
    if not math.isfinite(share):
        return "–"
    return percent(share) if share > _ROUNDING_SHARE else "0%"


def _change(before: float, after: float) -> str:
    if not (math.isfinite(before) and math.isfinite(after)) or 0.0 in (before, after):
        return "–"
    change = after / before - 1.0
    return f"{100 * change:+.1f}%" if abs(change) > _ROUNDING_SHARE else "0%"


def _page(
    models: dict[str, TireModel],
    grids: list[Grid],
    changed: list[tuple[str, float, float]],
    title: str,
    lines: list[str],
    notes: Sequence[str],
    loads: list[float],
    camber: float,
) -> str:
    import pandas as pd

    from tire_pipeline.magic_formula.plots import draw_models
    from tire_pipeline.reporting import Figure, Table, Text, render_page

    parts: list[Any] = [
        Text(lines, emphasis=True),
        *([Text(notes, heading="What other software will see")] if notes else []),
        Figure(
            *draw_models(
                dict(zip("AB", models.values(), strict=True)), loads=loads, camber=math.radians(camber)
            ),
            heading="Curves",
        ),
    ]
    for grid, heading in zip(grids, ("Key figures", "Forces"), strict=True):
        table = pd.DataFrame(grid.rows, columns=list(grid.header))
        parts.append(Table(table, grid.title, heading, unlike=True))
    frame = pd.DataFrame(changed, columns=["coefficient", "A", "B"])
    if len(frame):
        said = "SI units; a dash: the version does not use it, or the file lacks it."
        parts.append(Table(frame, said, "Coefficients that differ", digits=6, unlike=True, most_rows=1000))
    footer = title or f"tire compare {' '.join(models)}"
    return render_page(title or " and ".join(models), parts, footer=footer)
