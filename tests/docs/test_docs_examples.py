"""Every example in a docstring runs and prints what it says; the public names have one."""

from __future__ import annotations

import doctest
import importlib
import shutil
from pathlib import Path

import pytest

import tire_pipeline

pytestmark = pytest.mark.slow
ROOT = Path(tire_pipeline.__file__).parent
REPOSITORY = ROOT.parents[1]


def _modules() -> list[str]:
    paths = [path for path in ROOT.rglob("*.py") if "\n    >>> " in path.read_text(encoding="utf-8")]
    names = [".".join(("tire_pipeline", *path.relative_to(ROOT).with_suffix("").parts)) for path in paths]
    return sorted(name.removesuffix(".__init__") for name in names)


@pytest.fixture
def beside_the_examples(tmp_path, monkeypatch):
    """A working folder with the files that examples read."""
    for path in (REPOSITORY / "examples").iterdir():
        if path.is_file():
            shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("name", _modules())
def test_examples_run(name, beside_the_examples):
    module = importlib.import_module(name)
    found = doctest.testmod(module, optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    assert found.attempted
    assert not found.failed
