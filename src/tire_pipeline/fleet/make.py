"""Make the demonstration fleet: training files, evaluation files and the sealed truth."""

from __future__ import annotations

import datetime as dt
from dataclasses import asdict, dataclass

import numpy as np
import pandas as pd

from tire_pipeline.fleet.files.other_values import other_values
from tire_pipeline.fleet.files.tir_text import Template, style_of
from tire_pipeline.fleet.plan import EVALUATION_SETS, Plan, make_plan
from tire_pipeline.fleet.run_plan import measure_all, regimes_of
from tire_pipeline.fleet.settings import FleetSettings
from tire_pipeline.fleet.truth import FleetTruth, true_curves

_FIRST_DAY = dt.date(2011, 1, 10)
_DAYS = 4200


@dataclass(frozen=True)
class Fleet:
    """A fleet.

    Attributes
    ----------
    settings : FleetSettings
    files : dict of str to str
        Training fleet: ``<category>/<name>.tir`` and its text. Write them as latin-1 or ASCII with
        ``newline=""``: line ends are the manufacturers' own.
    evaluation : dict of str to str
        Inputs of translators: ``<four|tuning|hidden>/<category>/<tire>.tir``; the target's own
        files are not among them.
    truth : FleetTruth
        Sealed; only the evaluation may read it.
    """

    settings: FleetSettings
    files: dict[str, str]
    evaluation: dict[str, str]
    truth: FleetTruth


def make_fleet(settings: FleetSettings | None = None) -> Fleet:
    """Make a fleet; the same settings give the same bytes.

    Parameters
    ----------
    settings : FleetSettings, optional

    Returns
    -------
    Fleet
    """
    settings = settings or FleetSettings()
    streams = np.random.SeedSequence(settings.seed).spawn(4)
    plan = make_plan(settings, np.random.default_rng(streams[0]))
    coefficients = measure_all(plan, settings, np.random.default_rng(streams[1]))
    values = _all_values(plan, coefficients, settings, np.random.default_rng(streams[2]))
    writer = _Writer(plan, values, settings)
    files, origin = _training_files(plan, writer, np.random.default_rng(streams[3]))
    evaluation, first, second = _evaluation_files(plan, writer, settings)
    truth = FleetTruth(
        first=first,
        second=second,
        tires=plan.tires,
        files=origin,
        evaluation=_evaluation_table(plan),
        regimes={name: asdict(regime) for name, regime in regimes_of(plan, settings).items()},
        settings=asdict(settings),
        curves={name: true_curves(plan.tires.loc[plan.tires["role"] == name]) for name in EVALUATION_SETS},
    )
    return Fleet(settings, files, evaluation, truth)


def _all_values(
    plan: Plan, coefficients: pd.DataFrame, settings: FleetSettings, rng: np.random.Generator
) -> pd.DataFrame:
    """Coefficients beside all else that a file holds, one row a measurement."""
    parts = []
    regimes = regimes_of(plan, settings)
    for key, regime in regimes.items():
        rows = plan.measurements[plan.measurements["regime"] == key]
        own = coefficients.loc[rows.index]
        parts.append(other_values(plan.tires.loc[rows["tire"]], own, regime, rows, rng))
    other = pd.concat(parts).sort_index()
    return pd.concat([coefficients.drop(columns="FNOMIN"), other], axis=1)


class _Writer:
    """Renders measurements as text."""

    def __init__(self, plan: Plan, values: pd.DataFrame, settings: FleetSettings) -> None:
        self.rows = values.to_dict("records")
        self.compound = plan.tires["compound"].loc[plan.measurements["tire"]].to_list()
        self.with_compound = settings.compound_in_metadata
        self.templates: dict[str, Template] = {}

    def text(self, category: str, measurement: int, date: float, without: str) -> str:
        if category not in self.templates:
            self.templates[category] = Template(style_of(category), self.with_compound)
        day = _FIRST_DAY + dt.timedelta(days=int(date * _DAYS))
        words = {"date": day.isoformat(), "compound": self.compound[measurement]}
        return self.templates[category].render(self.rows[measurement], words, without)


def _training_files(
    plan: Plan, writer: _Writer, rng: np.random.Generator
) -> tuple[dict[str, str], pd.DataFrame]:
    """Texts by path, and which tire and measurement each came from."""
    files: dict[str, str] = {}
    origin = []
    for category, own in plan.files.groupby("category"):
        numbers = rng.permutation(len(own)) + 1
        for number, row in sorted(zip(numbers, own.itertuples(index=False), strict=True)):
            path = f"{category}/{style_of(str(category)).name % number}"
            files[path] = writer.text(str(category), row.measurement, row.date, row.without)
            origin.append({"file": path, "measurement": row.measurement, "file_role": row.role})
    table = pd.DataFrame(origin)
    return files, table.join(plan.measurements.drop(columns="role"), on="measurement")


def _evaluation_files(
    plan: Plan, writer: _Writer, settings: FleetSettings
) -> tuple[dict[str, str], dict[str, str], dict[str, str]]:
    """Inputs, all first measurements, and all second ones, each by path."""
    inputs: dict[str, str] = {}
    first: dict[str, str] = {}
    second: dict[str, str] = {}
    chosen = plan.measurements[plan.measurements["role"].isin(EVALUATION_SETS)]
    for row in chosen.itertuples():
        path = f"{row.role}/{row.category}/{row.tire}.tir"
        text = writer.text(row.category, row.Index, row.date, "")
        if row.repeat == 2:
            second[path] = text
            continue
        first[path] = text
        if row.category != settings.target:
            inputs[path] = text
    return inputs, first, second


def _evaluation_table(plan: Plan) -> pd.DataFrame:
    """Which protocol each evaluation file was measured by."""
    chosen = plan.measurements[plan.measurements["role"].isin(EVALUATION_SETS)]
    table = chosen.rename(columns={"role": "set"})
    table["file"] = table["set"] + "/" + table["category"] + "/" + table["tire"] + ".tir"
    columns = ["file", "set", "category", "tire", "protocol", "repeat"]
    return table[columns].reset_index(drop=True)
