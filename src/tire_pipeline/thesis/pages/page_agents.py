"""The page's part on agents: Figures 5.9 to 5.16, Tables 5.10 to 5.21 and 6.1."""

from __future__ import annotations

import pandas as pd

from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.reporting import Figure, Part, Table, Text
from tire_pipeline.thesis.pages.agent_figures import FORCE_FIGURES, shown
from tire_pipeline.thesis.pages.figures import drawing
from tire_pipeline.thesis.pages.words import agreement, listed, plus_minus, rank_agreement
from tire_pipeline.thesis.published import AGENT_TABLES, published_figure, published_table
from tire_pipeline.thesis.result_tables import BETTER, CELL, Results, in_words, over_seeds
from tire_pipeline.translation.thesis.tables import METRICS, better_than_nothing

_SHORT_METRICS = {
    "forces": "forces",
    "cornering_stiffness": "slope",
    "peak_friction": "friction",
    "mean": "average",
}


def agent_parts(results: Results) -> list[Part]:
    """Everything about agents, in the thesis' order."""
    parts = _learning(results)
    for table in AGENT_TABLES:
        parts += _table(results, table)
    parts += _stable_form(results)
    for name, representation in FORCE_FIGURES.items():
        parts += _forces(results, name, representation)
    parts += _over_load(results)
    parts += _actions(results)
    parts += _table_6_1(results)
    parts += _every_cell(results)
    return parts


def _figure(results: Results, name: str, words: list[str], caption: str) -> list[Part]:
    number_of = name.removeprefix("figure_").replace("_", ".")
    published = published_figure(number_of)
    drawn = drawing(results, name)
    missing = [] if drawn is not None else ["Ours: this cell was not run."]
    lines = [f"Thesis: {published.says}", *words, *missing]
    parts: list[Part] = [Text(lines, heading=f"Figure {number_of}: {published.caption}")]
    if drawn is not None:
        parts.append(Figure(drawn, caption))
    return parts


def rising(results: Results) -> pd.DataFrame:
    """Reward of an episode in the first and the last tenth of training, each cell (mean of the seeds)."""
    frame = results["learning"]
    place = frame.groupby([*CELL, "seed"])["step"].rank(pct=True)
    early = frame[place <= 0.1].groupby(CELL)["episode_reward"].mean().rename("early")
    late = frame[place > 0.9].groupby(CELL)["episode_reward"].mean().rename("late")
    return pd.concat([early, late], axis=1).dropna().reset_index()


def _learning(results: Results) -> list[Part]:
    ends = rising(results)
    up = int((ends["late"] > ends["early"]).sum())
    lines = [
        f"Ours: {up} of {len(ends)} cells of the whole grid earn more in the last tenth of training than in "
        "the first."
    ]
    pairs = ends.pivot(index=CELL[1:], columns="algorithm", values="late")
    if {"PPO", "A2C"} <= set(pairs.columns):
        pairs = pairs.dropna()
        lines.append(f"PPO ends with a higher reward than A2C in {int((pairs['PPO'] > pairs['A2C']).sum())} "
                     f"of {len(pairs)} pairs of cells.")  # fmt: skip
    return _figure(
        results,
        "figure_5_9",
        lines,
        "Ours: mean over the seeds; bands: one standard deviation. A rising line earns more with training.",
    )


def _table(results: Results, table: str) -> list[Part]:
    """One of Tables 5.10 to 5.21: the thesis' value, and ours."""
    rows = results.beside[results.beside["table"] == table]
    printed = published_table(table)
    heading = f"Table {table}: {printed.caption}"
    ran = rows.dropna(subset=["curves"])
    if ran.empty:
        return [
            Text(["Ours: none of these cells was run. The thesis' values:"], heading=heading),
            Table(printed.frame),
        ]
    return [
        Text(_table_words(ran), heading=heading),
        Table(
            _one_below_the_other(
                rows, "values", {"thesis": ("thesis", None), "ours": ("curves", "curves_std")}
            ),
            "Ours: curves decoded as in the thesis, the same 16 translations; mean ± standard deviation over "
            "the seeds. Models with one row were not run.",
        ),
        Table(
            _one_below_the_other(
                rows, "files", {"translations": ("tire", "tire_std"), "hidden": ("hidden", "hidden_std")}
            ),
            "The same agents decoded to a .tir file: the 16 translations, and the set 'hidden'.",
        ),
    ]


