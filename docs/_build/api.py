"""Pages of the API: what each package exports, from docstrings."""

from __future__ import annotations

import ast
from pathlib import Path

PACKAGES = (
    "tir",
    "magic_formula",
    "recordings",
    "mismatch",
    "translation",
    "classifiers",
    "representations",
    "tire_table",
    "fleet",
    "concealed",
    "evaluation",
)


def pages(package: Path) -> dict[str, str]:
    """Return one page a package, and the page that lists them."""
    made = {f"reference/api/{name}.md": _page(package / name) for name in PACKAGES}
    rows = "\n".join(
        f"| [`tire_pipeline.{name}`]({name}.md) | {_sentence(package / name)} |" for name in PACKAGES
    )
    made["reference/api/index.md"] = (
        "# API\n\nEach page is made from the docstrings of what the package exports. Units are SI and radians.\n\n"
        f"| package | what it is for |\n|---|---|\n{rows}\n"
    )
    return made


def navigation(package: Path) -> list[dict[str, str]]:
    """Return the entries of the navigation."""
    return [{name: f"reference/api/{name}.md"} for name in PACKAGES]


def _page(folder: Path) -> str:
    parts = [f"# `tire_pipeline.{folder.name}`", _sentence(folder)]
    parts += [f"::: tire_pipeline.{folder.name}.{name}" for name in exported(folder / "__init__.py")]
    return "\n\n".join(parts) + "\n"


def exported(path: Path) -> list[str]:
    """Return the names in ``__all__`` that have a docstring of their own: functions and classes."""
    tree = ast.parse(path.read_text("utf-8"))
    for node in tree.body:
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__":
            names = [str(name) for name in ast.literal_eval(node.value)]
            return sorted((n for n in names if not n.isupper() and "_" != n[0]), key=str.lower)
    return []


def _sentence(folder: Path) -> str:
    return (ast.get_docstring(ast.parse((folder / "__init__.py").read_text("utf-8"))) or "").split("\n\n")[0]
