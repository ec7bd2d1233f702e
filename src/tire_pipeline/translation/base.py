"""What every translator offers, and how to get one by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Protocol, Self, runtime_checkable

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.on_demand import class_by_name
from tire_pipeline.translation.result import TranslationResult

TRANSLATORS: dict[str, tuple[str, str]] = {
    "agent": ("tire_pipeline.translation.thesis.translator", "AgentTranslator"),
    "no_change": ("tire_pipeline.translation.simple.no_change", "NoChange"),
    "mixed_model": ("tire_pipeline.translation.translator", "MixedModel"),
    "greedy_forest": ("tire_pipeline.translation.simple.greedy_forest", "GreedyForest"),
    "likelihood_agent": ("tire_pipeline.translation.learned", "LikelihoodAgent"),
    "curious_agent": ("tire_pipeline.translation.learned", "CuriousAgent"),
    "cycle_consistent": ("tire_pipeline.translation.learned", "CycleConsistent"),
}
"""Name of a translator -> module and class; imported only when asked for.

A new translator is one file with one class and one line here.
"""

RENAMED = {
    "paired_mixed_model": {"pairs": True, "learn_from_batch": False},
    "batch_mixed_model": {"pairs": False, "learn_from_batch": True},
    "paired_batch_mixed_model": {"pairs": True, "learn_from_batch": True},
}
"""Former names of a mixed model -> its options now. A stored state of that name is read as before."""


class Translator(Protocol):
    """Learns from a training table; gives tires as the target would have measured them.

    Attributes
    ----------
    name : str
        The name by which :func:`make_translator` makes it.

    See Also
    --------
    make_translator : Makes one by its name.
    translator_from_state : Brings a fitted one back.

    Notes
    -----
    A protocol: a class with these methods is a translator, whatever it inherits. How to add one:
    docs/how-to/add_a_method.md. Tables are those of :mod:`tire_pipeline.tire_table`: one tire a row,
    coefficients without a unit, loads in N.

    Examples
    --------
    >>> import pandas as pd
    >>> tires = pd.DataFrame({"category": ["A", "D"], "PDY1": [1.0, 0.9]})
    >>> unchanged = make_translator("no_change").fit(tires, target="D", seed=0)
    >>> unchanged.translate(tires).equals(tires)
    True
    """

    name: ClassVar[str]

    def fit(self, training: pd.DataFrame, *, target: str, seed: int) -> Self:
        """Learn.

        Parameters
        ----------
        training : DataFrame
            Tire table with ``category``, all tires at one nominal load.
        target : str
            The category to translate to.
        seed : int
            Seed of whatever is drawn.

        Returns
        -------
        Translator
            This one.

        Raises
        ------
        DomainError
            If the table has no tire of the target, or none of any other category.
        """
        ...

    def translate(self, source: pd.DataFrame) -> pd.DataFrame:
        """Translate.

        Parameters
        ----------
        source : DataFrame
            Tire table, at the nominal load of the training table.

        Returns
        -------
        DataFrame
            A copy with other coefficients; same rows, columns, index and metadata.
        """
        ...

    def translation(
        self, source: pd.DataFrame, *, bands: bool = True, farthest: float | None = None
    ) -> TranslationResult:
        """Translate, and give a verdict on each file.

        Parameters
        ----------
        source : DataFrame
            As for :meth:`translate`.
        bands : bool
            Also give the 90% bands, if the translator has them.
        farthest : float, optional
            Distance to the training data beyond which a file is refused, if the translator knows it.

        Returns
        -------
        TranslationResult
            ``expected_rms_ratio``, ``distance`` and ``harm_probability`` are NaN where the translator gives
            none.
        """
        ...

    def to_state(self) -> dict[str, Any]:
        """Return what restores the fitted translator.

        Returns
        -------
        dict
            Arrays, strings and numbers by name; ``translator`` is :attr:`name`.
        """
        ...

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore a fitted translator.

        Parameters
        ----------
        state : mapping
            What :meth:`to_state` gave.

        Returns
        -------
        Translator
            Translates the same.
        """
        ...


