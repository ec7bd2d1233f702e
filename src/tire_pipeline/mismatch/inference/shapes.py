"""What the form of an accepted effect may get wrong before a second effect is believed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.form_error import shape_columns
from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.inference.search_state import Search
from tire_pipeline.mismatch.model.forces import Change


def with_shapes(search: Search, system: System, changes: Sequence[Change], skip: int | None = None) -> System:
    """Extend a system by the shape columns of the effects, as they are without number ``skip``."""
    kept = [change for i, change in enumerate(changes) if i != skip]
    parts = [shape_columns(search.data, kept, i) for i in range(len(kept))]
    if not parts:
        return system
    columns = {o: np.hstack([p[o] for p in parts]) for o in search.data.outputs}
    scale = {o: np.full(c.shape[1], settings.SHAPE_SHARE) for o, c in columns.items()}
    return system.extended(columns, scale)
