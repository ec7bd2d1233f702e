"""What README and tutorials show runs, on the files of examples/ and nothing else."""

from __future__ import annotations

import re
import shlex
from dataclasses import replace
from functools import cache
from pathlib import Path

import pandas as pd
import pytest
from click.testing import CliRunner

from tire_pipeline.command.cli import tire
from tire_pipeline.mismatch import Explainer

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[2]
PAGES = [
    ROOT / "README.md",
    ROOT / "docs/explanation/mismatch.md",
    *sorted((ROOT / "docs/how-to").glob("*.md")),
    *sorted((ROOT / "docs/tutorials").glob("*.md")),
]


def blocks(page: Path, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text("utf-8"), re.M | re.S)


def commands(page: Path) -> list[str]:
    """Commands of one file whose inputs are all in examples/."""
    lines = [line.split("#")[0].strip() for block in blocks(page, "") for line in block.splitlines()]
    return [line for line in lines if line.startswith("tire ") and "examples/" in line]


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """A folder with nothing but the examples."""
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_readme_and_tutorials_have_something_to_run():
    assert blocks(ROOT / "README.md", "python")
    assert commands(ROOT / "README.md")


@pytest.fixture(scope="module")
def explained_once():
    """A recording is explained against a tire once; most pages and commands show the same two."""
    explain, known = Explainer.explain, {}

    def remembered(self, tire, recording):
        rows = int(pd.util.hash_pandas_object(recording).sum())
        key = (tuple(sorted(tire.coefficients.items())), tuple(recording.columns), rows)
        key = (*key, repr(self), repr(recording.attrs))
        if key not in known:
            report = explain(self, tire, recording)
            known[key] = replace(report, find_visible=cache(report.find_visible))
        return replace(known[key])

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Explainer, "explain", remembered)
        yield


@pytest.mark.parametrize("page", [p for p in PAGES if blocks(p, "python")], ids=lambda page: page.stem)
def test_python_runs(page, folder, explained_once):
    names: dict[str, object] = {}
    for block in blocks(page, "python"):
        exec(compile(block, str(page), "exec"), names)
    assert {"tire", "report", "run"} & set(names)


@pytest.mark.parametrize("command", list(dict.fromkeys(each for page in PAGES for each in commands(page))))
def test_commands_run(command, folder, explained_once):
    before = {path.name: path.read_bytes() for path in (ROOT / "examples").iterdir() if path.is_file()}
    result = CliRunner().invoke(tire, shlex.split(command)[1:])
    assert result.exit_code == 0, result.output
    if "-o report.html" in command:
        assert "inflation pressure" in (folder / "report.html").read_text("utf-8")
    assert before == {
        path.name: path.read_bytes() for path in (ROOT / "examples").iterdir() if path.is_file()
    }
