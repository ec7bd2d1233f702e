"""Every pipeline with its inputs, outputs and parameters, from Kedro's registry."""

from __future__ import annotations

import importlib
import inspect
import logging
import re
from pathlib import Path
from typing import Any

import yaml

FIRST = (
    "make_fleet ingest_tir dedupe_filter normalize represent bin train_classifier train_agent evaluate "
    "translate compare_translators explain_mismatch prove_concealed reproduce_thesis retrain rollback"
).split()


def page(root: Path) -> str:
    """Return the page."""
    from kedro.framework.project import pipelines
    from kedro.framework.startup import bootstrap_project

    bootstrap_project(root)
    logging.getLogger("kedro").setLevel(logging.ERROR)
    known = _descriptions(root / "conf" / "base" / "catalog")
    known_parameters = parameters(root / "conf" / "base")
    names = [name for name in FIRST if name in pipelines]
    names += sorted(set(pipelines) - set(names) - {"__default__", "story"})
    lines = [
        "# Pipelines",
        "",
        "Run one with `kedro run --pipeline NAME`. Without a name the eight from `ingest_tir` to `evaluate` run.",
        "Change a parameter with `--params name=value`, or in `conf/base/parameters`. The page is made from the",
        "project's own registry and catalog.",
        "",
    ]
    for name in names:
        lines += _one(name, pipelines[name], known, known_parameters)
    return "\n".join(lines) + "\n"


def _one(
    name: str, pipeline: Any, known: dict[str, str], parameters: dict[str, list[tuple[str, str, str]]]
) -> list[str]:
    module = importlib.import_module(f"tire_pipeline.pipelines.{name}.pipeline")
    text = (inspect.getdoc(module.create_pipeline) or "").split("\n\n")[0]
    asked = sorted(pipeline.inputs())
    used = sorted(entry.split(":", 1)[1].split(".")[0] for entry in asked if entry.startswith("params:"))
    lines = [f"## {name}", "", " ".join(text.split()), ""]
    for title, entries in (
        ("Inputs", [entry for entry in asked if not entry.startswith(("params:", "parameters"))]),
        ("Outputs", sorted(pipeline.outputs())),
    ):
        if not entries:
            continue
        lines += [f"**{title}**", "", "| dataset | what it is |", "|---|---|"]
        shown = list(dict.fromkeys(re.sub(r"^agents\..*\.", "agents.*.", entry) for entry in entries))
        lines += [f"| `{entry}` | {known.get(entry, '')} |" for entry in shown]
        lines.append("")
    rows = [row for key in dict.fromkeys(used) for row in parameters.get(key, [])]
    if rows:
        lines += ["**Parameters**", "", "| parameter | default | meaning |", "|---|---|---|"]
        lines += [f"| `{key}` | `{value}` | {comment} |" for key, value, comment in rows]
        lines.append("")
    steps = [f"`{node.name}`" for node in pipeline.nodes]
    lines += [f"Nodes: {', '.join(steps)}." if len(steps) <= 12 else f"{len(steps)} nodes.", ""]
    return lines


def _descriptions(folder: Path) -> dict[str, str]:
    found = {}
    for path in sorted(folder.rglob("*.yml")):
        for name, entry in (yaml.safe_load(path.read_text("utf-8")) or {}).items():
            if isinstance(entry, dict):
                found[name] = str((entry.get("metadata") or {}).get("description", "")).replace("|", "\\|")
    return found


def parameters(folder: Path) -> dict[str, list[tuple[str, str, str]]]:
    """Return top-level parameter -> (name, default, comment) of each of its entries."""
    found: dict[str, list[tuple[str, str, str]]] = {}
    for path in [folder / "parameters.yml", *sorted((folder / "parameters").rglob("*.yml"))]:
        text = path.read_text("utf-8")
        comments = _comments(text)
        for key, value in (yaml.safe_load(text) or {}).items():
            found[key] = list(_flat(key, value, comments))
    return found


def _flat(key: str, value: Any, comments: dict[str, str], above: str = "") -> Any:
    """Yield name, default and comment of each entry; one without a comment has that of the entry above it."""
    comment = comments.get(key) or above
    if isinstance(value, dict) and value:
        for name, inner in value.items():
            yield from _flat(f"{key}.{name}", inner, comments, comment)
    else:
        yield key, str(value).replace("|", "\\|") or '""', comment.replace("*", "\\*")


def _comments(text: str) -> dict[str, str]:
    """Full name of a parameter -> the comment behind it, and on the lines that go on with it."""
    found: dict[str, str] = {}
    path: list[tuple[int, str]] = []
    last = ""
    for line in text.splitlines():
        match = re.match(r"^(\s*)([\w-]+):(.*)$", line)
        comment = line.split("#", 1)[1].strip().replace("|", "\\|") if "#" in line else ""
        if match and not line.strip().startswith("#"):
            indent = len(match.group(1))
            path = [entry for entry in path if entry[0] < indent] + [(indent, match.group(2))]
            last = ".".join(name for _, name in path)
            found[last] = comment
        elif comment and last and line[:1].isspace():
            found[last] = f"{found[last]} {comment}".strip()
    return found
