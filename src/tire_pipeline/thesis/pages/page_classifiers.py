"""The page's part on classifiers: Figures 4.1 to 5.8, Tables 5.1 to 5.9, calibration."""

from __future__ import annotations

from collections.abc import Callable

import pandas as pd

from tire_pipeline.classifiers.tuning import ANN_GRID
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.progress import track
from tire_pipeline.reporting import Figure, Part, Table, Text
from tire_pipeline.thesis.pages.class_scores import per_class_table
from tire_pipeline.thesis.pages.figures import BIN_FIGURES, SPLITS, drawing
from tire_pipeline.thesis.pages.words import least_within, listed, plus_minus, points
from tire_pipeline.thesis.published import published_figure, published_table
from tire_pipeline.thesis.result_tables import Results, in_words, over_trainings

CONDITION_COLUMNS = {
    "normal_load": "normal load (N)",
    "condition_median": "condition (median)",
    "condition_p95": "condition (95%)",
    "gain_median": "gain (median)",
    "gain_p95": "gain (95%)",
}
SHORT = {"ANN": "ann", "GNB": "naive_bayes", "RF": "random_forest"}


def classifier_parts(results: Results) -> list[Part]:
    """Everything about classifiers, in the thesis' order."""
    sections: tuple[Callable[[Results], list[Part]], ...] = (
        _classes,
        _ann,
        _forest,
        _comparison,
        _per_class,
        _latent,
        _bins,
        _calibration,
        _condition,
    )
    return [part for section in track(sections, "drawing the classifiers") for part in section(results)]


def figure_part(results: Results, name: str, number: str, words: list[str]) -> list[Part]:
    """A figure of ours under the thesis' words on its own."""
    published = published_figure(number)
    drawn = drawing(results, name)
    heading = f"Figure {number}: {published.caption}"
    parts: list[Part] = [Text([f"Thesis: {published.says}", *words], heading=heading)]
    if drawn is not None:
        parts.append(Figure(drawn, _to_see(name)))
    return parts


def _to_see(name: str) -> str:
    """What to look at in a figure of ours."""
    return {
        "figure_4_1": "Our files of each category, before they are split.",
        "figure_4_2": "Our training files of each category. With SMOTE all bars are equally high.",
        "figure_5_3": "Shares of our test files. Rows are the true categories; what lies off the diagonal "
        "was assigned to another one.",
    }.get(
        name,
        "Ours. Where a line is level, more of it gains nothing. The gap between the splits is the "
        "advantage of having seen other files of the same tire.",
    )


def _classes(results: Results) -> list[Part]:
    counts = results["class_counts"]
    one = counts[counts["split"] == "random"].set_index("category")
    largest = one["all"].sort_values(ascending=False).head(2)
    share = largest.sum() / one["all"].sum()
    balanced = counts.groupby("split")["training_smote"].nunique().eq(1).all()
    return [
        *figure_part(
            results,
            "figure_4_1",
            "4.1",
            [f"Ours: {listed(map(str, largest.index))} are {share:.0%} of {one['all'].sum():,} files."],
        ),
        *figure_part(
            results,
            "figure_4_2",
            "4.2",
            [
                "Ours: with SMOTE every category has "
                + (
                    "the same number of training files, on both splits."
                    if balanced
                    else "a different number."
                )
            ],
        ),
    ]


def _ann(results: Results) -> list[Part]:
    keys = list(ANN_GRID)
    found, grid = results["ann_random"], results["ann_grid"]
    parts: list[Part] = []
    for table_number, frame, most in (("5.1", found, 5), ("5.3", grid, 3)):
        published = published_table(table_number)
        shown = [published.frame.assign(source="thesis")]
        for split in SPLITS:
            part = frame[frame["split"] == split].nlargest(most, "accuracy")
            shown.append(part.assign(source=f"ours, {_folds(split)}"))
        table = pd.concat(shown, ignore_index=True)[["source", *keys, "accuracy", "f1"]]
        table = table.rename(columns=lambda name: name.replace("_", " "))
        words = _tuning_words(frame, published.frame, most)
        if table_number == "5.3":
            words += _left_out(found, grid)
        parts.append(Text(words, heading=f"Table {table_number}: {published.caption}"))
        parts.append(Table(table, "Cross-validated with 4 folds, SMOTE not used, as in the thesis."))
        if table_number == "5.1":
            parts += _narrowed(grid)
    best = {s: grid[grid["split"] == s].nlargest(1, "accuracy").iloc[0] for s in SPLITS}
    thesis = published_table("5.3").frame.iloc[0]
    rows = [[key, thesis[key], *(best[s][key] for s in SPLITS)] for key in keys]
    columns = ["hyperparameter", "thesis", *(f"ours, {_folds(s)}" for s in SPLITS)]
    selected = pd.DataFrame([[str(v) for v in row] for row in rows], columns=columns)
    same = [row[0].replace("_", " ") for row in rows if str(row[1]) == str(row[2])]
    selected["hyperparameter"] = selected["hyperparameter"].str.replace("_", " ")
    words = [f"On random folds ours agrees with the thesis on {len(same)} of {len(keys)}: {listed(same)}."]
    parts += [
        Text(words, heading=f"Table 5.4: {published_table('5.4').caption}"),
        Table(selected, "The best of the grid."),
    ]
    return parts


