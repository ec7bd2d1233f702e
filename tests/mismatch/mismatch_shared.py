"""Data that every checkout can use; absent outside of CI is a reason to skip."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

SHARED = Path(__file__).resolve().parents[3] / "shared"


def shared(name: str) -> Path:
    path = SHARED / name
    if not path.exists() and not os.environ.get("CI"):
        pytest.skip(f"{path} is not there")
    return path
