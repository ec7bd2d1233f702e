"""Who supplied the files to translate: their folder says it, or, if asked, an open-set classification."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Self

import pandas as pd

from tire_pipeline.classifiers.open_set import (
    LEAST_PROBABILITY,
    LEAST_TYPICALITY,
    Assignment,
    OpenSetClassifier,
)
from tire_pipeline.classifiers.supplier_features import supplier_features

UNKNOWN_SUPPLIER = "unknown"
BY_FOLDER = "by its folder"
WHAT_TO_DO = (
    "train again with enough files of this supplier in a folder of its own (filter_report.csv says which "
    "were not used, and why), or ask for classification by --params translate.classify=true"
)


def category_of(file: str, known: set[str]) -> str:
    """Return the innermost folder of ``file`` that is a known category, "" if none is."""
    folders = file.split("/")[:-1]
    return next((name for name in reversed(folders) if name in known), "")


@dataclass(frozen=True)
class KnownSuppliers:
    """Finds the supplier of each file to translate.

    Attributes
    ----------
    names : tuple of str
        The training files' categories, sorted.
    classifier : OpenSetClassifier or None
        Classifies files of unknown suppliers, if it is asked for.
    """

    names: tuple[str, ...]
    classifier: OpenSetClassifier | None = None

    @classmethod
    def learn(cls, training: pd.DataFrame, files: Collection[str], *, classify: bool, seed: int) -> Self:
        """Learn from the training files.

        Parameters
        ----------
        training : DataFrame
            What is known of suppliers.
        files : collection of str
            The files to translate: nothing is trained if all their folders say it.
        classify : bool
            Classify files of unknown suppliers. Only those are given to a category whose probability and
            typicality suffice (:mod:`.classifiers.open_set`).
        seed : int
        """
        names = sorted(training["category"].astype(str).unique())
        known = set(names)
        if not classify or all(category_of(file, known) for file in files):
            return cls(tuple(names))
        labels, tires = (training[name].to_numpy(dtype=str) for name in ("category", "tire_id"))
        model = OpenSetClassifier().fit(supplier_features(training)[0], labels, tires, seed=seed)
        return cls(tuple(names), model)

    def by_folder(self, file: str) -> str:
        """The innermost folder of a file that is a known category, "" if none is."""
        return category_of(file, set(self.names))

    def of(self, source: pd.DataFrame) -> pd.DataFrame:
        """Return the supplier of each file, and how it is known.

        Parameters
        ----------
        source : DataFrame
            Files to translate, at the nominal load of the training files; ``category`` is "" where the folder
            is no known category.

        Returns
        -------
        DataFrame
            ``source`` with ``category`` as it is known now, ``category_probability``, ``supplier_known`` (how
            the supplier is known, in words; "unknown") and ``supplier_note`` (of unknown suppliers: why and
            what to do).
        """
        unknown = ~source["category"].isin(self.names)
        found = source.copy().assign(category_probability=1.0, supplier_known=BY_FOLDER, supplier_note="")
        found.loc[unknown, "supplier_known"] = UNKNOWN_SUPPLIER
        found.loc[unknown, "category_probability"] = float("nan")
        found.loc[unknown, "supplier_note"] = [
            f"{_place(file)} is no known category ({', '.join(self.names)}): {WHAT_TO_DO}"
            for file in found.loc[unknown, "file"]
        ]
        if self.classifier is not None and unknown.any():
            _classify(found, unknown, self.classifier)
        return found


def _place(file: str) -> str:
    folder = file.rpartition("/")[0]
    return f"its folder {folder!r}" if folder else "it is in no folder, which"


def _classify(found: pd.DataFrame, unknown: pd.Series, model: OpenSetClassifier) -> None:
    told = model.assign(supplier_features(found.loc[unknown])[0])
    for i, row in enumerate(found.index[unknown]):
        if told.given[i]:
            found.loc[row, "category"] = told.category[i]
            found.loc[row, "category_probability"] = told.probability[i]
            found.loc[row, "supplier_known"] = (
                f"classified (probability {_shown(told.probability[i])}, typicality {told.typicality[i]:.2f})"
            )
            found.loc[row, "supplier_note"] = ""
        else:
            found.loc[row, "supplier_note"] = _why_nobodys(told, i)


def _why_nobodys(told: Assignment, i: int) -> str:
    name = told.category[i]
    probability, least = told.probability[i], f"{LEAST_PROBABILITY:g} is needed"
    return (
        f"given to no category: if its supplier were one of the known ones, it would be {name} (calibrated "
        f"probability {_shown(probability)}, {least}), and its typicality among {name}'s files is "
        f"{told.typicality[i]:.2f} ({LEAST_TYPICALITY:g} is needed); put training files of this supplier "
        "into a folder of its own and train again"
    )


def _shown(probability: float) -> str:
    return "above 0.99" if probability > 0.99 else f"{probability:.2f}"