def _tuning_words(frame: pd.DataFrame, thesis: pd.DataFrame, most: int) -> list[str]:
    lines = []
    for split in SPLITS:
        own = frame[frame["split"] == split]
        top = own["accuracy"].max()
        gap = points(float(top), float(thesis["accuracy"].max()))
        near = int((own["accuracy"] >= top - 0.005).sum())
        lines.append(
            f"Ours, {_folds(split)}: {len(own):,} combinations were tried; the best reaches {top:.3f}, "
            f"{gap}; {near} are within half a percentage point of it."
        )
    return lines


def _left_out(found: pd.DataFrame, grid: pd.DataFrame) -> list[str]:
    """Say where the random search found better than a narrowed grid."""
    lines = []
    for split in SPLITS:
        first, second = (frame.loc[frame["split"] == split, "accuracy"].max() for frame in (found, grid))
        if first > second:
            lines.append(
                f"On {_folds(split)} the random search found a better combination ({first:.3f}). Some of its "
                "values occur only once among the best, so the narrowed grid does not contain it."
            )
    return lines


def _narrowed(grid: pd.DataFrame) -> list[Part]:
    thesis = dict(published_table("5.2").frame.to_numpy().tolist())
    rows = []
    for key, values in ANN_GRID.items():
        label = {"loss": "Loss Function"}.get(key, key.replace("_", " ").capitalize())
        used = [set(grid.loc[grid["split"] == split, key]) for split in SPLITS]
        order = {value: k for k, value in enumerate(values)}
        ours = ["{" + ", ".join(map(str, sorted(own, key=lambda v: order.get(v, -1)))) + "}" for own in used]
        rows.append([key.replace("_", " "), thesis[label], *ours])
    columns = ["hyperparameter", "thesis", *(f"ours, {_folds(split)}" for split in SPLITS)]
    return [
        Table(
            pd.DataFrame(rows, columns=columns),
            "A narrowed grid holds the values that the best of the random search use more than once.",
            heading=f"Table 5.2: {published_table('5.2').caption}",
        )
    ]


def _forest(results: Results) -> list[Part]:
    trees, depth = results["forest_trees"], results["forest_depth"]
    best = {
        split: (
            least_within(trees[trees["split"] == split], "trees"),
            least_within(depth[depth["split"] == split], "depth"),
        )
        for split in SPLITS
    }
    printed = published_table("5.5").frame
    rows = [
        [name, int(printed["Selected Value"][place]), *(best[split][place] for split in SPLITS)]
        for place, name in enumerate(printed["Hyperparameter"])
    ]
    columns = ["hyperparameter", "thesis", *(f"ours, {_folds(split)}" for split in SPLITS)]

    def words(place: int, what: str) -> list[str]:
        return [
            f"Ours: the smallest {what} within half a percentage point of the best is "
            f"{best['random'][place]} on random folds and {best['by_tire'][place]} on folds by tire."
        ]

    return [
        *figure_part(results, "figure_5_1", "5.1", words(0, "number of trees")),
        *figure_part(results, "figure_5_2", "5.2", words(1, "depth")),
        Table(
            pd.DataFrame(rows, columns=columns),
            "Ours by the rule above. All further experiments use the thesis' 30 trees of depth 10.",
            heading=f"Table 5.5: {published_table('5.5').caption}",
        ),
    ]


def _folds(split: str) -> str:
    return "random folds" if split == "random" else "folds by tire"