def _one_below_the_other(
    rows: pd.DataFrame, of: str, lines: dict[str, tuple[str, str | None]]
) -> pd.DataFrame:
    """For each model a row for each of ``lines`` that has values, by its words in the column ``of``."""
    out = []
    for (representation, algorithm), part in rows.groupby(["representation", "algorithm"], sort=False):
        values = part.set_index("metric")
        for words, (value, spread) in lines.items():
            if values[value].isna().all():
                continue
            line: dict[str, object] = {"model": f"{in_words(representation)}, {algorithm}", of: words}
            for metric in METRICS:
                one = values.loc[metric]
                line[_SHORT_METRICS[metric]] = plus_minus(one[value], 0.0 if spread is None else one[spread])
            out.append(line)
    return pd.DataFrame(out)


def _table_words(ran: pd.DataFrame) -> list[str]:
    average = ran[ran["metric"] == "mean"]
    order = agreement(rank_agreement(average["thesis"].to_list(), average["curves"].to_list()))
    ratio = average["quantity"].iloc[0] == "ratio"
    best = average.loc[average["curves"].idxmin() if ratio else average["curves"].idxmax()]
    theirs = average.loc[average["thesis"].idxmin() if ratio else average["thesis"].idxmax()]

    def name(row: pd.Series) -> str:
        return f"{in_words(row['representation'])}, {row['algorithm']}"

    lines = [
        f"By the average, {order}.",
        f"Best: {name(theirs)} ({in_digits(theirs['thesis'])}) in the thesis, {name(best)} "
        f"({in_digits(best['curves'])}) here.",
    ]
    single = ran[ran["metric"] != "mean"]
    if ratio:
        below = {who: int((single[who] < BETTER).sum()) for who in ("thesis", "curves", "tire")}
        lines.append(
            f"Values below 1, better than doing nothing: {below['thesis']} of {len(single)} in the thesis, "
            f"{below['curves']} here as the thesis decodes, {below['tire']} as .tir."
        )
    else:
        more = {who: int((single[who] > 0.5).sum()) for who in ("thesis", "curves", "tire")}
        lines.append(
            f"More than half of the curves improved: {more['thesis']} of {len(single)} values in the thesis, "
            f"{more['curves']} here as the thesis decodes, {more['tire']} as .tir."
        )
    return lines


def _stable_form(results: Results) -> list[Part]:
    ours = over_seeds(results["agents"])
    ours = ours[(ours["metric"] == "mean") & (ours["quantity"] == "ratio")]
    ours = ours[(ours["set"] == results.facts["sets"][0]) & (ours["decoding"] == "curves")]
    keys = ["algorithm", "reward", "n_bins"]
    both = {
        name: ours[ours["representation"] == name].set_index(keys)["value"]
        for name in ("power_series", "power_series_stable")
    }
    table = pd.DataFrame(both).dropna().reset_index()
    if table.empty:
        return []
    table["reward"] = table["reward"].map(in_words)
    better = int((table["power_series_stable"] < table["power_series"]).sum())
    line = (
        "Not in the thesis: the same features scaled so that they can be inverted, decoded to the root "
        f"nearest to the source. The average ratio is smaller in {better} of {len(table)} cells; median "
        f"{in_digits(table['power_series_stable'].median())} instead of "
        f"{in_digits(table['power_series'].median())}."
    )
    table = table.rename(columns={"power_series": "as published", "power_series_stable": "stable form"})
    return [Text([line], heading="Power series that can be inverted"), Table(table)]


def _forces(results: Results, name: str, representation: str) -> list[Part]:
    lines = []
    if "force_curves" in results.frames:
        frame = shown(results["force_curves"], representation)
        if not frame.empty:
            keys = ["tire", "category", "normal_load", "slip_angle"]
            wide = frame.pivot(index=keys, columns="kind", values="fy")
            squares = {
                kind: ((wide[kind] - wide["target"]) ** 2).groupby(["tire", "category"]).mean()
                for kind in ("source", "translated", "decoded")
            }
            better = {
                kind: int((squares[kind] < squares["source"] * (1 - 1e-9)).sum())
                for kind in ("translated", "decoded")
            }
            lines.append(
                f"Ours: of {len(squares['source'])} curves {better['decoded']} come nearer to the target as "
                f"the thesis decodes them, {better['translated']} as .tir."
            )
    lines.append("The thesis' tires are proprietary: only the kind of change can be compared.")
    return _figure(
        results, name, lines, "Ours, at 6 kN. Rows: the four tires; columns: suppliers; first seed."
    )


