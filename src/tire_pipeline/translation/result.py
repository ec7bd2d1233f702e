"""What a translation gives an engineer beside the translated tires."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError

VERSION = "5"
"""Version of the translators, written into every translated file: another one where the same training files
give another translation. 2: stiffness and shape are combined (:mod:`.population.fit_links`); 3:
categories spread stiffness alike (:data:`.population.fit_model.SPREAD_WIDTH`); 4: spreads are bounded, and
translators that learn from the batch; 5: what a supplier's own tires have in common is no bias, and a
property is changed as far as the supplier probably measures it otherwise (:mod:`.population.evidence`);
fleets of other tires than a car's are compared at their loads (:mod:`.curves.load_scale`)."""

TRANSLATED = "translated"
UNBIASED = "already unbiased"
"""The target's own file, or one for whose tire the 90% band of the supplier's bias contains zero."""
LEFT_ALONE = "left alone"
"""There may be a bias, but too little would be gained, or it cannot be distinguished from chance."""
REFUSED = "refused"
UNKNOWN = "unknown supplier"

EDGE = 1.0
"""Distance at the edge of the training data: nothing beyond is written unless it is asked for."""


@dataclass(frozen=True)
class Band:
    """A curve and the band in which the target's own measurement is expected with 90% probability.

    Attributes
    ----------
    slip : ndarray, shape (s,)
        Slip angle (rad), or slip ratio for ``fx``.
    normal_load : ndarray, shape (l,)
        N.
    middle, low, high : ndarray, shape (n, l, s)
        N, or N m for ``mz``.
    """

    slip: np.ndarray
    normal_load: np.ndarray
    middle: np.ndarray
    low: np.ndarray
    high: np.ndarray


@dataclass(frozen=True)
class TranslationResult:
    """What a translator gives of some files: the translated tires, and a verdict on each file.

    Attributes
    ----------
    table : DataFrame
        The translated tires: rows, columns, index and metadata of the source table, other p and q
        coefficients. A file that was refused or is already unbiased stands there unchanged.
    report : DataFrame
        One row a file, same index: ``file``, ``source``, ``source_probability`` (1 if the category was
        given), ``target``, ``verdict``, ``reason``, ``distance`` (1: at the edge of the training data),
        ``expected_rms_ratio`` (expected RMS error of the curves over that of the unchanged file),
        ``harm_probability``, ``bias_band`` (what the supplier measures more than the target of this
        tire, 90%, in words), ``taught`` (by how many files of other tires that were translated with it,
        see :mod:`.predict.batch`), ``protocol`` (under which of its category's protocols the file was
        measured, if that changed) and ``changes`` (what the target measures differently of such a tire, in
        words, and what that usually comes from).
    bands : dict of str to Band
        ``fy``, ``fx``, ``mz``; empty if the translator gives none.
    coefficients : DataFrame
        One row a file and coefficient that moved: ``file``, ``coefficient``, ``from``, ``to``.
    method : str
        The translator's name.
    protocols : DataFrame
        Categories that changed how they measure, see :func:`.judge.effects.protocol_changes`; empty if none
        did. A target that did is given by its newest protocol.
    stiffness : Band, optional
        Of the cornering stiffness (N/rad, positive), with the one slip 0.
    normal_load : ndarray, shape (l,), optional
        Loads at which curves were compared, N.

    See Also
    --------
    Translator.translation : Gives one.

    Notes
    -----
    How the columns of the report come about: docs/explanation/translation.md.

    Examples
    --------
    >>> import pandas as pd
    >>> from tire_pipeline.translation import make_translator
    >>> tires = pd.DataFrame({"file": ["A/1.tir", "D/1.tir"], "category": ["A", "D"], "PDY1": [1.0, 0.9]})
    >>> result = make_translator("no_change").fit(tires, target="D", seed=0).translation(tires)
    >>> result.method, list(result.report["verdict"])
    ('no_change', ['left alone', 'left alone'])
    """

    table: pd.DataFrame
    report: pd.DataFrame
    bands: Mapping[str, Band] = field(default_factory=dict)
    coefficients: pd.DataFrame = field(default_factory=pd.DataFrame)
    method: str = ""
    protocols: pd.DataFrame = field(default_factory=pd.DataFrame)
    stiffness: Band | None = None
    normal_load: np.ndarray | None = None


def moved_coefficients(
    source: pd.DataFrame, translated: pd.DataFrame, names: tuple[str, ...]
) -> pd.DataFrame:
    """List the coefficients that differ.

    Parameters
    ----------
    source, translated : DataFrame
        n tires, row by row the same.
    names : tuple of str
        Coefficients to compare.

    Returns
    -------
    DataFrame
        ``file``, ``coefficient``, ``from``, ``to``; one row a coefficient that moved.
    """
    found = []
    files = source["file"] if "file" in source else pd.Series(source.index.astype(str), index=source.index)
    for name in names:
        if name not in source or name not in translated:
            continue
        before, after = source[name].to_numpy(float), translated[name].to_numpy(float)
        rows = np.flatnonzero(~((before == after) | (np.isnan(before) & np.isnan(after))))
        found.append(
            pd.DataFrame(
                {
                    "file": files.to_numpy()[rows],
                    "coefficient": name,
                    "from": before[rows],
                    "to": after[rows],
                }
            )
        )
    return pd.concat(found, ignore_index=True) if found else pd.DataFrame()