def _comparison(results: Results) -> list[Part]:
    means = over_trainings(results["scores"]).set_index(["classifier", "smote", "split"])
    printed = published_table("5.6")
    rows, lines = [], []
    known = {(SHORT[r[0]], r[1] == "Yes"): (r[2], r[3]) for r in printed.frame.to_numpy().tolist()}
    pairs = dict.fromkeys((name, smote) for name, smote, _ in means.index)
    for name, smote in pairs:
        thesis = known.get((name, smote), (float("nan"),) * 2)
        row: list[object] = [in_words(name), "yes" if smote else "no", thesis[0]]
        row += [_spread(means, name, smote, split, "accuracy") for split in SPLITS]
        row += [thesis[1], *(_spread(means, name, smote, split, "f1") for split in SPLITS)]
        rows.append(row)
    for (name, smote), thesis in known.items():
        here = float(means.loc[(name, smote, "random"), "accuracy"])
        new = float(means.loc[(name, smote, "by_tire"), "accuracy"])
        with_smote = "with" if smote else "without"
        lines.append(
            f"{in_words(name)} {with_smote} SMOTE: {here:.3f} on the random split, "
            f"{points(here, thesis[0])}; {new:.3f} on tires it has not seen."
        )
    columns = ["classifier", "SMOTE", "accuracy: thesis", "ours, random split", "ours, by tire"]
    columns += ["F1: thesis", "F1, random split", "F1, by tire"]
    best = means["accuracy"].groupby("split").idxmax()
    chosen = {split: best[split] for split in SPLITS}
    return [
        Text(lines, heading=f"Table 5.6: {printed.caption}"),
        Table(
            pd.DataFrame(rows, columns=columns),
            "Mean over the trainings, ± their standard deviation if there are several.",
        ),
        Text(
            [
                "Thesis: random forest, 30 trees of depth 10, with SMOTE.",
                *(
                    f"Ours, {in_words(split)}: {in_words(chosen[split][0])} "
                    f"{'with' if chosen[split][1] else 'without'} SMOTE is the most accurate "
                    f"({means.loc[chosen[split], 'accuracy']:.3f})."
                    for split in SPLITS
                ),
                "The agents below are rewarded by the thesis' choice.",
            ],
            heading=f"Table 5.7: {published_table('5.7').caption}",
        ),
    ]


def _spread(means: pd.DataFrame, name: str, smote: bool, split: str, column: str) -> str:
    row = means.loc[(name, smote, split)]
    spread = row[f"{column}_std"]
    return f"{row[column]:.3f} ± {spread:.3f}" if row["trainings"] > 1 else f"{row[column]:.3f}"


def _per_class(results: Results) -> list[Part]:
    frame = results["per_class"]
    table = per_class_table(frame[(frame["classifier"] == "random_forest") & frame["smote"]])
    lines = []
    for label in ("precision", "recall"):
        worst = {
            who: str(table.loc[table[f"{label}, {who}"].idxmin(), "category"])
            for who in ("thesis", "random", "by tire")
        }
        lines.append(
            f"Lowest {label}: category {worst['thesis']} in the thesis, {worst['random']} on our "
            f"random split, {worst['by tire']} on our split by tire."
        )
    lines.append(
        "The letters of our categories do not stand for the thesis' companies: compare the pattern, not "
        "the rows."
    )
    return [
        *figure_part(results, "figure_5_3", "5.3", ["Ours: mean of the trainings."]),
        Text(lines, heading=f"Table 5.8: {published_table('5.8').caption}"),
        Table(table, "The forest with SMOTE."),
    ]


def _latent(results: Results) -> list[Part]:
    frame = results["latent"]
    lines = []
    for split in SPLITS:
        part = frame[frame["split"] == split]
        level = least_within(part, "features", margin=0.01)
        lines.append(
            f"Ours, {in_words(split)}: within a percentage point of the best from {level} latent "
            f"features on; best {part['accuracy'].max():.3f}."
        )
    return figure_part(results, "figure_5_4", "5.4", lines)