def _over_load(results: Results) -> list[Part]:
    parts: list[Part] = []
    for name, column in (("figure_5_14", "cornering_stiffness"), ("figure_5_15", "peak_friction")):
        lines = []
        if "load_curves" in results.frames and not shown(results["load_curves"], "latent").empty:
            frame = shown(results["load_curves"], "latent")
            wide = frame.pivot(index=["tire", "category", "normal_load"], columns="kind", values=column)
            gap = {
                kind: ((wide[kind] - wide["target"]) ** 2).groupby(["tire", "category"]).mean()
                for kind in ("source", "translated")
            }
            better = int((gap["translated"] < gap["source"]).sum())
            lines.append(f"Ours: {better} of {len(gap['source'])} curves come nearer to the target.")
        lines.append("The thesis' tires are proprietary: its curves cannot be drawn over ours.")
        parts += _figure(results, name, lines, "Ours. Solid: as measured; dashed: translated.")
    return parts


def _actions(results: Results) -> list[Part]:
    lines = []
    for name in ("latent", "power_series"):
        frame = shown(results["actions"], name)
        if frame.empty:
            continue
        counts = frame.groupby("action")["count"].sum().sort_values(ascending=False)
        shares = counts / max(counts.sum(), 1)
        many = int((shares.cumsum() < 0.9).sum() + 1)
        lines.append(
            f"Ours, {in_words(name)}: {int((counts > 0).sum())} of {len(counts)} actions are used, {many} of "
            f"them make up 90%; the most frequent is {counts.index[0]}."
        )
    return _figure(results, "figure_5_16", lines, "Ours, all evaluation tires, first seed.")


def _table_6_1(results: Results) -> list[Part]:
    printed = published_table("6.1")
    agents = results["agents"]
    parts: list[Part] = [
        Table(printed.frame, "Thesis.", heading=f"Table 6.1: {printed.caption}"),
    ]
    for name in dict.fromkeys(agents["set"]):
        for decoding, words in (("curves", "curves as the thesis decodes them"), ("tire", "as .tir")):
            table = better_than_nothing(agents[agents["set"] == name], decoding=decoding)
            table = table[table["ratio"] < BETTER].reset_index(drop=True)
            tried = 3 * results.cells_run
            for column in ("representation", "reward", "metric"):
                table[column] = table[column].map(in_words)
            caption = (
                f"Ours, set {name}, {words}: {len(table)} of {tried} pairs of configuration and metric have "
                "a mean ratio below 1. Seeds below 1: share of the seeds for which that holds."
            )
            table = table.rename(columns={"n_bins": "bins", "seeds_below_1": "seeds below 1"})
            parts.append(Table(table, caption, most_rows=30))
    return parts


def _every_cell(results: Results) -> list[Part]:
    ours = over_seeds(results["agents"])
    ours = ours[ours["decoding"] == "tire"]
    floor = results["floor"]
    parts: list[Part] = []
    for name in dict.fromkeys(ours["set"]):
        part = ours[ours["set"] == name].copy()
        part["text"] = [plus_minus(a, b) for a, b in zip(part["value"], part["std"], strict=True)]
        tables = {}
        for quantity in ("ratio", "improved"):
            wide = part[part["quantity"] == quantity].pivot(index=CELL, columns="metric", values="text")
            wide = wide[list(METRICS)].rename(columns=_SHORT_METRICS).reset_index()
            for column in ("representation", "reward"):
                wide[column] = wide[column].map(in_words)
            tables[quantity] = wide.rename(columns={"n_bins": "bins"})
        own = floor[floor["set"] == name].set_index("metric")["ratio"]
        reach = listed(f"{in_words(m)} {in_digits(own[m], 2)}" for m in METRICS[:3] if m in own)
        files = int(results["agents"].loc[results["agents"]["set"] == name, "files"].max())
        caption = (
            f"{files} translations, decoded to .tir: error over that of doing nothing (1), mean ± standard "
            f"deviation over the seeds. The target measuring again reaches {reach}."
        )
        heading = f"Every configuration, set {name}"
        parts.append(Table(tables["ratio"], caption, heading=heading, most_rows=100))
        parts.append(Table(tables["improved"], "The same: share of improved curves.", most_rows=100))
    return parts
