"""The page of the API: what the public packages export, from docstrings."""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path

PACKAGES = ("tir", "magic_formula", "recordings", "mismatch", "translation")

HEAD = """# API

Public is what these packages export. All else may change without notice. Units are SI and radians. The page is
made from the docstrings.
"""


def page(package: Path) -> str:
    """Return the page."""
    parts = [HEAD]
    for name in PACKAGES:
        parts += [f"## tire_pipeline.{name}", _sentence(package / name)]
        parts += [
            f"::: tire_pipeline.{name}.{each}\n    options:\n      heading_level: 3"
            for each in exported(package / name / "__init__.py")
        ]
    return "\n\n".join(parts) + "\n"


def public_names(package: Path) -> dict[str, str]:
    """Return each public name with its full name; those that two packages export are left out."""
    found = [
        (each, f"tire_pipeline.{name}.{each}")
        for name in PACKAGES
        for each in exported(package / name / "__init__.py")
    ]
    once = Counter(name for name, _ in found)
    return {name: full for name, full in found if once[name] == 1}


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
