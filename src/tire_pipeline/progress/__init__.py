"""Progress of everything that lasts over two seconds."""

from tire_pipeline.progress.track import silent, track, under_way

__all__ = ["silent", "track", "under_way"]
