"""The verdict on each file: what cannot be translated, what is not worth it, and why, in words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import pandas as pd

from tire_pipeline.tir.reading.plausibility import unlike_iso
from tire_pipeline.tire_table.one_nominal_load import OWN_LOAD
from tire_pipeline.translation.curves.features import LOADS, encode
from tire_pipeline.translation.curves.load_scale import LOAD_FACTOR
from tire_pipeline.translation.decode.physics import violations
from tire_pipeline.translation.judge.bias_band import (
    CERTAINTY,
    NEGLIGIBLE,
    BiasBand,
    bias_band,
    measured_by_both,
)
from tire_pipeline.translation.judge.gain import MOST_HARM, expected_gain, pooled_harm
from tire_pipeline.translation.judge.reach import TrainingReach, beyond_judged_loads
from tire_pipeline.translation.judge.words import describe_bias
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction
from tire_pipeline.translation.predict.shrinkage import shortened
from tire_pipeline.translation.result import EDGE, LEFT_ALONE, REFUSED, TRANSLATED, UNBIASED, UNKNOWN

FARTHEST_DISTANCE = 3.0
"""Files farther than this from the training data are refused; 1 is the edge of the training data. On tuning
tires every refusal between 1.5 and 2.2 was wrong."""

LEAST_RELATIVE_GAIN = 0.05
"""A file whose expected squared error would shrink by less than this share (2.5% in RMS) is left alone."""

VERSIONS = ("5.0", "5.1", "5.2", "PAC2002")
NEEDED_TO_TRANSLATE = ("FNOMIN", "UNLOADED_RADIUS", "PCY1", "PDY1", "PKY1", "PKY2", "PKX1")
"""What a file must state to be translated."""

_OF_TARGET = "it is the target's own"
_NO_TRAINING_FILE = "no training file is of its supplier: give training files of it"
_VERDICT_OF_REASON = {_OF_TARGET: UNBIASED, _NO_TRAINING_FILE: UNKNOWN}


@dataclass(frozen=True)
class VerdictRules:
    """Gives verdicts.

    Attributes
    ----------
    target : str
    reach : TrainingReach
    harm : ndarray, shape (categories,)
        Probability that translating a category's files makes their error larger.
    gate : bool
        Leave files alone for which little gain is expected, and refuse those far from the training data.
    farthest : float
        Distance to the training data beyond which a file is refused.
    """

    target: str
    reach: TrainingReach
    harm: np.ndarray
    gate: bool
    farthest: float

    @classmethod
    def fit(
        cls,
        model: CurveMixedModel,
        training: pd.DataFrame,
        target: str,
        *,
        trust: float,
        gate: bool,
        farthest: float,
    ) -> Self:
        """Learn from the training files as the mixed model predicts them, whatever predicts the sources.

        Parameters
        ----------
        model : CurveMixedModel
        training : DataFrame
            Tire table with ``category``.
        target : str
        trust : float
            How far the tire effect of a file is shrunk towards the expectation for such a tire.
        gate, farthest
            As in the class.
        """
        found = shortened(model, model.predict(training, target, trust=trust))
        harm = expected_gain(model, found)[1]
        category = training["category"].to_numpy(dtype=str)
        pooled = pooled_harm(harm, category, model.categories, target)
        return cls(target, TrainingReach.fit(model, training, target), pooled, gate, farthest)

    def near(self, model: CurveMixedModel, source: pd.DataFrame, found: Prediction) -> np.ndarray:
        """Tell which files are near enough to the training data, (n,)."""
        return self.reach.distance(model, source, found) <= self.farthest

    def refusals(self, model: CurveMixedModel, source: pd.DataFrame) -> np.ndarray:
        """Return why files cannot be translated at all.

        Parameters
        ----------
        model : CurveMixedModel
        source : DataFrame
            n files.

        Returns
        -------
        ndarray of str, shape (n,)
            Empty where nothing is in the way.
        """
        reason = np.full(len(source), "", dtype=object)
        category = source["category"].astype(str).to_numpy()
        lacking = source.reindex(columns=list(NEEDED_TO_TRANSLATE)).isna()
        for i in np.flatnonzero(lacking.any(axis=1).to_numpy()):
            reason[i] = (
                f"it does not state {', '.join(lacking.columns[lacking.iloc[i]])}: add what is missing"
            )
        if "version" in source:
            other = ~source["version"].astype(str).isin(VERSIONS).to_numpy()
            reason[other] = (
                "its Magic Formula version is not 5.x: fit 5.2 to its forces first, as "
                "docs/tutorials/your_supplier_files.md shows"
            )
        reason[category == self.target] = _OF_TARGET
        reason[~np.isin(category, model.categories)] = _NO_TRAINING_FILE
        usable = np.flatnonzero(reason == "")
        if usable.size:
            features = encode(source.iloc[usable])
            finite = np.all([np.isfinite(values).all(axis=1) for values in features.values()], axis=0)
            reason[usable[~finite]] = "its curves are not finite"
            for i in usable[finite & _may_be_turned(source.iloc[usable])]:
                reason[i] = "; ".join(unlike_iso(source.iloc[i]))
        return reason

    def empty_report(self, model: CurveMixedModel, source: pd.DataFrame, refused: np.ndarray) -> pd.DataFrame:
        """Lay out the report, one row a file; filled for those that are refused."""
        probability = source.get("category_probability", 1.0)
        return pd.DataFrame(
            {
                "file": source["file"] if "file" in source else source.index.astype(str),
                "source": source["category"].astype(str),
                "source_probability": probability,
                "target": self.target,
                "verdict": np.array([_VERDICT_OF_REASON.get(why, REFUSED) for why in refused], dtype=object),
                "reason": refused,
                "distance": np.nan,
                "expected_rms_ratio": np.nan,
                "harm_probability": np.nan,
                "bias_band": pd.Series("", index=source.index, dtype=object),
                "taught": 0,
                "protocol": model.protocols.in_words(source),
                "changes": pd.Series("", index=source.index, dtype=object),
            },
            index=source.index,
        )

    def judge(
        self, model: CurveMixedModel, rows: pd.DataFrame, moved: pd.DataFrame, found: Prediction
    ) -> pd.DataFrame:
        """Verdict, reason, distance, expected ratio, probability of harm and words, one row a file.

        No ratio and no probability are stated for a refused file: outside of the training data, and where no
        physical tire was found, they are not to be trusted.

        Parameters
        ----------
        model : CurveMixedModel
        rows, moved : DataFrame
            n tires before and after.
        found : Prediction
            What they were moved by.
        """
        ratio, harm = expected_gain(model, found)
        distance = self.reach.distance(model, rows, found)
        band = bias_band(model, found)
        broken = violations(moved)
        impossible = (broken & ~violations(rows)).any(axis=1) | broken.drop(columns="curvature").any(axis=1)
        organisations = rows["category"].astype(str).to_numpy()
        uncertain = np.isin(organisations, np.array(model.categories)[self.harm > MOST_HARM])
        verdict = np.full(len(rows), TRANSLATED, dtype=object)
        reason = np.full(len(rows), "", dtype=object)
        loads = _other_loads(rows)
        for i in range(len(rows)):
            reason[i] = f"expected RMS error {np.sqrt(ratio[i]):.0%} of the unchanged file's"
            if self.gate and distance[i] > self.farthest:
                verdict[i], reason[i] = REFUSED, self._too_far(distance[i], loads[i])
            elif impossible.iloc[i]:
                verdict[i] = REFUSED
                reason[i] = f"no physical tire found: {', '.join(broken.columns[broken.iloc[i]])}"
            elif self.gate and (uncertain[i] or ratio[i] > 1.0 - LEAST_RELATIVE_GAIN):
                verdict[i] = UNBIASED if band.negligible[i] else LEFT_ALONE
                reason[i] = _why_alone(organisations[i], self.target, bool(uncertain[i]), band, i, ratio[i])
            if verdict[i] == TRANSLATED and loads[i]:
                reason[i] += f"; {loads[i]}: compare its curves there before you use the file"
        before, after = measured_by_both(model, rows, found)
        said = np.array(
            describe_bias(before, after, band.excludes_zero, organisations, self.target), dtype=object
        )
        said[verdict != TRANSLATED] = ""
        told = ~(self.gate & (distance > self.farthest))  # bands were tested on tires within reach only
        return pd.DataFrame(
            {
                "verdict": verdict,
                "reason": reason,
                "distance": distance,
                "expected_rms_ratio": np.where(verdict == REFUSED, np.nan, np.sqrt(ratio)),
                "harm_probability": np.where(verdict == REFUSED, np.nan, harm),
                "bias_band": [band.in_words(i) if told[i] else "" for i in range(len(rows))],
                "taught": found.taught.astype(int),
                "changes": said,
            },
            index=rows.index,
        )

    def _too_far(self, distance: float, loads: str) -> str:
        """Say that a tire is outside of the training data, or only farther than was asked for."""
        if distance <= EDGE:
            return (
                f"this tire is farther from what {self.target} has measured than was asked for: distance "
                f"{distance:.3g}, {self.farthest:g} is allowed, the edge is {EDGE:g}"
            )
        beyond = max(distance, 1.01)  # what is beyond the edge never reads as 1.00
        said = (
            f"this tire is outside of what {self.target} has measured: distance {beyond:.2f}, the edge is 1"
        )
        said += f" ({loads})" if loads else ""
        if distance > FARTHEST_DISTANCE:
            return f"{said}; a translation cannot be trusted"
        far = f"{FARTHEST_DISTANCE:g}"
        most = f"it by --params translate.farthest={far} (tire translate: --farthest {far})"
        return f"{said}. Add training files of such tires, or allow {most}"

    def to_state(self) -> dict[str, Any]:
        """Return the arrays, strings and numbers that restore it."""
        return {
            "target": self.target,
            "option_gate": self.gate,
            "option_farthest": self.farthest,
            "doubt": self.harm,
            **self.reach.to_state(),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        return cls(
            str(state["target"]),
            TrainingReach.from_state(state),
            np.asarray(state["doubt"]),
            bool(state["option_gate"]),
            float(state.get("option_farthest", FARTHEST_DISTANCE)),
        )


def _may_be_turned(rows: pd.DataFrame) -> np.ndarray:
    """Rows whose signs are worth a look, shape (n,): in ISO W stiffness and trail have the usual ones."""
    usual = np.sign(rows[["PKY1", "PKY2", "PKX1"]].to_numpy(dtype=float)) == (-1.0, 1.0, 1.0)
    turned = rows["QDZ1"].to_numpy(dtype=float) < 0.0 if "QDZ1" in rows else False
    return np.asarray(~usual.all(axis=1) | turned)


def _other_loads(rows: pd.DataFrame) -> np.ndarray:
    """Say of tires that carry other loads than those at which forces are judged that they do; else ""."""
    out = np.full(len(rows), "", dtype=object)
    if OWN_LOAD not in rows:
        return out
    load = rows[OWN_LOAD].to_numpy(dtype=float)
    beyond = np.flatnonzero(beyond_judged_loads(load) > 1.0)
    factor = float(rows[LOAD_FACTOR].iloc[0]) if LOAD_FACTOR in rows else 1.0
    load, low, high = (factor * values / 1e3 for values in (load, LOADS.min(), LOADS.max()))
    judged = f"side and longitudinal force are judged at {low:.3g} to {high:.3g} kN"
    for i in beyond:
        out[i] = f"{judged}, its nominal load is {float(f'{load[i]:.3g}'):,g} kN"
    return out


def _why_alone(
    organisation: str, target: str, uncertain: bool, band: BiasBand, row: int, ratio: float
) -> str:
    """Say why a file is not translated that could be."""
    bias = f"the band of {organisation}'s bias against {target}"
    if band.negligible[row]:
        return (
            f"{bias} contains zero for such a tire in stiffness and friction, and no more than "
            f"{NEGLIGIBLE:.0%} ({CERTAINTY:.0%} each)"
        )
    if band.contains_zero[row]:
        return (
            f"{bias} contains zero, but also more than {NEGLIGIBLE:.0%} ({band.in_words(row)}): I can't tell "
            f"whether there is one; give more training files of {organisation}"
        )
    if uncertain:
        return f"{organisation}'s bias against {target} cannot be distinguished from chance"
    return (
        f"too little to gain for such a tire: expected RMS error {np.sqrt(ratio):.0%} of the unchanged file's"
    )
