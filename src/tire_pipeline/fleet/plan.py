"""Who measures which tire when and in which condition: one row a file of the training fleet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from tire_pipeline.fleet.settings import (
    FOUR_TIRE_CATEGORIES,
    MANUFACTURERS,
    FileCounts,
    FleetSettings,
    file_counts,
)
from tire_pipeline.fleet.tire_population import draw_tires

# The 11 lateral coefficients without camber; see docs/explanation/fleet.md for why PEY3 is not among them.
FEATURES: tuple[str, ...] = (
    "PCY1",
    "PDY1",
    "PDY2",
    "PEY1",
    "PEY2",
    "PKY1",
    "PKY2",
    "PHY1",
    "PHY2",
    "PVY1",
    "PVY2",
)
MISSING_FEATURES: tuple[str, ...] = ("PEY2", "PHY2", "PVY2", "PVY1", "PHY1", "PKY2")
PRESSURE_RATIOS = (0.94, 0.97, 1.03, 1.06)
WEARS = (0.1, 0.2, 0.3)
EVALUATION_SETS: tuple[str, ...] = ("four", "tuning", "hidden")


@dataclass(frozen=True)
class Plan:
    """What is measured, and what files come of it.

    Attributes
    ----------
    tires : pandas.DataFrame
        All physical tires (:func:`.tire_population.draw_tires`) with ``role``: ``training``, ``paired``,
        ``four``, ``tuning`` or ``hidden``.
    measurements : pandas.DataFrame
        One row a fit: ``category``, ``tire``, ``pressure``, ``wear``, ``protocol``,
        ``regime`` (``category/protocol``), ``date`` (0 to 1), ``role`` (``kept``, ``missing``, ``tiny``
        or an evaluation set), ``repeat`` (1 or 2), ``same_data`` (row whose raw data is fitted
        again, or -1), ``weight_twist``.
    files : pandas.DataFrame
        One row a file of the training fleet: ``measurement``, ``role``, ``without`` (feature
        that has no value, or ""), ``date``, ``category``.
    """

    tires: pd.DataFrame
    measurements: pd.DataFrame
    files: pd.DataFrame


def make_plan(settings: FleetSettings, rng: np.random.Generator) -> Plan:
    """Draw the tires and lay out all measurements and files.

    Parameters
    ----------
    settings : FleetSettings
    rng : numpy.random.Generator

    Returns
    -------
    Plan
    """
    counts = file_counts(settings.files)
    tires: list[pd.DataFrame] = []
    rows: list[dict[str, object]] = []
    number = 0

    def new_tires(count: int, role: str) -> list[str]:
        nonlocal number
        tires.append(draw_tires(count, rng, number).assign(role=role))
        number += count
        return list(tires[-1].index)

    paired = new_tires(settings.paired_tires, "paired") if settings.paired_tires else []
    for category, kept in counts.kept.items():
        missing = _share_of_missing(counts, category)
        own = kept - len(paired)
        pool = new_tires(max(2, round(own / settings.variants)), "training")
        dates = dict(zip(pool, rng.random(len(pool)), strict=True))
        dates.update(zip(paired, rng.random(len(paired)), strict=True))
        for tire in paired:
            rows.append(_row(category, tire, "kept", dates[tire]))
        rows.extend(_variants(category, pool, own, "kept", dates, rng, len(rows)))
        rows.extend(_variants(category, pool, missing, "missing", dates, rng, len(rows)))
    for category, count in counts.tiny.items():
        pool = new_tires(max(1, count // 3), "training")
        dates = dict(zip(pool, rng.random(len(pool)), strict=True))
        rows.extend(_variants(category, pool, count, "tiny", dates, rng, len(rows)))
    sizes = {"four": 4, "tuning": settings.tuning_tires, "hidden": settings.hidden_tires}
    for name in EVALUATION_SETS:
        for tire in new_tires(sizes[name], name):
            for category in FOUR_TIRE_CATEGORIES if name == "four" else MANUFACTURERS:
                date = rng.random()
                rows.append(_row(category, tire, name, date))
                rows.append({**_row(category, tire, name, date), "repeat": 2})
    measurements = pd.DataFrame(rows)
    new = measurements["category"].isin(settings.drifting) & (measurements["date"] >= 0.5)
    drifts = settings.kind == "drifting"
    measurements["protocol"] = np.where(new & drifts, "new", "old")
    measurements["regime"] = measurements["category"] + "/" + measurements["protocol"]
    return Plan(
        tires=pd.concat(tires),
        measurements=measurements,
        files=_files(measurements, counts, rng),
    )


def _share_of_missing(counts: FileCounts, category: str) -> int:
    """Files without a feature's value, shared out like the kept files; the rest goes to D."""
    total = sum(counts.kept.values())
    share = {name: counts.missing * kept // total for name, kept in counts.kept.items()}
    share["D"] += counts.missing - sum(share.values())
    return share[category]


def _row(category: str, tire: str, role: str, date: float) -> dict[str, object]:
    return {
        "category": category,
        "tire": tire,
        "role": role,
        "date": date,
        "pressure": 1.0,
        "wear": 0.0,
        "repeat": 1,
        "same_data": -1,
        "weight_twist": 0.0,
    }


def _variants(
    category: str,
    pool: list[str],
    count: int,
    role: str,
    dates: dict[str, float],
    rng: np.random.Generator,
    first: int,
) -> list[dict[str, object]]:
    """Spread ``count`` files over the tires of a pool; the first of each tire is nominal."""
    extra = rng.integers(len(pool), size=max(0, count - len(pool)))
    tires = [*pool[:count], *(pool[i] for i in extra)]
    rows: list[dict[str, object]] = []
    first_of: dict[str, int] = {}
    for tire in tires:
        row = _row(category, tire, role, dates[tire])
        if tire not in first_of:
            first_of[tire] = first + len(rows)
        else:
            sort = rng.random()
            if sort < 0.35:
                row["pressure"] = float(rng.choice(PRESSURE_RATIOS))
            elif sort < 0.5:
                row["wear"] = float(rng.choice(WEARS))
            elif sort < 0.76:
                row["same_data"] = first_of[tire]
                twist = float(rng.choice([-0.15, -0.1, 0.1, 0.15]))
                row["weight_twist"] = twist + float(rng.normal(0.0, 0.02))
        rows.append(row)
    return rows


def _files(measurements: pd.DataFrame, counts: FileCounts, rng: np.random.Generator) -> pd.DataFrame:
    """List the training fleet's files: those of the measurements, and copies of kept ones."""
    own = measurements.index[measurements["role"].isin(["kept", "missing", "tiny"])]
    files = pd.DataFrame(
        {
            "measurement": own,
            "role": measurements.loc[own, "role"],
            "date": measurements.loc[own, "date"],
        }
    )
    lacks = rng.choice(MISSING_FEATURES, size=len(files))
    files["without"] = np.where(files["role"] == "missing", lacks, "")
    kept = files.loc[files["role"] == "kept", "measurement"].to_numpy()
    source = rng.choice(kept, size=counts.copies)
    copies = pd.DataFrame(
        {
            "measurement": source,
            "role": "copy",
            "date": np.minimum(measurements.loc[source, "date"].to_numpy() + 0.02, 0.999),
            "without": "",
        }
    )
    files = pd.concat([files, copies], ignore_index=True)
    files["category"] = measurements.loc[files["measurement"], "category"].to_numpy()
    return files
