"""The user's files -> files as the target would have measured them, with a verdict for each."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Literal

import numpy as np
import pandas as pd
from matplotlib.figure import Figure as MplFigure
from pydantic import Field

from tire_pipeline.classifiers import classifier_from_state
from tire_pipeline.errors import DomainError, TirePipelineError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.pipelines.normalize.nodes import NormalizeParameters
from tire_pipeline.pipelines.parameters import Parameters
from tire_pipeline.progress import track
from tire_pipeline.reporting import Figure, Table, Text, colour_of, new_figure, render_page
from tire_pipeline.representations import representation_from_state
from tire_pipeline.tir import tir_bytes
from tire_pipeline.tire_table import Binning, from_models, normalize_table
from tire_pipeline.translation import make_translator
from tire_pipeline.translation.curve_translator import COEFFICIENTS
from tire_pipeline.translation.result import TranslationResult, comment_lines

Files = Mapping[str, Callable[[], TireModel]]
DRAWN = 6
_PROTOCOLS = (
    "Categories whose files show that the way of measuring changed on a day: that day with its 90% range, "
    "how probable a change is, and by how much it moved the curves of the mean tire (90% intervals). Files "
    "count by their dates, those without one as the mean of both; a target is given by its newest protocol."
)


class TranslateParameters(Parameters):
    """Parameters of ``translate``.

    Attributes
    ----------
    translator : str
        Which of those that give bands and verdicts. The ``batch`` ones learn from the files to translate as
        well.
    pairs : bool
        May tires that several actors measured be used?
    trials : int
        Most files that are translated; 0 is all.
    """

    translator: Literal[
        "mixed_model",
        "paired_mixed_model",
        "batch_mixed_model",
        "paired_batch_mixed_model",
        "likelihood_agent",
    ] = "paired_mixed_model"
    pairs: bool = True
    trials: int = Field(0, ge=0)


def translate_all(
    files_to_translate: Files,
    normalized_table: pd.DataFrame,
    classifier: dict[str, Any],
    representation: dict[str, Any],
    binning: dict[str, Any],
    parameters: TranslateParameters,
    normalize: NormalizeParameters,
    target_category: str,
    seed: int,
) -> tuple[dict[str, bytes], pd.DataFrame, pd.DataFrame, pd.DataFrame, str]:
    """Translate every file.

    Parameters
    ----------
    files_to_translate : mapping
        ``category/.../name.tir`` to the function that reads it. A file whose folder is no known category is
        classified first.
    normalized_table : DataFrame
        What the translator learns from.
    classifier, representation, binning : dict
        States of the fitted forest and what goes before it.
    parameters : TranslateParameters
    normalize : NormalizeParameters
    target_category : str
    seed : int

    Returns
    -------
    files : dict of str to bytes
        The translated ``.tir`` files. Those that are refused or already unbiased are not among them.
    report : DataFrame
        One row a file: verdict, reason, distance, expected ratio, what moved and why in words.
    coefficients : DataFrame
        One row a coefficient that moved.
    bands : DataFrame
        ``file, output, normal_load, slip, middle, low, high``: curves with their 90% band.
    page : str
        The report as HTML.

    Raises
    ------
    DomainError
        If not one file could be read.
    """
    models, problems = _read(files_to_translate, parameters.trials)
    known = set(normalized_table["category"])
    own = from_models((file, _category(file, known), model) for file, model in models.items())
    source = normalize_table(own, normalize.nominal_load)
    source = _classified(source, known, classifier, representation, binning)
    pairs = {} if parameters.translator == "likelihood_agent" else {"pairs": parameters.pairs}
    translator = make_translator(parameters.translator, **pairs)
    result = translator.fit(normalized_table, target=target_category, seed=seed).translation(source)
    texts = _texts(result, models, own)
    report = pd.concat([result.report, problems], ignore_index=True)
    bands = _bands(result, own)
    page = translate_page(report, bands, result.protocols, parameters, target_category)
    return texts, report, result.coefficients, bands, page


def _read(files: Files, most: int) -> tuple[dict[str, TireModel], pd.DataFrame]:
    models: dict[str, TireModel] = {}
    problems = []
    wanted = list(files.items())[: most or None]
    for file, load in track(wanted, "reading files to translate", total=len(wanted)):
        try:
            models[file] = load()
        except Exception as error:
            cause = error.__cause__ or error
            if not isinstance(cause, TirePipelineError | OSError):
                raise
            problems.append({"file": file, "verdict": "refused", "reason": f"cannot be read: {cause}"})
    if not models:
        raise DomainError(
            f"not one of {len(wanted)} files could be read; the first: {problems[0]['reason']}",
            where="translate",
            todo="mend them, then run again",
        )
    return models, pd.DataFrame(problems)


def _category(file: str, known: set[str]) -> str:
    folders = file.split("/")[:-1]
    return next((name for name in reversed(folders) if name in known), "")


def _classified(
    source: pd.DataFrame,
    known: set[str],
    classifier: dict[str, Any],
    representation: dict[str, Any],
    binning: dict[str, Any],
) -> pd.DataFrame:
    """Guess the category of files that have none, with its probability; given ones have probability 1."""
    source = source.assign(category_probability=1.0)
    unknown = ~source["category"].isin(known).to_numpy()
    encoder = representation_from_state(representation)
    if unknown.any() and set(encoder.feature_names) <= set(source.columns):
        rows = source[unknown]
        features = encoder.encode(rows)
        usable = np.isfinite(features).all(axis=1)
        where = np.flatnonzero(unknown)[usable]
        forest = classifier_from_state(classifier)
        chances = forest.predict_proba(Binning.from_state(binning).transform(features[usable]))
        best = chances.argmax(axis=1)
        source.iloc[where, source.columns.get_loc("category")] = forest.classes_[best]
        source.iloc[where, source.columns.get_loc("category_probability")] = chances.max(axis=1)
    return source


def _texts(result: TranslationResult, models: Mapping[str, TireModel], own: pd.DataFrame) -> dict[str, bytes]:
    """Translated tires at their own nominal load, with what was done in the comments."""
    back = normalize_table(result.table, own["FNOMIN"].to_numpy())
    moved = set(result.coefficients["file"]) if len(result.coefficients) else set()
    texts: dict[str, bytes] = {}
    for row, file in enumerate(own["file"]):
        if file not in moved or result.report["verdict"].iloc[row] != "translated":
            continue
        model = models[file]
        values = {
            name: float(back[name].iloc[row])
            for name in COEFFICIENTS
            if name in back.columns and np.isfinite(back[name].iloc[row])
        }
        changed = {name: value for name, value in values.items() if value != model.coefficients.get(name)}
        texts[file] = tir_bytes(model.replace(**changed), comments=comment_lines(result, row, COEFFICIENTS))
    return texts


def _bands(result: TranslationResult, own: pd.DataFrame) -> pd.DataFrame:
    """All bands as one long table."""
    parts = []
    for output, band in result.bands.items():
        n, loads, slips = band.middle.shape
        files = own["file"].to_numpy()
        parts.append(
            pd.DataFrame(
                {
                    "file": np.repeat(files, loads * slips),
                    "output": output,
                    "normal_load": np.tile(np.repeat(band.normal_load, slips), n),
                    "slip": np.tile(band.slip, n * loads),
                    **{name: getattr(band, name).ravel() for name in ("middle", "low", "high")},
                }
            )
        )
    columns = ["file", "output", "normal_load", "slip", "middle", "low", "high"]
    return pd.concat(parts, ignore_index=True) if parts else pd.DataFrame(columns=columns)


def translate_page(
    report: pd.DataFrame,
    bands: pd.DataFrame,
    protocols: pd.DataFrame,
    parameters: TranslateParameters,
    target: str,
) -> str:
    """What was translated, what was not, and why; curves of some with their band."""
    counts = report["verdict"].value_counts()
    words = ", ".join(f"{count} {verdict}" for verdict, count in counts.items())
    lines = [
        f"{len(report)} files, to be as {target} would have measured them: {words}.",
        "Translated: the error is expected to shrink. Already unbiased: too little would be gained. "
        "Refused: it lies outside of what was learned from, or the error would probably grow; not written.",
        f"Method: {parameters.translator}, tires measured by several actors "
        + ("used." if parameters.pairs else "not used."),
    ]
    if "taught" in report and report["taught"].max() > 0:
        lines.append(
            "The files to translate taught, too: each was translated by what those of other tires say of "
            "their categories. With other files beside it, it would come out a little differently."
        )
    columns = [
        "file",
        "source",
        "source_probability",
        *(["protocol"] if len(protocols) else []),
        "verdict",
        "distance",
        "expected_ratio",
    ]
    why = report.reindex(columns=["reason", "changes"]).astype("object").fillna("")
    shown = report.reindex(columns=columns).assign(
        why=why["reason"].str.cat(why["changes"], sep=". ").str.strip(". ")
    )
    parts: list[Text | Table | Figure] = [Text(lines, emphasis=True)]
    figure = band_figure(bands, shown.loc[shown["verdict"] == "translated", "file"].tolist())
    if figure is not None:
        caption = "Lateral force of some translated files with its 90% band, at each load."
        parts.append(Figure(figure, caption, heading="Curves"))
    if len(protocols):
        parts.append(Table(_spaced(protocols), _PROTOCOLS, heading="Changes of protocol"))
    caption = (
        "distance: 1 is the edge of the training data, do not trust beyond. expected ratio: expected squared "
        "error after translation over that before, by the translator's own estimate."
    )
    parts.append(Table(_spaced(shown), caption, heading="Every file", most_rows=500, below="why"))
    return render_page(f"Translated to {target}", parts)


def _spaced(table: pd.DataFrame) -> pd.DataFrame:
    """The table with column names that a browser can break."""
    return table.rename(columns=lambda name: name.replace("_", " "))


def band_figure(bands: pd.DataFrame, files: list[str]) -> MplFigure | None:
    """Lateral force and its band, for up to six files."""
    lateral = bands[bands["output"] == "fy"]
    drawn = [file for file in files if (lateral["file"] == file).any()][:DRAWN]
    if not drawn:
        return None
    columns = min(3, len(drawn))
    rows = -(-len(drawn) // columns)
    figure, axes = new_figure(rows, columns, width=3.4 * columns, height=2.8 * rows, squeeze=False)
    for one, file in zip(np.asarray(axes).ravel(), drawn, strict=False):
        for i, (load, part) in enumerate(lateral[lateral["file"] == file].groupby("normal_load")):
            angle = np.degrees(part["slip"])
            one.plot(angle, part["middle"] / 1e3, color=colour_of(i), label=f"{load / 1e3:.0f} kN")
            one.fill_between(angle, part["low"] / 1e3, part["high"] / 1e3, color=colour_of(i), alpha=0.25)
        one.set_title(file, fontsize=8)
        one.set_xlabel("slip angle / deg")
        one.set_ylabel("lateral force / kN")
    np.asarray(axes).ravel()[0].legend(title="normal load", fontsize=7)
    return figure
