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
from tire_pipeline.translation.curves.bands import curve_bands, stiffness_band
from tire_pipeline.translation.curves.features import LOADS, encode
from tire_pipeline.translation.curves.space import UNIT
from tire_pipeline.translation.decode.least_change import Wish, decode
from tire_pipeline.translation.decode.physics import SYMMETRY, symmetric, violations
from tire_pipeline.translation.judge.bias_band import CERTAINTY, bias_band
from tire_pipeline.translation.judge.effects import protocol_changes
from tire_pipeline.translation.judge.reach import TrainingReach
from tire_pipeline.translation.judge.shrinkage import (
    DOUBTFUL,
    cautious,
    expected_gain,
    failed_fits,
    pooled_doubt,
    without_failed_fits,
)
from tire_pipeline.translation.judge.words import describe_changes
from tire_pipeline.translation.population.fit import Prepared, fit_curve_mixed_model
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction
from tire_pipeline.translation.result import (
    LEFT_ALONE,
    REFUSED,
    TRANSLATED,
    UNBIASED,
    UNKNOWN,
    Band,
    TranslationResult,
    moved_coefficients,
)

COEFFICIENTS = DATASETS["full"]
"""The p and q coefficients: what a translation may change."""

FARTHEST = 3.0
"""Files farther than this from the training data are refused; 1 is the edge of the training data. On tuning
tires every refusal between 1.5 and 2.2 was wrong."""

LEAST_GAIN = 0.05
"""A file whose expected squared error would shrink by less than this share (2.5% in RMS) is left alone."""

VERSIONS = ("5.0", "5.1", "5.2", "PAC2002")
NEEDED = ("FNOMIN", "UNLOADED_RADIUS", "PCY1", "PDY1", "PKY1", "PKY2", "PKX1")
"""What a file must state to be translated."""

