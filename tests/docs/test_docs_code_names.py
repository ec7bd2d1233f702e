"""Pages name code so that a renaming breaks the build: public names are links, stale ones an error."""

import importlib.util
from pathlib import Path

import pytest

BUILD = Path(__file__).resolve().parents[2] / "docs" / "_build"
NAMES = {"read_tir": "tire_pipeline.tir.read_tir", "TireModel": "tire_pipeline.magic_formula.TireModel"}


@pytest.fixture(scope="module")
def code_names():
    spec = importlib.util.spec_from_file_location("code_names", BUILD / "code_names.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_name_that_the_code_does_not_have_is_stale(code_names):
    text = (
        "`tire_pipeline.tir.read_tir(path)` and `tire_pipeline.tir.read_tyre`, `tire_pipeline.gone.x`, `x.y`"
    )
    assert code_names.stale(text) == ["tire_pipeline.tir.read_tyre", "tire_pipeline.gone.x"]
    assert code_names.stale(text, frozenset({"tire_pipeline.gone.x"})) == ["tire_pipeline.tir.read_tyre"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Call `read_tir`.", "Call [`read_tir`][tire_pipeline.tir.read_tir]."),
        ("`read_tir(path)`, `read_tir`", "[`read_tir(path)`][tire_pipeline.tir.read_tir], `read_tir`"),
        (
            "`tire_pipeline.magic_formula.TireModel`",
            "[`tire_pipeline.magic_formula.TireModel`][tire_pipeline.magic_formula.TireModel]",
        ),
        ("# `read_tir`\n`tire.read_tir`", "# `read_tir`\n`tire.read_tir`"),
        ("```python\n`read_tir`\n```", "```python\n`read_tir`\n```"),
        ("[`read_tir`](page.md) `other`", "[`read_tir`](page.md) `other`"),
    ],
)
def test_the_first_mention_of_a_public_name_is_a_link(code_names, text, expected):
    assert code_names.linked(text, NAMES) == expected
