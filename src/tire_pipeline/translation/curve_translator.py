"""Translators that move a tire in the space of its curves, by the mixed model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from tire_pipeline.errors import DomainError
from tire_pipeline.representations.coefficients import DATASETS
from tire_pipeline.translation.base import check_target
from tire_pipeline.translation.caution import (
    DOUBTFUL,
    cautious,
    expected_gain,
    failed_fits,
    pooled_doubt,
    without_failed_fits,
)
from tire_pipeline.translation.curve_bands import curve_bands
from tire_pipeline.translation.curve_features import LOADS, encode
from tire_pipeline.translation.curve_mixed import CurveMixedModel, Prediction
from tire_pipeline.translation.curve_mixed_fit import Prepared, fit_curve_mixed_model
from tire_pipeline.translation.curve_space import UNIT
from tire_pipeline.translation.decode import Wish, decode
from tire_pipeline.translation.distance import TrainingReach
from tire_pipeline.translation.effects import protocol_changes
from tire_pipeline.translation.physics import SYMMETRY, symmetric, violations
from tire_pipeline.translation.result import (
    REFUSED,
    TRANSLATED,
    UNBIASED,
    Band,
    TranslationResult,
    moved_coefficients,
)
from tire_pipeline.translation.words import describe_changes

COEFFICIENTS = DATASETS["full"]
"""The p and q coefficients: what a translation may change."""

FARTHEST = 3.0
"""Files farther than this from the training data are refused; 1 is the edge of the training data. On tuning
tires every refusal between 1.5 and 2.2 was wrong."""

LEAST_GAIN = 0.05
"""A file whose expected squared error would shrink by less than this share is already unbiased."""

VERSIONS = ("5.0", "5.1", "5.2", "PAC2002")


class MixedModel:
    """Bias as a mixed model conditioned on the metadata; each file moved by its own posterior mean.

    Shrinks towards *no change* by its own estimate of the error (empirical Bayes): where the training data
    does not show a bias, the variance of the category effects is near zero, and so is the move.

    Parameters
    ----------
    pairs : bool
        Use that several categories measured one tire, if they did.
    trust : float
        How far what is a source file's own is drawn towards the expectation for such a tire, as far as it is
        noise; 0: not at all.
    gate : bool
        Leave files alone for which little gain is expected, and refuse those far from the training data.
    """

    name: ClassVar[str] = "mixed_model"
    uses_pairs: ClassVar[bool] = False

    def __init__(self, *, pairs: bool | None = None, trust: float = 1.0, gate: bool = True) -> None:
        self.pairs = self.uses_pairs if pairs is None else bool(pairs)
        self.trust, self.gate = float(trust), bool(gate)

    def fit(
        self, training: pd.DataFrame, *, target: str, seed: int = 0, made: Prepared | None = None
    ) -> Self:
        """Learn; nothing is drawn, ``seed`` is there for the interface.

        Parameters
        ----------
        training, target, seed
            As for every translator.
        made : Prepared, optional
            What :func:`.curve_mixed_fit.prepare` gave for ``training``, if it is there already.

        Raises
        ------
        DomainError
            If the table has no tire of the target, or none of any other category.
        """
        check_target(training, target)
        training = training.reset_index(drop=True)
        self.target = target
        with threadpool_limits(1):  # thousands of small matrices: threads would only wait for each other
            self.model: CurveMixedModel = fit_curve_mixed_model(training, pairs=self.pairs, made=made)
            self.reach = TrainingReach.fit(self.model, training, target)
            found = cautious(self.model, self.model.predict(training, target, trust=self.trust))
            category = training["category"].to_numpy(dtype=str)
            harm = expected_gain(self.model, found)[1]
            self.doubt = pooled_doubt(harm, category, self.model.categories, target)
        self._learn_coefficients(training)
        return self

    def _learn_coefficients(self, training: pd.DataFrame) -> None:
        values = training.reindex(columns=list(COEFFICIENTS)).fillna(0.0)
        low, middle, high = (values.quantile(q).to_numpy() for q in (0.002, 0.5, 0.998))
        self.limits = np.stack([low, middle, high, np.maximum(values.std().to_numpy(), 1e-6)], axis=1)

    def predict(self, source: pd.DataFrame) -> Prediction:
        """Predict the target's scores of every source file; other translators replace this."""
        found = cautious(self.model, self.model.predict(source, self.target, trust=self.trust))
        return without_failed_fits(self.model, found)

    def translate(self, source: pd.DataFrame) -> pd.DataFrame:
        """Give the translated tires: same rows, columns, index and metadata."""
        return self.translation(source, bands=False).table

    def translation(self, source: pd.DataFrame, *, bands: bool = True) -> TranslationResult:
        """Translate, and say what was done.

        Parameters
        ----------
        source : DataFrame
            Tire table with ``category``; with ``category_probability`` if the categories were guessed.
        bands : bool
            Also give the 90% bands.

        Returns
        -------
        TranslationResult

        Raises
        ------
        DomainError
            If there is no file, or coefficients of the lateral force are missing.
        """
        if not len(source):
            raise DomainError("there is no file to translate", todo="give at least one")
        refused = self._cannot(source)
        usable = np.flatnonzero(refused == "")
        table = source.copy()
        report = self._empty_report(source, refused)
        protocols = protocol_changes(self.model)
        if not usable.size:
            return TranslationResult(table, report, {}, pd.DataFrame(), self.name, protocols)
        rows = source.iloc[usable]
        with threadpool_limits(1):
            found = self.predict(rows)
            moved = self._decode(rows, found)
        judged = self._judge(rows, moved, found)
        act = (judged["verdict"] == TRANSLATED).to_numpy()
        changed = np.zeros(len(source), dtype=bool)
        changed[usable[act]] = True
        table.loc[changed, list(COEFFICIENTS)] = moved.loc[act, list(COEFFICIENTS)].to_numpy()
        for name in judged:
            report.iloc[usable, report.columns.get_loc(name)] = judged[name].to_numpy()
        return TranslationResult(
            table,
            report,
            self._bands(table, usable, found, act) if bands else {},
            moved_coefficients(source, table, COEFFICIENTS),
            self.name,
            protocols,
        )

    def _bands(
        self, table: pd.DataFrame, usable: np.ndarray, found: Prediction, act: np.ndarray
    ) -> dict[str, Band]:
        """Bands of all files; NaN for those that cannot be evaluated."""

        def spread(values: np.ndarray) -> np.ndarray:
            out = np.full((len(table), *values.shape[1:]), np.nan)
            out[usable] = values
            return out

        own = curve_bands(self.model.space, table.iloc[usable], found.variance, act, pairs=self.model.pairs)
        return {
            name: Band(b.slip, b.normal_load, spread(b.middle), spread(b.low), spread(b.high))
            for name, b in own.items()
        }

    def _cannot(self, source: pd.DataFrame) -> np.ndarray:
        """Say why a file cannot be translated at all, "" if it can."""
        reason = np.full(len(source), "", dtype=object)
        category = source["category"].astype(str).to_numpy()
        reason[~np.isin(category, self.model.categories)] = "no training file is of its category"
        lacking = source.reindex(
            columns=["FNOMIN", "UNLOADED_RADIUS", "PCY1", "PDY1", "PKY1", "PKY2", "PKX1"]
        )
        reason[lacking.isna().any(axis=1).to_numpy()] = "coefficients are missing"
        if "version" in source:
            other = ~source["version"].astype(str).isin(VERSIONS).to_numpy()
            reason[other] = "its Magic Formula version is not 5.x: write it as 5.2 first"
        reason[category == self.target] = "it is the target's own"
        usable = np.flatnonzero(reason == "")
        if usable.size:
            features = encode(source.iloc[usable])
            finite = np.all([np.isfinite(values).all(axis=1) for values in features.values()], axis=0)
            reason[usable[~finite]] = "its curves are not finite"
        return reason

    def _empty_report(self, source: pd.DataFrame, refused: np.ndarray) -> pd.DataFrame:
        own = refused == "it is the target's own"
        probability = source.get("category_probability", 1.0)
        return pd.DataFrame(
            {
                "file": source["file"] if "file" in source else source.index.astype(str),
                "source": source["category"].astype(str),
                "source_probability": probability,
                "target": self.target,
                "verdict": np.where(own, UNBIASED, REFUSED).astype(object),
                "reason": refused,
                "distance": np.nan,
                "expected_ratio": np.nan,
                "harm_probability": np.nan,
                "taught": 0,
                "protocol": self.model.protocols.in_words(source),
                "changes": pd.Series("", index=source.index, dtype=object),
            },
            index=source.index,
        )

    def _decode(self, rows: pd.DataFrame, found: Prediction) -> pd.DataFrame:
        space = self.model.space
        source_features = encode(rows)
        _, rest = space.encode(rows)
        rest["aligning torque"][failed_fits(self.model, found)] = 0.0
        wanted = space.features(found.target, rest)
        locked = {}
        for group, names in SYMMETRY.items():
            even = symmetric(rows, group)
            locked.update({name: even for name in names})
            first = (wanted[group].shape[1] + 2 * LOADS.size) // 2  # the even features follow the odd ones
            wanted[group][even, first:] = source_features[group][even, first:]
        limits = dict(zip(COEFFICIENTS, self.limits, strict=True))
        return decode(
            rows,
            Wish(
                wanted,
                UNIT,
                {name: float(limit[3]) for name, limit in limits.items()},
                {name: float(limit[1]) for name, limit in limits.items()},
                {name: (float(limit[0]), float(limit[2])) for name, limit in limits.items()},
                locked,
            ),
        )

    def _judge(self, rows: pd.DataFrame, moved: pd.DataFrame, found: Prediction) -> pd.DataFrame:
        """Verdict, reason, distance, expected ratio, probability of harm and words, one row a file."""
        ratio, harm = expected_gain(self.model, found)
        distance = self.reach.distance(self.model, rows, found)
        broken = violations(moved)
        before = violations(rows)
        new = broken & ~before
        verdict = np.full(len(rows), TRANSLATED, dtype=object)
        reason = np.full(len(rows), "", dtype=object)
        actors = rows["category"].astype(str).to_numpy()
        doubtful = np.isin(actors, np.array(self.model.categories)[self.doubt > DOUBTFUL])
        for i in range(len(rows)):
            reason[i] = f"expected error {ratio[i]:.0%} of the unchanged file's"
            if self.gate and distance[i] > FARTHEST:
                verdict[i] = REFUSED
                reason[i] = f"this tire is outside of what {self.target} has measured: do not trust"
            elif new.iloc[i].any() or broken.iloc[i].drop("curvature").any():
                verdict[i] = REFUSED
                reason[i] = f"no physical tire found: {', '.join(broken.columns[broken.iloc[i]])}"
            elif self.gate and doubtful[i]:
                verdict[i] = UNBIASED
                reason[i] = f"{actors[i]}'s bias against {self.target} is too small to be told from chance"
            elif self.gate and ratio[i] > 1.0 - LEAST_GAIN:
                verdict[i] = UNBIASED
                reason[i] = "no bias worth correcting was found for such a tire"
        said = np.array(describe_changes(encode(rows), encode(moved), actors, self.target), dtype=object)
        said[verdict != TRANSLATED] = ""
        return pd.DataFrame(
            {
                "verdict": verdict,
                "reason": reason,
                "distance": distance,
                "expected_ratio": ratio,
                "harm_probability": harm,
                "taught": found.taught.astype(int),
                "changes": said,
            },
            index=rows.index,
        )

    def to_state(self) -> dict[str, Any]:
        """Give arrays, strings and numbers that bring the fitted translator back."""
        return {
            "translator": self.name,
            "target": self.target,
            "option_pairs": self.pairs,
            "option_trust": self.trust,
            "option_gate": self.gate,
            "coefficient_limits": self.limits,
            "doubt": self.doubt,
            **self.reach.to_state(),
            **self.model.to_state(),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Bring back what :meth:`to_state` gave; it translates the same."""
        translator = cls._with_options(state)
        translator.target = str(state["target"])
        translator.limits = np.asarray(state["coefficient_limits"])
        translator.doubt = np.asarray(state["doubt"])
        translator.reach = TrainingReach.from_state(state)
        translator.model = CurveMixedModel.from_state(state)
        return translator

    @classmethod
    def _with_options(cls, state: Mapping[str, Any]) -> Self:
        return cls(
            pairs=bool(state["option_pairs"]),
            trust=float(state["option_trust"]),
            gate=bool(state["option_gate"]),
        )


class PairedMixedModel(MixedModel):
    """The same, with the tires that several categories measured."""

    name: ClassVar[str] = "paired_mixed_model"
    uses_pairs: ClassVar[bool] = True
