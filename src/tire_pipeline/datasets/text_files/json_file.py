"""JSON whose preview in kedro-viz shows every character of the users' names in it."""

from __future__ import annotations

import json

from kedro_datasets._typing import JSONPreview
from kedro_datasets.json import JSONDataset

from tire_pipeline.pages.visible_text import visible_texts


class JsonFileDataset(JSONDataset):
    """``json.JSONDataset`` with a preview for a person."""

    def preview(self) -> JSONPreview:
        """Return all of it, its keys and texts by :func:`visible`."""
        return JSONPreview(json.dumps(visible_texts(json.loads(super().preview()))))