def _bins(results: Results) -> list[Part]:
    frame, printed = results["bins"], published_table("5.9")
    parts: list[Part] = []
    for name, representation in BIN_FIGURES.items():
        part = frame[frame["representation"] == representation]
        lines = []
        for split in SPLITS:
            own = part[part["split"] == split]
            level = least_within(own, "bins", margin=0.01)
            lines.append(
                f"Ours, {in_words(split)}: within a percentage point of the best from {level} bins on; "
                f"best {own['accuracy'].max():.3f}."
            )
        parts += figure_part(results, name, name.removeprefix("figure_").replace("_", "."), lines)
    order = ("coefficients", "key_attributes", "latent", "power_series")
    ten = frame[frame["bins"] == 10].set_index(["representation", "split"])
    rows = []
    for representation, thesis in zip(order, printed.frame.to_numpy().tolist(), strict=True):
        ours = [ten.loc[(representation, split)] for split in SPLITS]
        cells = [plus_minus(one["accuracy"], one["accuracy_std"]) for one in ours]
        cells += [f"{one['f1']:.3f}" for one in ours]
        rows.append(
            [in_words(representation), thesis[1], cells[0], cells[1], thesis[2], *cells[2:], thesis[4]]
        )
    columns = ["representation", "accuracy: thesis", "ours, random split", "ours, by tire", "F1: thesis"]
    columns += ["F1, random split", "F1, by tire", "features"]
    accuracies = {name: float(ten.loc[(name, "random"), "accuracy"]) for name in order}
    line = f"Most accurate representation: {in_words(order[0])} in the thesis, "
    line += f"{in_words(max(accuracies, key=lambda name: accuracies[name]))} on our random split."
    lines = [line]
    for name, thesis in zip(order, printed.frame["ACC"], strict=True):
        new = float(ten.loc[(name, "by_tire"), "accuracy"])
        lines.append(
            f"{in_words(name)}: {accuracies[name]:.3f} on the random split, "
            f"{points(accuracies[name], float(thesis))}; {new:.3f} on tires it has not seen."
        )
    parts.append(Text(lines, heading=f"Table 5.9: {printed.caption}"))
    parts.append(
        Table(
            pd.DataFrame(rows, columns=columns),
            "The forest with SMOTE, 10 bins a feature; ± standard deviation if there are several trainings.",
        )
    )
    return parts


def _calibration(results: Results) -> list[Part]:
    errors = over_trainings(results["calibration"], ["ece"])
    table = errors.assign(
        classifier=errors["classifier"].map(in_words),
        split=errors["split"].map(in_words),
        error=[
            plus_minus(a, b) if trainings > 1 else f"{a:.3f}"
            for a, b, trainings in zip(errors["ece"], errors["ece_std"], errors["trainings"], strict=True)
        ],
    )[["classifier", "split", "smote", "error", "trainings"]]
    table = table.rename(columns={"error": "expected calibration error", "smote": "SMOTE"})
    best = errors.loc[errors.groupby("split")["ece"].idxmin()].set_index("split")
    forest = errors[(errors["classifier"] == "random_forest") & errors["smote"]].set_index("split")
    lines = [
        "Not in the thesis. The agent's reward is a probability, so it matters whether classifiers are right "
        "as often as their probabilities say."
    ]
    lines += [
        f"{in_words(split).capitalize()}: the agent's forest is off by {forest.loc[split, 'ece']:.3f} on "
        f"average; the best is {in_words(best.loc[split, 'classifier'])} "
        f"({'with' if best.loc[split, 'smote'] else 'without'} SMOTE) with {best.loc[split, 'ece']:.3f}."
        for split in SPLITS
    ]
    drawn = drawing(results, "reliability")
    parts: list[Part] = [Text(lines, heading="Reliability of the probabilities"), Table(table)]
    if drawn is not None:
        said = "Trained with SMOTE, all trainings. On the dotted line, a probability holds."
        parts.append(Figure(drawn, said))
    return parts


def _condition(results: Results) -> list[Part]:
    frame = results["condition"]
    gain = frame.groupby("form")["gain_median"].median()
    line = (
        "Thesis, 6.3.4: small changes of the features alter the curve radically. Measured on our tires: a "
        "change of the features by their own spread changes B, C and E by "
        f"{in_digits(gain['published'])} times theirs in the published form and by "
        f"{in_digits(gain['stable'])} times in the stable one (median)."
    )
    return [
        Text([line], heading="Why the power series is unstable"),
        Table(
            frame.rename(columns=CONDITION_COLUMNS),
            "Singular values of the Jacobian, in units of spreads, over all tires. Condition: the largest "
            "over the smallest.",
        ),
    ]
