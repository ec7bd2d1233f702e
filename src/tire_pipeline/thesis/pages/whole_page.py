"""The thesis and our results on one page."""

from __future__ import annotations

import pandas as pd

from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.reporting import HOME, Part, Table, Text, render_page
from tire_pipeline.thesis.pages.page_agents import agent_parts
from tire_pipeline.thesis.pages.page_classifiers import classifier_parts
from tire_pipeline.thesis.pages.questions import answers
from tire_pipeline.thesis.pages.words import listed
from tire_pipeline.thesis.result_tables import BETTER, Results, over_seeds, over_trainings

THESIS_FILES = 2061
_ABOUT_SET = {"four": ", four tires as in the thesis", "hidden": ", tires on which no method was chosen"}
PAGES = (*HOME, ("report.html", "How well the translation works"))


def thesis_page(results: Results) -> str:
    """Render the page.

    Parameters
    ----------
    results : Results

    Returns
    -------
    str
        HTML that opens without a network.
    """
    parts: list[Part] = [Text(_main(results), emphasis=True), *_comparable(results), *answers(results)]
    parts += classifier_parts(results)
    parts += agent_parts(results)
    title = "The thesis, table by table, beside our results"
    return render_page(title, parts, pages=PAGES, footer=_footer(results))


def _main(results: Results) -> list[str]:
    means = over_trainings(results["scores"])
    forest = means[(means["classifier"] == "random_forest") & means["smote"]].set_index("split")["accuracy"]
    ours = over_seeds(results["agents"])
    ours = ours[(ours["metric"] == "mean") & (ours["quantity"] == "ratio") & (ours["decoding"] == "tire")]
    lines = [
        "The thesis' forest predicts which organisation measured a tire for 97.0% of its test files. Ours "
        f"does so for {forest['random']:.1%} on a random split as in the thesis, and for "
        f"{forest['by_tire']:.1%} on tires "
        "that it has not seen.",
    ]
    for name in dict.fromkeys(ours["set"]):
        part = ours[ours["set"] == name]
        below = int((part["value"] < BETTER).sum())
        lines.append(
            f"Set {name}: {below} of {len(part)} configurations of the thesis' agents bring tires nearer to "
            f"{results.facts['target']}'s measurement than doing nothing, averaged over the three metrics. "
            f"The median error ratio is {in_digits(float(part['value'].median()))} (1: nothing gained). In "
            "the thesis it is none of 48."
        )
    tires = results["agent_tires"]
    lines.append(
        "Training moves the classifier's mean probability of the target from "
        f"{tires['before'].mean():.2f} to {tires['after'].mean():.2f}. A file that convinces the "
        "classifier is not a file with the right forces."
    )
    return lines


def _comparable(results: Results) -> list[Part]:
    facts = results.facts
    rows = [
        ("Tables 5.1 to 5.9", "value beside value", "the same experiment on other files"),
        ("Figures 4.1, 4.2", "pattern only", "counts of proprietary files; ours were made to resemble them"),
        (
            "Figures 5.1, 5.2, 5.4 to 5.9",
            "words only",
            "drawn in the thesis, not printed",
        ),
        ("Figure 5.3", "pattern only", "drawn, and its categories are proprietary"),
        ("Tables 5.10 to 5.21, 6.1", "value beside value", "relative to doing nothing; other tires"),
        ("Figures 5.10 to 5.15", "kind of change only", "curves of proprietary tires"),
        ("Figure 5.16", "words only", "drawn in the thesis, not printed"),
    ]
    table = pd.DataFrame(rows, columns=["in the thesis", "compared as", "why"])
    words = [
        f"The thesis' {THESIS_FILES:,} files are proprietary. Ours are {facts['files']:,} files of a "
        "demonstration fleet or of the user's folder. So values may differ; the patterns can be compared.",
        f"{results.cells_run} cells of the agents' grid were run with {len(facts['seeds'])} seed"
        f"{'s' if len(facts['seeds']) != 1 else ''} each; classifiers were trained "
        f"{'once' if facts['trainings'] == 1 else str(facts['trainings']) + ' times'}. "
        "All classifiers are judged on the random split and on the split by physical tire. The agents are "
        f"always judged on tires that are in no training file: {_sets(results)}.",
    ]
    return [Text(words, heading="What can be compared"), Table(table)]


def _sets(results: Results) -> str:
    """Say how many translations each set of evaluation tires has."""
    files = results["agents"].groupby("set", sort=False)["files"].max()
    return listed(
        f"the set {name} ({count:,} translations{_ABOUT_SET.get(str(name), '')})"
        for name, count in files.items()
    )


def _footer(results: Results) -> str:
    seconds = results["seconds"]["seconds"]
    minutes, each = in_digits(float(seconds.sum() / 60)), in_digits(float(seconds.mean()))
    return (
        f"{len(seconds)} agents were trained in {minutes} minutes, added up over "
        f"all processes ({each} s each). The folder thesis beside this page holds "
        "every table as CSV and every figure as SVG."
    )
