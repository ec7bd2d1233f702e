"""``make sbom``: the list of components is CycloneDX, and holds every pinned version."""

from __future__ import annotations

import json
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[2]


def test_the_list_of_components_fits_the_schema_and_names_every_pinned_version(tmp_path):
    steps = subprocess.run(
        ["make", "-n", "sbom", f"DIST={tmp_path}"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    (command,) = [shlex.split(line) for line in steps.splitlines() if "cyclonedx_py" in line]
    done = subprocess.run(
        [sys.executable, *command[1:]], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "--validate" in command  # by cyclonedx-python-lib, against the schema
    listed = json.loads((tmp_path / "tire-pipeline.cdx.json").read_text(encoding="utf-8"))
    assert (listed["bomFormat"], listed["specVersion"]) == ("CycloneDX", "1.6")
    assert listed["metadata"]["component"]["name"] == "tire-pipeline"
    found = {f"{each['name']}=={each['version']}" for each in listed["components"]}
    assert found == set((ROOT / "requirements.lock").read_text(encoding="utf-8").split())
    assert all(each["purl"].startswith("pkg:pypi/") for each in listed["components"])
