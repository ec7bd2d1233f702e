"""Judge translations against doing nothing (thesis, sections 4.5.5, 5.3.1 and 5.3.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from .curves import Curves, EvaluationGrid, curves_of
from .metrics import THESIS_METRICS, curve_errors


@dataclass(frozen=True)
class Evaluation:
    """Outcome of an evaluation.

    Attributes
    ----------
    per_file : pandas.DataFrame
        One row a translation, the index of the given tables; for each metric the columns
        ``<metric>`` (error after translation), ``<metric>_untranslated`` and ``<metric>_improved``.
    summary : pandas.DataFrame
        One row a metric and one named ``mean`` over the thesis' three metrics: ``ratio`` (sum of the
        errors over the sum of the untranslated ones), ``improved`` (share of files with a smaller
        error), ``worst`` (largest ratio of one file) and ``files``.
    """

    per_file: pd.DataFrame
    summary: pd.DataFrame


def evaluate_translations(
    translated: pd.DataFrame | Curves,
    untranslated: pd.DataFrame | Curves,
    reference: pd.DataFrame | Curves,
    *,
    grid: EvaluationGrid | None = None,
    lateral_only: bool = False,
) -> Evaluation:
    """Compare translations and what they came from with the target's measurement.

    Parameters
    ----------
    translated, untranslated, reference : pandas.DataFrame or Curves
        n tires each, row by row the same tire. Tables as for :func:`.curves.curves_of`; curves for
        representations that decode to a force curve and not to a tire model.
    grid : EvaluationGrid, optional
    lateral_only : bool
        Only the thesis' three metrics: quicker.

    Returns
    -------
    Evaluation

    Raises
    ------
    DomainError
        If the numbers of tires differ or a coefficient has no value.
    """
    index = next((t.index for t in (untranslated, translated) if isinstance(t, pd.DataFrame)), None)

    def curves(tires: pd.DataFrame | Curves) -> Curves:
        return tires if isinstance(tires, Curves) else curves_of(tires, grid, lateral_only=lateral_only)

    target = curves(reference)
    after = curve_errors(curves(translated), target)
    before = curve_errors(curves(untranslated), target)
    metrics = [name for name in after.columns if name in before.columns]
    per_file = pd.concat(
        [
            after[metrics],
            before[metrics].add_suffix("_untranslated"),
            (after[metrics] < before[metrics]).add_suffix("_improved"),
        ],
        axis=1,
    )
    if index is not None:
        per_file.index = index
    return Evaluation(per_file, _summary(after[metrics], before[metrics]))


def floor_evaluation(
    second: pd.DataFrame | Curves,
    untranslated: pd.DataFrame | Curves,
    reference: pd.DataFrame | Curves,
    *,
    grid: EvaluationGrid | None = None,
    lateral_only: bool = False,
) -> Evaluation:
    """Return the error of the target's own second measurement of each tire, which is the floor.

    Parameters
    ----------
    second : pandas.DataFrame or Curves
        The target's second measurement of each row's tire.
    untranslated, reference, grid, lateral_only
        As in :func:`evaluate_translations`.

    Returns
    -------
    Evaluation
    """
    return evaluate_translations(second, untranslated, reference, grid=grid, lateral_only=lateral_only)


def _summary(after: pd.DataFrame, before: pd.DataFrame) -> pd.DataFrame:
    rows = {}
    for name in after.columns:
        new, old = after[name].to_numpy(), before[name].to_numpy()
        rows[name] = {
            "ratio": _ratio(float(new.sum()), float(old.sum())),
            "improved": float((new < old).mean()),
            "worst": max(_ratio(float(a), float(b)) for a, b in zip(new, old, strict=True)),
            "files": len(new),
        }
    table = pd.DataFrame.from_dict(rows, orient="index")
    thesis = [name for name in THESIS_METRICS if name in table.index]
    table.loc["mean"] = table.loc[thesis].mean()
    table["files"] = table["files"].astype(int)
    return table.rename_axis("metric")


def _ratio(new: float, old: float) -> float:
    """Return new over old; nothing to correct and nothing changed counts as 1."""
    if old > 0.0:
        return new / old
    return 1.0 if new == 0.0 else float(np.inf)
