"""What is imported to read a file or evaluate a formula loads no machinery of learning or drawing."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

HEAVY = (
    "torch",
    "stable_baselines3",
    "gymnasium",
    "kedro",
    "matplotlib",
    "plotly",
    "sklearn",
    "imblearn",
    "pysindy",
)
LIGHT = ("magic_formula", "tir", "recordings", "mismatch", "tire_table")


def _loaded(code: str) -> list[str]:
    """Which of ``HEAVY`` a fresh Python has loaded after ``code``."""
    asked = (
        f"{code}\nimport json, sys\nprint(json.dumps([name for name in {HEAVY!r} if name in sys.modules]))"
    )
    done = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


@pytest.mark.parametrize("folder", LIGHT)
def test_importing_a_folder_loads_nothing_heavy(folder):
    assert _loaded(f"import tire_pipeline.{folder}") == []


def test_the_public_names_of_a_folder_load_nothing_heavy():
    code = "import tire_pipeline.{0} as folder\n[getattr(folder, name) for name in folder.__all__]"
    assert _loaded("\n".join(code.format(folder) for folder in ("magic_formula", "tir", "recordings"))) == []


def test_a_mixed_model_needs_neither_torch_nor_kedro():
    assert not {"torch", "stable_baselines3", "gymnasium", "kedro"} & set(
        _loaded("from tire_pipeline.translation.translator import MixedModel")
    )
