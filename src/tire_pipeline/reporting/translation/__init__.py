"""Pages about translated files."""