@runtime_checkable
class JudgingTranslator(Translator, Protocol):
    """A translator that knows its categories, judges each file, and may learn from the files to translate."""

    @property
    def target(self) -> str:
        """The category that it translates to."""
        ...

    @property
    def categories(self) -> tuple[str, ...]:
        """The categories that it has learned from."""
        ...

    @property
    def learn_from_batch(self) -> bool:
        """Whether it learns from the files to translate, too."""
        ...

    def with_verdict(self, **changes: Any) -> Self:
        """Return the same translator with other rules of the verdict, such as ``farthest=1.5``."""
        ...

    def teaching(self, source: pd.DataFrame) -> tuple[np.ndarray, pd.DataFrame]:
        """Return what :meth:`taught` needs of files of a batch: their tires, and those that may teach."""
        ...

    def taught(self, tires: np.ndarray, teachers: pd.DataFrame) -> Self:
        """Return the same translator after it has learned from a batch, if it learns from batches."""
        ...

    def protocol_changes(self) -> pd.DataFrame:
        """Return the categories that changed how they measure, one row each."""
        ...


def judging(translator: Translator) -> JudgingTranslator:
    """Return a translator as one that judges.

    Parameters
    ----------
    translator : Translator
        Fitted.

    Returns
    -------
    JudgingTranslator
        The same object.

    Raises
    ------
    DomainError
        If it gives no verdicts: it models no bias that files could be judged by.
    """
    if not isinstance(translator, JudgingTranslator):
        raise DomainError(f"the translator {translator.name} gives no verdicts", todo="use a mixed model")
    return translator


def _class_of(name: str) -> Any:
    if name in RENAMED:
        options = RENAMED[name]
        raise DomainError(
            f"the translator {name!r} is called 'mixed_model' now",
            todo="write translator: mixed_model with "
            + ", ".join(f"{k}: {v}".lower() for k, v in options.items()),
        )
    return class_by_name(TRANSLATORS, name, "translator")


def make_translator(name: str, **options: Any) -> Translator:
    """Make a translator that has learnt nothing yet.

    Parameters
    ----------
    name : str
        The method: ``mixed_model``, ``no_change``, ``greedy_forest``, ``agent``, ``likelihood_agent``,
        ``curious_agent`` or ``cycle_consistent``.
    **options
        Passed to its constructor.

    Returns
    -------
    Translator
        To be fitted to a table of tires.

    Raises
    ------
    DomainError
        If there is no translator of that name; a former name's error says what to write instead.

    See Also
    --------
    translator_from_state : Brings a fitted one back.

    Notes
    -----
    Which one to choose: docs/how-to/choose_a_translator.md; how each works: docs/explanation/translation.md.

    Examples
    --------
    >>> translator = make_translator("mixed_model", pairs=False)
    >>> translator.name, translator.learn_from_batch
    ('mixed_model', False)
    """
    translator: Translator = _class_of(name)(**options)
    return translator


def translator_from_state(state: Mapping[str, Any]) -> Translator:
    """Restore any translator from its ``to_state()``, also that of a former name.

    Parameters
    ----------
    state : mapping
        From ``to_state()``, or read from its file by :func:`.files.state_files.unpack_state`.

    Returns
    -------
    Translator
        Translates as the one that gave the state.

    Raises
    ------
    DomainError
        If no translator is of the name that the state holds.

    See Also
    --------
    make_translator : Makes one that has learnt nothing yet.

    Notes
    -----
    Former names: docs/how-to/retraining.md.

    Examples
    --------
    >>> translator_from_state({"translator": "no_change", "target": "D"}).target
    'D'
    """
    name = str(state["translator"])
    if name in RENAMED:
        learns = RENAMED[name]["learn_from_batch"]
        state = {**state, "translator": "mixed_model", "option_learn_from_batch": learns}
    translator: Translator = _class_of(str(state["translator"])).from_state(state)
    return translator


def check_target(training: pd.DataFrame, target: str) -> None:
    """Refuse a training table without the target, or with nothing but the target.

    Raises
    ------
    DomainError
        Naming the categories that there are.
    """
    categories = sorted(training["category"].astype(str).unique())
    if target not in categories:
        known = f"one of {', '.join(categories)}" if categories else "its table is empty"
        raise DomainError(
            f"no training file is of the target category {target!r}",
            todo=f"state target_category as in the run that read the files ({known}), or read files of it",
        )
    if len(categories) < 2:
        raise DomainError(
            f"all training files are of the target category {target!r}",
            todo="add files of at least one other category",
        )