def without_estimate(
    source: pd.DataFrame, table: pd.DataFrame, target: str, name: str, verdict: str = TRANSLATED
) -> TranslationResult:
    """Return the result of a translator that has no estimate of its own error.

    Parameters
    ----------
    source, table : DataFrame
        n tires before and after.
    target : str
    name : str
        Of the translator.
    verdict : str
        Of every file: the translator refuses none.

    Returns
    -------
    TranslationResult
        Without bands.
    """
    names = tuple(n for n in table if n in source and table[n].dtype.kind == "f")
    coefficients = moved_coefficients(source, table, names)
    files = source["file"] if "file" in source else pd.Series(source.index.astype(str), index=source.index)
    report = pd.DataFrame(
        {
            "file": files,
            "source": source["category"].astype(str),
            "source_probability": source.get("category_probability", 1.0),
            "target": target,
            "verdict": verdict,
            "reason": f"{name} gives no estimate of its error",
            "distance": np.nan,
            "expected_rms_ratio": np.nan,
            "harm_probability": np.nan,
            "bias_band": "",
            "taught": 0,
            "protocol": "",
            "changes": "",
        },
        index=source.index,
    )
    return TranslationResult(table, report, coefficients=coefficients, method=name)


def translation_hash(row: Mapping[str, Any], names: tuple[str, ...]) -> str:
    """Hash of a translated tire's coefficients: tells whether a file was changed after its translation."""
    values = np.array([float(row.get(name, np.nan)) for name in names])
    return hashlib.sha256(values.tobytes()).hexdigest()[:16]


def comment_lines(result: TranslationResult, row: int, names: tuple[str, ...]) -> list[str]:
    """Comment lines for a translated ``.tir`` file.

    Parameters
    ----------
    result : TranslationResult
    row : int
        Position of the file in the result.
    names : tuple of str
        Coefficients that the hash covers, in this order.

    Returns
    -------
    list of str
        For ``tir.write_tir(model, path, comments=...)``.
    """
    said = result.report.iloc[row]
    lines = [
        f"translated by tire_pipeline: {said['source']} -> {said['target']}",
        f"source file: {said['file']}",
        f"source category: {said['source']} ({_how_known(said)})",
        f"method: {result.method}, version {VERSION}",
        f"verdict: {said['verdict']}: {said['reason']}",
        *(
            f"bias of {said['source']} against {said['target']} (90% band): {band}"
            for band in str(said["bias_band"]).split(", ")
        ),
        f"distance to the training data: {said['distance']:.2f} "
        + (
            "(1 is its edge)"
            if said["distance"] <= EDGE
            else "(beyond its edge, 1; written because asked for)"
        ),
        f"hash: {translation_hash(result.table.iloc[row].to_dict(), names)}",
    ]
    if said.get("taught", 0):
        lines.append(f"learned also from {said['taught']} files of other tires in the same batch")
    if said.get("protocol", ""):
        lines.append(f"protocol of the source category: {said['protocol']}")
    return [*lines, *(str(said["changes"]).split("; ") if said["changes"] else [])]


def _how_known(said: pd.Series) -> str:
    if said.get("supplier_known"):
        return str(said["supplier_known"])
    probability = said["source_probability"]
    return "as given" if probability == 1.0 else f"probability {probability:.2f}"


def write_translated(
    model, result: TranslationResult, row: int, names: tuple[str, ...], *, beyond: bool = False
):
    """Give the source's model the translated coefficients, and the comment lines that belong to it.

    Parameters
    ----------
    model : TireModel
        The source file's model at the nominal load of the table (its ``FNOMIN`` is the table's).
    result : TranslationResult
    row : int
        Position of the file in the result.
    names : tuple of str
        The p and q coefficients.
    beyond : bool
        Also give a file that lies beyond the edge of the training data.

    Returns
    -------
    model : TireModel
    comments : list of str
        Write both with ``tir.write_tir(model, path, comments=comments)``.

    Raises
    ------
    DomainError
        If the file lies beyond the edge of the training data and ``beyond`` is not set.
    """
    distance = float(result.report["distance"].iloc[row])
    if distance > EDGE and not beyond:
        raise DomainError(
            f"the tire is beyond the edge of the training data (distance {distance:.2f}, the edge is 1)",
            where=str(result.report["file"].iloc[row]),
            todo="give training files of such tires, or ask for it with beyond=True",
        )
    values = result.table.iloc[row]
    known = {name: float(values[name]) for name in names if name in values and np.isfinite(values[name])}
    if "FNOMIN" in values:
        known["FNOMIN"] = float(values["FNOMIN"])
    return model.replace(**known), comment_lines(result, row, names)
