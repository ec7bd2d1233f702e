"""Scripts outside of the package import names that the package has: no other check runs all of them."""

from __future__ import annotations

import ast
import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
_FOLDERS = ("examples", "benchmarks", "docs", "tools", "notebooks")
SCRIPTS = sorted(path for folder in _FOLDERS for path in (ROOT / folder).rglob("*.py"))


def imported(text: str) -> list[tuple[str, str]]:
    """Module and name of each import of the package; the name is empty for the module itself."""
    found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "tire_pipeline":
            found += [(str(node.module), alias.name) for alias in node.names]
        elif isinstance(node, ast.Import):
            found += [(alias.name, "") for alias in node.names if alias.name.split(".")[0] == "tire_pipeline"]
    return found


def missing(text: str) -> list[str]:
    """Imports that the package can't serve."""
    lost = []
    for module, name in imported(text):
        try:
            home = importlib.import_module(module)
            if name and not hasattr(home, name):
                importlib.import_module(f"{module}.{name}")
        except ImportError:
            lost.append(f"{module} {name}".strip())
    return lost


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_the_imports_of_a_script_exist(path: Path) -> None:
    assert missing(path.read_text()) == []


def test_a_name_that_is_gone_is_found() -> None:
    text = "from tire_pipeline.tir import write_tir, no_such_name\nimport tire_pipeline.no_such_module\n"
    assert missing(text) == ["tire_pipeline.tir no_such_name", "tire_pipeline.no_such_module"]
