"""Translators that move a tire in the space of its curves: predictor, decoder, verdict."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from tire_pipeline.errors import DomainError
from tire_pipeline.translation.base import check_target
from tire_pipeline.translation.composition import Parts
from tire_pipeline.translation.curves.bands import curve_bands, stiffness_band
from tire_pipeline.translation.curves.features import LOADS
from tire_pipeline.translation.curves.load_scale import LoadScale
from tire_pipeline.translation.decode.scores_to_coefficients import COEFFICIENTS, Decoder
from tire_pipeline.translation.judge.effects import protocol_changes
from tire_pipeline.translation.judge.verdict import FARTHEST_DISTANCE, VerdictRules
from tire_pipeline.translation.population.fit_model import PreparedTraining, fit_curve_mixed_model, prepare
from tire_pipeline.translation.population.fit_space import with_finite_curves
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction
from tire_pipeline.translation.predict.base import Predictor
from tire_pipeline.translation.predict.batch import BatchLearning
from tire_pipeline.translation.predict.mixed import MixedPredictor
from tire_pipeline.translation.result import TRANSLATED, Band, TranslationResult, moved_coefficients


@dataclass(frozen=True)
class CurveOptions:
    """How a translator of curves learns and judges.

    Attributes
    ----------
    pairs : bool
        Use that several categories measured one tire, if they did.
    learn_from_batch : bool
        Learn from the files to translate, too (:mod:`.predict.batch`).
    trust : float
        How far the tire effect of a source file is shrunk towards the expectation for such a tire, as
        far as it is noise, where the verdict weighs the training files; 0: not at all.
    gate : bool
        Leave files alone for which little gain is expected, and refuse those far from the training data.
    farthest : float
        Distance to the training data beyond which a file is refused, at most ``FARTHEST_DISTANCE``.
    """

    pairs: bool
    learn_from_batch: bool = False
    trust: float = 0.0
    gate: bool = False
    farthest: float = FARTHEST_DISTANCE

    def __post_init__(self) -> None:
        """Take what a configuration gives: 1 for true, an integer for a float."""
        for name, kind in (("pairs", bool), ("learn_from_batch", bool), ("trust", float), ("gate", bool)):
            object.__setattr__(self, name, kind(getattr(self, name)))
        object.__setattr__(self, "farthest", min(float(self.farthest), FARTHEST_DISTANCE))


class CurveTranslator:
    """A predictor with the population's model below it, and decoder and verdict above it.

    Parameters
    ----------
    predictor : Predictor
        Not fitted yet.
    options : CurveOptions
    """

    name: ClassVar[str]
    predictors: ClassVar[type[Predictor]]

    def __init__(self, predictor: Predictor, options: CurveOptions) -> None:
        self._predictor, self._options = predictor, options
        self._parts: Parts | None = None

    def _with_parts(self, parts: Parts, options: CurveOptions) -> Self:
        """The same translator, composed of other parts; the rules of the verdict override options."""
        other, rules = copy(self), parts.verdict
        other._parts, other._predictor = parts, parts.predictor
        other._options = replace(options, gate=rules.gate, farthest=rules.farthest)
        return other

    @property
    def pairs(self) -> bool:
        """Whether it uses that several categories measured one tire."""
        return self._options.pairs

    @property
    def learn_from_batch(self) -> bool:
        """Whether it learns from the files to translate, too."""
        return self._options.learn_from_batch

    @property
    def parts(self) -> Parts:
        """What it is composed of.

        Raises
        ------
        DomainError
            If it is not fitted.
        """
        if self._parts is None:
            raise DomainError(f"the translator {self.name} is not fitted", todo="call fit(...) first")
        return self._parts

    @property
    def model(self) -> CurveMixedModel:
        """The population's model."""
        return self.parts.model

    @property
    def target(self) -> str:
        """The category that it translates to."""
        return self.parts.verdict.target

    @property
    def categories(self) -> tuple[str, ...]:
        """The categories that it has learned from."""
        return tuple(str(name) for name in self.model.categories)

    def __repr__(self) -> str:
        return f"<translator: {self.method}>"

    @property
    def method(self) -> str:
        """Name and options, as they stand in translated files."""
        return self.name

    def fit(
        self, training: pd.DataFrame, *, target: str, seed: int = 0, made: PreparedTraining | None = None
    ) -> Self:
        """Learn.

        Parameters
        ----------
        training, target, seed
            As for every translator; the mixed model draws nothing. Files whose curves overflow are left
            out.
        made : PreparedTraining, optional
            What :func:`.population.fit_model.prepare` gave for ``training``, if it is there already.

        Raises
        ------
        DomainError
            If the table has no tire of the target, or none of any other category.
        """
        loads = LoadScale.fit(training) if made is None else LoadScale()
        training = with_finite_curves(loads.scaled(training)) if made is None else training
        check_target(training, target)
        options, training = self._options, training.reset_index(drop=True)
        if self.learn_from_batch:
            made = made or prepare(training, pairs=self.pairs)
        with threadpool_limits(1):  # thousands of small matrices: threads would only wait for each other
            model = fit_curve_mixed_model(training, pairs=self.pairs, made=made)
            rules = VerdictRules.fit(
                model, training, target, trust=options.trust, gate=options.gate, farthest=options.farthest
            )
        predictor = self._predictor.fit(model, training, target, seed)
        batch = BatchLearning.of(made, training) if self.learn_from_batch and made else None
        self._parts = Parts(model, predictor, batch, Decoder.fit(training), rules, loads=loads)
        return self

    def predict(self, source: pd.DataFrame) -> Prediction:
        """Predict the target's scores of every source file."""
        return self.parts.predict(self.parts.loads.scaled(source))

    def with_verdict(self, **changes: Any) -> Self:
        """Return the same translator with other :class:`.judge.verdict.VerdictRules`.

        Parameters
        ----------
        **changes
            Such as ``farthest=1.5`` or ``gate=False``; with another ``target`` it translates to that one.
        """
        parts = replace(self.parts, verdict=replace(self.parts.verdict, **changes))
        return self._with_parts(parts, self._options)

    def teaching(self, source: pd.DataFrame) -> tuple[np.ndarray, pd.DataFrame]:
        """Return what :meth:`taught` needs of some files of a batch: the tires, and the files that may teach.

        Parameters
        ----------
        source : DataFrame
            As for :meth:`translation`.
        """
        parts = self.parts
        source = parts.loads.scaled(source)
        rows = source.iloc[np.flatnonzero(parts.verdict.refusals(parts.model, source) == "")]
        if not len(rows):
            return np.empty(0, dtype=str), rows
        with threadpool_limits(1):
            return np.unique(rows["tire_id"].to_numpy(dtype=str)), parts.teachers(rows)

    def taught(self, tires: np.ndarray, teachers: pd.DataFrame) -> Self:
        """Return the same translator after it has learned from a batch.

        It translates any files of the batch as if all were translated together. One that learns from no batch
        is given back as it is.

        Parameters
        ----------
        tires : ndarray of str
        teachers : DataFrame
            From :meth:`teaching`, of all files of the batch.
        """
        parts = self.parts
        if parts.batch is None:
            return self
        with threadpool_limits(1):
            learned = parts.batch.learn(parts.model, tires, teachers)
        return self._with_parts(replace(parts, taught=learned), self._options)

    def protocol_changes(self) -> pd.DataFrame:
        """Return the categories that changed how they measure, one row each."""
        return protocol_changes(self.model)

    def translate(self, source: pd.DataFrame) -> pd.DataFrame:
        """Return the translated tires: same rows, columns, index and metadata."""
        return self.translation(source, bands=False).table

    def translation(
        self, source: pd.DataFrame, *, bands: bool = True, farthest: float | None = None
    ) -> TranslationResult:
        """Translate, and say what was done.

        Parameters
        ----------
        source : DataFrame
            Tire table with ``category``; with ``category_probability`` if the categories were guessed.
        bands : bool
            Also give the 90% bands.
        farthest : float, optional
            Distance to the training data beyond which a file is refused; as it was fitted if not given.

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
        if farthest is not None:
            return self.with_verdict(farthest=float(farthest)).translation(source, bands=bands)
        parts = self.parts
        model, verdict = parts.model, parts.verdict
        scaled = parts.loads.scaled(source)
        refused = verdict.refusals(model, scaled)
        usable = np.flatnonzero(refused == "")
        table = source.copy()
        report = verdict.empty_report(model, source, refused)
        protocols = self.protocol_changes()
        compared = LOADS * parts.loads.factor
        if not usable.size:
            return TranslationResult(
                table, report, {}, pd.DataFrame(), self.method, protocols, normal_load=compared
            )
        rows = scaled.iloc[usable]
        with threadpool_limits(1):
            found = parts.predict(rows)
            moved = parts.decoder.decode(model, rows, found)
        judged = verdict.judge(model, rows, moved, found)
        act = (judged["verdict"] == TRANSLATED).to_numpy()
        changed = np.zeros(len(source), dtype=bool)
        changed[usable[act]] = True
        names = list(COEFFICIENTS)
        table.loc[changed, names] = parts.loads.unscaled(moved.loc[act])[names].to_numpy()
        kept = rows.copy()
        kept.loc[act, names] = moved.loc[act, names].to_numpy()
        for name in judged:
            report.iloc[usable, report.columns.get_loc(name)] = judged[name].to_numpy()
        return TranslationResult(
            table,
            report,
            self._bands(kept, usable, found, act, len(table)) if bands else {},
            moved_coefficients(source, table, COEFFICIENTS),
            self.method,
            protocols,
            self._stiffness(kept, usable, found, act, len(table)) if bands else None,
            compared,
        )

    def _bands(
        self, kept: pd.DataFrame, usable: np.ndarray, found: Prediction, act: np.ndarray, count: int
    ) -> dict[str, Band]:
        """Bands of all files; NaN for those that cannot be evaluated. ``kept``: the others, scaled."""
        own = curve_bands(self.model.space, kept, found.variance, act, pairs=self.model.pairs)
        return {name: _among_all(band, usable, count, self.parts.loads.factor) for name, band in own.items()}

    def _stiffness(
        self, kept: pd.DataFrame, usable: np.ndarray, found: Prediction, act: np.ndarray, count: int
    ) -> Band:
        band = stiffness_band(self.model.space, kept, found.variance, act)
        return _among_all(band, usable, count, self.parts.loads.factor)

    def to_state(self) -> dict[str, Any]:
        """Return the arrays, strings and numbers that restore the fitted translator."""
        parts = self.parts
        return {
            "translator": self.name,
            "option_pairs": self.pairs,
            "option_learn_from_batch": self.learn_from_batch,
            "option_trust": self._options.trust,
            "coefficient_limits": parts.decoder.limits,
            "load_factor": parts.loads.factor,
            **parts.verdict.to_state(),
            **parts.model.to_state(),
            **parts.predictor.to_state(),
            **(parts.batch.to_state() if parts.batch else {}),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned; it translates the same."""
        learns = bool(state.get("option_learn_from_batch", False))
        parts = Parts(
            CurveMixedModel.from_state(state),
            cls.predictors.from_state(state),
            BatchLearning.from_state(state) if learns else None,
            Decoder(np.asarray(state["coefficient_limits"])),
            VerdictRules.from_state(state),
            loads=LoadScale(float(state.get("load_factor", 1.0))),
        )
        options = CurveOptions(state["option_pairs"], learns, state["option_trust"])
        shared: dict[str, Any] = {"pairs": options.pairs}  # an option of every translator of curves
        return cls(**shared)._with_parts(parts, options)


