"""Whether incoming files of a category look like its earlier ones, feature by feature."""

from __future__ import annotations

import numpy as np
import pandas as pd

FEWEST_FILES = 5
PSI_LIMIT = 0.2
RISK = 0.05
DRIFT_COLUMNS = ["category", "feature", "earlier", "incoming", "psi", "ks", "p_adjusted", "verdict"]
SAME, DRIFT, TOO_FEW, NEW = "no drift seen", "drift", "too few files", "new category"


def drift_of_features(
    features: pd.DataFrame, categories: np.ndarray, incoming: np.ndarray, *, bins: int = 10
) -> pd.DataFrame:
    """Compare incoming with earlier files of the same category.

    Two figures a feature: the population stability index over the earlier files' quantile bins, and the
    two-sample Kolmogorov-Smirnov distance with its p-value, adjusted over all comparisons of the run
    (Benjamini-Hochberg). ``drift`` needs both: an index above 0.2, which is large, and an adjusted p-value
    below 0.05, because with few files the index is large by chance.

    Parameters
    ----------
    features : DataFrame, shape (rows, features)
    categories : ndarray of str, shape (rows,)
    incoming : ndarray of bool, shape (rows,)
    bins : int
        For the index; fewer where there are fewer files.

    Returns
    -------
    DataFrame
        ``category, feature, earlier, incoming, psi, ks, p_adjusted, verdict``; only categories with incoming
        files. Without figures where either side has fewer than 5 files.
    """
    from scipy.stats import false_discovery_control, ks_2samp

    rows = []
    for category in sorted(set(categories[incoming])):
        here = categories == category
        old, new = features[here & ~incoming], features[here & incoming]
        enough = min(len(old), len(new)) >= FEWEST_FILES
        verdict = NEW if old.empty else (SAME if enough else TOO_FEW)
        for name in features.columns:
            row = {"category": category, "feature": name, "earlier": len(old), "incoming": len(new)}
            row |= {"psi": np.nan, "ks": np.nan, "p_adjusted": np.nan, "verdict": verdict}
            if enough:
                first, second = old[name].to_numpy(dtype=float), new[name].to_numpy(dtype=float)
                test = ks_2samp(first, second)
                row |= {"psi": stability_index(first, second, bins), "ks": float(test.statistic)}
                row["p_adjusted"] = float(test.pvalue)
            rows.append(row)
    table = pd.DataFrame(rows, columns=DRIFT_COLUMNS)
    tested = table["p_adjusted"].notna()
    if tested.any():
        table.loc[tested, "p_adjusted"] = false_discovery_control(table.loc[tested, "p_adjusted"])
        moved = tested & (table["p_adjusted"] < RISK) & (table["psi"] > PSI_LIMIT)
        table.loc[moved, "verdict"] = DRIFT
    return table


def stability_index(earlier: np.ndarray, incoming: np.ndarray, bins: int = 10) -> float:
    """Population stability index: sum of (q - p) ln(q / p) over quantile bins of the earlier values.

    Empty bins count as half a file, so that the index stays finite.

    Parameters
    ----------
    earlier, incoming : ndarray, shape (n,) and (m,)
    bins : int

    Examples
    --------
    >>> stability_index(np.arange(100.0), np.arange(100.0))
    0.0
    """
    count = max(2, min(bins, len(incoming), len(earlier)))
    edges = np.unique(np.quantile(earlier, np.linspace(0.0, 1.0, count + 1)[1:-1]))
    shares = []
    for values in (earlier, incoming):
        counts = np.bincount(np.searchsorted(edges, values, side="right"), minlength=len(edges) + 1)
        shares.append(np.maximum(counts, 0.5) / len(values))
    p, q = shares
    return float(np.sum((q - p) * np.log(q / p)))
