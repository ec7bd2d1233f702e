"""Doing nothing: what every translator has to beat."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import pandas as pd

from tire_pipeline.translation.base import check_target
from tire_pipeline.translation.result import LEFT_ALONE, TranslationResult, without_estimate


class NoChange:
    """Returns every tire unchanged."""

    name: ClassVar[str] = "no_change"

    def fit(self, training: pd.DataFrame, *, target: str, seed: int = 0) -> Self:
        """Check the target; there is nothing to learn."""
        check_target(training, target)
        self.target = target
        return self

    def translate(self, source: pd.DataFrame) -> pd.DataFrame:
        """Return a copy."""
        return source.copy()

    def translation(
        self, source: pd.DataFrame, *, bands: bool = True, farthest: float | None = None
    ) -> TranslationResult:
        """Translate; without bands or estimates of the error."""
        return without_estimate(source, self.translate(source), self.target, self.name, LEFT_ALONE)

    def to_state(self) -> dict[str, Any]:
        """Return the target."""
        return {"translator": self.name, "target": self.target}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        translator = cls()
        translator.target = str(state["target"])
        return translator
