"""What is learned about the data: how the measurements of organisations differ, with intervals."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import pandas as pd

from tire_pipeline.translation.curves.features import GROUPS
from tire_pipeline.translation.curves.space import PARTS, UNIT
from tire_pipeline.translation.decode.scores_to_coefficients import COEFFICIENTS
from tire_pipeline.translation.judge.effects import EFFECT_QUANTILE, KEY_PARTS, difference, mean_of_loads
from tire_pipeline.translation.population.model import CurveMixedModel, columns_of
from tire_pipeline.translation.translator import CurveTranslator

_MOST_TIRES = 25


@dataclass(frozen=True)
class BiasReport:
    """Bias between pairs of organisations.

    Attributes
    ----------
    by_region : DataFrame
        ``organisation``, ``reference``, ``output``, ``region``, ``unit``, ``bias``, ``low``, ``high`` (90%
        interval), ``clear`` (the interval leaves out 0). Bias is ``organisation`` less ``reference`` at the
        mean tire, in the mean of its protocols if an organisation changed them: a share for logarithmic
        features (0.05: 5% more), else in the feature's own unit.
    by_metadata : DataFrame
        ``organisation``, ``reference``, ``what``, ``metadata``, ``bias``, ``low``, ``high``, ``clear``: by
        how much the bias of ``what`` (mean over the loads) grows with one standard deviation of the metadata.
    by_coefficient : DataFrame
        ``organisation``, ``reference``, ``coefficient``, ``bias``, ``low``, ``high``: mean change of the
        coefficient when tires of ``reference`` are translated to ``organisation``, and the range that 90% of
        the tires lie in.
    """

    by_region: pd.DataFrame
    by_metadata: pd.DataFrame
    by_coefficient: pd.DataFrame


def bias_report(
    translator: CurveTranslator, training: pd.DataFrame, *, coefficients: bool = True
) -> BiasReport:
    """Report the bias of every pair of organisations.

    Parameters
    ----------
    translator : CurveTranslator
        Fitted; with pairs or without.
    training : DataFrame
        What it was fitted to.
    coefficients : bool
        Also translate some tires of each pair for ``by_coefficient``, which takes a second a pair.

    Returns
    -------
    BiasReport
    """
    model = translator.model
    pairs = list(combinations(model.categories, 2))
    loads = translator.parts.loads
    chance = _chance_of_tires(model, loads.scaled(training))
    regions = [
        _regions(model, organisation, reference, chance, loads.factor) for reference, organisation in pairs
    ]
    slopes = [_slopes(model, organisation, reference) for reference, organisation in pairs]
    moved = [
        _moved(translator, training, organisation, reference)
        for reference, organisation in pairs
        if coefficients
    ]
    parts = (regions, slopes, moved)
    return BiasReport(*(pd.concat(p, ignore_index=True) if p else pd.DataFrame() for p in parts))


def _chance_of_tires(model: CurveMixedModel, training: pd.DataFrame) -> np.ndarray:
    """What each category is expected to measure of each training tire, (categories, tires, p), over the root
    of their number.

    The mean tire is known from these only: where biases differ from tire to tire, that is uncertain, too.
    """
    tires = training.drop_duplicates("tire_id")
    likely = model.predict(tires, model.categories[0]).classes
    effects = []
    for category in model.categories:
        mean = np.zeros((len(tires), len(model.protocols.changes)))
        rows = model.regressors(model.blocks(tires, np.full(len(tires), category), mean))
        weights = np.stack([one.mean[: rows[0].shape[1]] for one in model.fitted], axis=1) * model.scale
        effects.append(sum(likely[:, [k]] * (x @ weights) for k, x in enumerate(rows)))
    return np.stack(effects) / np.sqrt(len(tires))


def _contrast(model: CurveMixedModel, organisation: str, reference: str) -> np.ndarray:
    names = np.array(model.categories)
    return (names == organisation).astype(float) - (names == reference).astype(float)


def _regions(
    model: CurveMixedModel, organisation: str, reference: str, chance: np.ndarray, factor: float
) -> pd.DataFrame:
    contrast = _contrast(model, organisation, reference)
    mean, variance = difference(model, contrast, columns_of(model, "category"))
    variance = variance + np.tensordot(contrast, chance, axes=1).var(axis=0)
    rows = []
    names = {group.name: np.array([_at_load(name, factor) for name in group.names]) for group in GROUPS}
    for part, place in model.space.slices.items():
        group = PARTS[part].group
        back = model.space.back[part] * UNIT[group]
        bias = mean[place] @ back
        half = EFFECT_QUANTILE * np.sqrt(variance[place] @ back**2)
        labels = names[group][PARTS[part].columns]
        for label, middle, width in zip(labels, bias, half, strict=True):
            share = label.startswith("ln ")
            ends = (middle - width, middle, middle + width)
            low, value, high = (np.expm1(e) if share else e for e in ends)
            unit = "share" if share else "feature"
            rows.append((organisation, reference, group, label.removeprefix("ln "), unit, value, low, high))
    table = pd.DataFrame(
        rows, columns=["organisation", "reference", "output", "region", "unit", "bias", "low", "high"]
    )
    return table.assign(clear=(table["low"] > 0.0) | (table["high"] < 0.0))


def _at_load(name: str, factor: float) -> str:
    """Name of a feature at a load times a factor."""
    what, load = name.rsplit(", ", 1)
    return f"{what}, {factor * float(load.removesuffix(' N')):.0f} N"


def _slopes(model: CurveMixedModel, organisation: str, reference: str) -> pd.DataFrame:
    rows = []
    contrast = _contrast(model, organisation, reference)
    for k, name in enumerate(model.metadata.names):
        one = np.zeros((len(model.categories), len(model.metadata.names)))
        one[:, k] = contrast
        mean, variance = difference(model, one.ravel(), columns_of(model, "category_metadata"))
        for part in KEY_PARTS:
            value, half = mean_of_loads(model, part, mean, variance)
            rows.append((organisation, reference, part, name, value, value - half, value + half))
    table = pd.DataFrame(
        rows, columns=["organisation", "reference", "what", "metadata", "bias", "low", "high"]
    )
    return table.assign(clear=(table["low"] > 0.0) | (table["high"] < 0.0))


def _moved(
    translator: CurveTranslator, training: pd.DataFrame, organisation: str, reference: str
) -> pd.DataFrame:
    tires = training.loc[training["category"] == reference].drop_duplicates("tire_id").head(_MOST_TIRES)
    toward = translator.with_verdict(target=organisation, gate=False)
    translated = toward.translate(tires.reset_index(drop=True))
    change = translated[list(COEFFICIENTS)].to_numpy(float) - tires[list(COEFFICIENTS)].to_numpy(float)
    low, high = np.nanquantile(change, [0.05, 0.95], axis=0)
    return pd.DataFrame(
        {
            "organisation": organisation,
            "reference": reference,
            "coefficient": COEFFICIENTS,
            "bias": np.nanmean(change, axis=0),
            "low": low,
            "high": high,
        }
    )


def at_each_load(report: BiasReport, region: str) -> pd.DataFrame:
    """Take one property, such as ``"cornering stiffness"``, out of ``by_region``, with its load in N."""
    own = report.by_region[report.by_region["region"].str.match(rf"{region}, \d+ N")].copy()
    own["normal_load"] = own["region"].str.extract(r"(\d+) N")[0].astype(float)
    return own
