"""The thesis in full: its published figures, the same experiments on our files, both on one page."""

from tire_pipeline.thesis.published import (
    PUBLISHED_METRICS,
    published_agents,
    published_figure,
    published_table,
)

__all__ = ["PUBLISHED_METRICS", "published_agents", "published_figure", "published_table"]