_OWN = "it is the target's own"
_UNKNOWN = "no training file is of its supplier: give training files of it"
_VERDICTS = {_OWN: UNBIASED, _UNKNOWN: UNKNOWN}


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
    farthest : float
        Distance to the training data beyond which a file is refused, at most ``FARTHEST``.
    """

    name: ClassVar[str] = "mixed_model"
    uses_pairs: ClassVar[bool] = False

    def __init__(
        self,
        *,
        pairs: bool | None = None,
        trust: float = 1.0,
        gate: bool = True,
        farthest: float = FARTHEST,
    ) -> None:
        self.pairs = self.uses_pairs if pairs is None else bool(pairs)
        self.trust, self.gate, self.farthest = float(trust), bool(gate), min(float(farthest), FARTHEST)

    def fit(
        self, training: pd.DataFrame, *, target: str, seed: int = 0, made: Prepared | None = None
    ) -> Self:
        """Learn; nothing is drawn, ``seed`` is there for the interface.

        Parameters
        ----------
        training, target, seed
            As for every translator.
        made : Prepared, optional
            What :func:`.population.fit.prepare` gave for ``training``, if it is there already.

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
            self._stiffness(table, usable, found, act) if bands else None,
        )

    def _bands(
        self, table: pd.DataFrame, usable: np.ndarray, found: Prediction, act: np.ndarray
    ) -> dict[str, Band]:
        """Bands of all files; NaN for those that cannot be evaluated."""
        own = curve_bands(self.model.space, table.iloc[usable], found.variance, act, pairs=self.model.pairs)
        return {name: _spread(band, usable, len(table)) for name, band in own.items()}

    def _stiffness(self, table: pd.DataFrame, usable: np.ndarray, found: Prediction, act: np.ndarray) -> Band:
        band = stiffness_band(self.model.space, table.iloc[usable], found.variance, act)
        return _spread(band, usable, len(table))

    def _cannot(self, source: pd.DataFrame) -> np.ndarray:
        """Say why a file cannot be translated at all, "" if it can."""
        reason = np.full(len(source), "", dtype=object)
        category = source["category"].astype(str).to_numpy()
        lacking = source.reindex(columns=list(NEEDED)).isna()
        for i in np.flatnonzero(lacking.any(axis=1).to_numpy()):
            reason[i] = (
                f"it does not state {', '.join(lacking.columns[lacking.iloc[i]])}: add what is missing"
            )
        if "version" in source:
            other = ~source["version"].astype(str).isin(VERSIONS).to_numpy()
            reason[other] = (
                "its Magic Formula version is not 5.x: fit 5.2 to its forces first (fit_magic_formula)"
            )
        reason[category == self.target] = _OWN
        reason[~np.isin(category, self.model.categories)] = _UNKNOWN
        usable = np.flatnonzero(reason == "")
        if usable.size:
            features = encode(source.iloc[usable])
            finite = np.all([np.isfinite(values).all(axis=1) for values in features.values()], axis=0)
            reason[usable[~finite]] = "its curves are not finite"
        return reason

    def _empty_report(self, source: pd.DataFrame, refused: np.ndarray) -> pd.DataFrame:
        probability = source.get("category_probability", 1.0)
        return pd.DataFrame(
            {
                "file": source["file"] if "file" in source else source.index.astype(str),
                "source": source["category"].astype(str),
                "source_probability": probability,
                "target": self.target,
                "verdict": np.array([_VERDICTS.get(why, REFUSED) for why in refused], dtype=object),
                "reason": refused,
                "distance": np.nan,
                "expected_rms_ratio": np.nan,
                "harm_probability": np.nan,
                "bias_band": pd.Series("", index=source.index, dtype=object),
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
        band = bias_band(self.model, found)
        broken = violations(moved)
        impossible = (broken & ~violations(rows)).any(axis=1) | broken.drop(columns="curvature").any(axis=1)
        actors = rows["category"].astype(str).to_numpy()
        doubtful = np.isin(actors, np.array(self.model.categories)[self.doubt > DOUBTFUL])
        verdict = np.full(len(rows), TRANSLATED, dtype=object)
        reason = np.full(len(rows), "", dtype=object)
        for i in range(len(rows)):
            reason[i] = f"expected RMS error {np.sqrt(ratio[i]):.0%} of the unchanged file's"
            if self.gate and distance[i] > self.farthest:
                verdict[i], reason[i] = REFUSED, self._too_far(distance[i])
            elif impossible.iloc[i]:
                verdict[i] = REFUSED
                reason[i] = f"no physical tire found: {', '.join(broken.columns[broken.iloc[i]])}"
            elif self.gate and (doubtful[i] or ratio[i] > 1.0 - LEAST_GAIN):
                verdict[i] = UNBIASED if band.holds_zero[i] else LEFT_ALONE
                reason[i] = self._why_alone(actors[i], bool(doubtful[i]), bool(band.holds_zero[i]), ratio[i])
        said = np.array(describe_changes(encode(rows), encode(moved), actors, self.target), dtype=object)
        said[verdict != TRANSLATED] = ""
        return pd.DataFrame(
            {
                "verdict": verdict,
                "reason": reason,
                "distance": distance,
                "expected_rms_ratio": np.sqrt(ratio),
                "harm_probability": harm,
                "bias_band": [band.in_words(i) for i in range(len(rows))],
                "taught": found.taught.astype(int),
                "changes": said,
            },
            index=rows.index,
        )

    def _too_far(self, distance: float) -> str:
        said = f"this tire is outside of what {self.target} has measured: distance {distance:.2f}"
        if distance > FARTHEST:
            return f"{said}, do not trust a translation"
        return f"{said}, the edge is 1; give training files of such tires, or ask with farthest={FARTHEST:g}"

    def _why_alone(self, actor: str, doubtful: bool, holds_zero: bool, ratio: float) -> str:
        """Say why a file is not translated that could be."""
        if holds_zero:
            return (
                f"the band of {actor}'s bias against {self.target} holds zero for such a tire in stiffness "
                f"and friction ({CERTAINTY:.0%} each)"
            )
        if doubtful:
            return f"{actor}'s bias against {self.target} cannot be told from chance"
        return (
            "too little to gain for such a tire: "
            f"expected RMS error {np.sqrt(ratio):.0%} of the unchanged file's"
        )

    def to_state(self) -> dict[str, Any]:
        """Give arrays, strings and numbers that bring the fitted translator back."""
        return {
            "translator": self.name,
            "target": self.target,
            "option_pairs": self.pairs,
            "option_trust": self.trust,
            "option_gate": self.gate,
            "option_farthest": self.farthest,
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
        translator.farthest = float(state.get("option_farthest", FARTHEST))
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


def _spread(band: Band, usable: np.ndarray, count: int) -> Band:
    """The band of the usable files among all; NaN for the others."""

    def among_all(values: np.ndarray) -> np.ndarray:
        out = np.full((count, *values.shape[1:]), np.nan)
        out[usable] = values
        return out

    parts = [among_all(values) for values in (band.middle, band.low, band.high)]
    return Band(band.slip, band.normal_load, *parts)


class PairedMixedModel(MixedModel):
    """The same, with the tires that several categories measured."""

    name: ClassVar[str] = "paired_mixed_model"
    uses_pairs: ClassVar[bool] = True
