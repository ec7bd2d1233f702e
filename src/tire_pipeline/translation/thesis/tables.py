"""The thesis' result tables from the judged cells: 5.10 to 5.21 and 6.1."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import pandas as pd

from tire_pipeline.translation.thesis.grid import CELLS, Cell

METRICS = ("forces", "cornering_stiffness", "peak_friction", "mean")
"""Columns of the thesis' tables: Forces, Slope, Peak Friction Coeff., Average."""


def collect_cells(
    judged: Mapping[str, Iterable[pd.DataFrame]], cells: Iterable[Cell] = CELLS
) -> pd.DataFrame:
    """Put the metrics of all cells and seeds below each other.

    Parameters
    ----------
    judged : mapping
        Name of the cell -> table ``agents`` of
        :func:`tire_pipeline.thesis.experiments.agents.judged_agent`, one for each seed. Cells that are
        not there are left out.
    cells : iterable of Cell

    Returns
    -------
    DataFrame
        ``algorithm``, ``reward``, ``representation``, ``n_bins``, ``seed`` (0, 1...), ``decoding``,
        ``metric``, ``ratio``, ``improved``, ``worst``, ``files``.
    """
    parts = []
    for cell in cells:
        for seed, metrics in enumerate(judged.get(cell.name, ())):
            part = metrics[metrics["metric"].isin(METRICS)].copy()
            for column, value in reversed([*vars(cell).items(), ("seed", seed)]):
                part.insert(0, column, value)
            parts.append(part)
    return pd.concat(parts, ignore_index=True) if parts else pd.DataFrame()


def thesis_table(
    collected: pd.DataFrame, *, reward: str, n_bins: int, value: str = "ratio", decoding: str = "tire"
) -> pd.DataFrame:
    """Return one of Tables 5.10 to 5.21: mean over the seeds, and their spread.

    Parameters
    ----------
    collected : DataFrame
        From :func:`collect_cells`.
    reward : {"reach_target_fast", "maximize_reward"}
    n_bins : int
    value : {"ratio", "improved"}
        MSE over that of doing nothing (5.10 to 5.15), or fraction of improved curves (5.16 to 5.21).
    decoding : {"tire", "curves"}

    Returns
    -------
    DataFrame
        Rows (representation, algorithm); columns the metrics, and ``<metric>_std`` over the seeds.
    """
    rows = collected[
        (collected["reward"] == reward)
        & (collected["n_bins"] == n_bins)
        & (collected["decoding"] == decoding)
    ]
    grouped = rows.groupby(["representation", "algorithm", "metric"], sort=False)[value]
    mean = grouped.mean().unstack("metric")[list(METRICS)]
    spread = grouped.std(ddof=0).unstack("metric")[list(METRICS)].add_suffix("_std")
    return mean.join(spread).rename_axis(columns=None)


def better_than_nothing(collected: pd.DataFrame, *, decoding: str = "tire") -> pd.DataFrame:
    """Return Table 6.1: configurations whose mean ratio over the seeds is below 1, by metric.

    Returns
    -------
    DataFrame
        ``algorithm``, ``representation``, ``n_bins``, ``reward``, ``metric``, ``ratio``, ``seeds_below_1``
        (share of the seeds), best first.
    """
    rows = collected[(collected["decoding"] == decoding) & (collected["metric"] != "mean")]
    keys = ["algorithm", "representation", "n_bins", "reward", "metric"]
    grouped = rows.groupby(keys)["ratio"]
    table = pd.DataFrame(
        {"ratio": grouped.mean(), "seeds_below_1": grouped.apply(lambda each: float((each < 1).mean()))}
    )
    return table[table["ratio"] < 1].sort_values("ratio").reset_index()