def _among_all(band: Band, usable: np.ndarray, count: int, factor: float) -> Band:
    """The band of the usable files among all, loads and forces times a factor; NaN for the others."""

    def among_all(values: np.ndarray) -> np.ndarray:
        out = np.full((count, *values.shape[1:]), np.nan)
        out[usable] = factor * values
        return out

    parts = [among_all(values) for values in (band.middle, band.low, band.high)]
    return Band(band.slip, factor * band.normal_load, *parts)


class MixedModel(CurveTranslator):
    """Bias as a mixed model conditioned on the metadata; each file moved by its own posterior mean.

    Shrinks towards *no change* by its own estimate of the error (empirical Bayes): where the training data
    does not show a bias, the variance of the category effects is near zero, and so is the move.

    Parameters
    ----------
    pairs : bool
        Use that several categories measured one tire, if they did.
    learn_from_batch : bool
        Learn from the files to translate, too, what they say of whoever measured them. A file is translated
        by what files of *other* tires taught: no file of its own tire counts, and no measurement of the
        target beyond the training files. So a file alone comes out as without.
    trust : float
        How far the tire effect of a source file is shrunk towards the expectation for such a tire, as
        far as it is noise; 0: not at all.
    gate : bool
        Leave files alone for which little gain is expected, and refuse those far from the training data.
    farthest : float
        Distance to the training data beyond which a file is refused, at most ``FARTHEST_DISTANCE``.

    Notes
    -----
    With ``learn_from_batch`` a translation depends on the batch. Where every file must come out alike
    whatever is translated with it, leave it off.
    """

    name: ClassVar[str] = "mixed_model"
    predictors: ClassVar[type[Predictor]] = MixedPredictor

    def __init__(
        self,
        *,
        pairs: bool = True,
        learn_from_batch: bool = False,
        trust: float = 1.0,
        gate: bool = True,
        farthest: float = FARTHEST_DISTANCE,
    ) -> None:
        options = CurveOptions(pairs, learn_from_batch, trust, gate, farthest)
        super().__init__(MixedPredictor(options.trust), options)

    @property
    def method(self) -> str:
        """Name and options, as they stand in translated files."""
        how = "with" if self.pairs else "without"
        return f"{self.name} {how} pairs{', learning from the batch' if self.learn_from_batch else ''}"
