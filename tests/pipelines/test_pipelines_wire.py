"""Pipelines wire, nothing else: short nodes, and a small folder."""

from __future__ import annotations

import ast
import inspect
from pathlib import Path

import pytest
from kedro.framework.project import configure_project

import tire_pipeline.pipelines
from tire_pipeline.pipeline_registry import register_pipelines

FOLDER = Path(tire_pipeline.pipelines.__file__).parent
MOST_LINES = 1500
MOST_LINES_OF_A_NODE = 20
"""Of code: signature and docstring do not count."""


def code_lines(function: ast.FunctionDef) -> int:
    """Lines of a function's body without its docstring."""
    body = function.body[1:] if ast.get_docstring(function) else function.body
    return len({line for each in body for line in range(each.lineno, (each.end_lineno or each.lineno) + 1)})


def _nodes() -> dict[str, int]:
    configure_project("tire_pipeline")
    functions = {node.func for pipeline in register_pipelines().values() for node in pipeline.nodes}
    found = {}
    for function in functions:
        tree = ast.parse(inspect.cleandoc("\n" + inspect.getsource(function)))
        found[f"{function.__module__}.{function.__qualname__}"] = code_lines(tree.body[0])
    return found


def test_every_node_is_short():
    lengths = _nodes()
    assert len(lengths) > 40
    assert {name: lines for name, lines in lengths.items() if lines > MOST_LINES_OF_A_NODE} == {}


def test_the_folder_of_pipelines_is_small():
    lines = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in FOLDER.rglob("*.py")}
    assert sum(lines.values()) < MOST_LINES


@pytest.mark.parametrize("path", sorted(FOLDER.rglob("*.py")), ids=lambda path: path.parent.name)
def test_what_stands_among_the_pipelines_is_short(path):
    """All but the functions that list a pipeline's nodes."""
    for each in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(each, ast.FunctionDef) and ast.unparse(each.returns or ast.Constant("")) not in (
            "Pipeline",
            "list[Node]",
            "Node",
        ):
            assert code_lines(each) <= MOST_LINES_OF_A_NODE, each.name
