"""Read, translate and explain tire models: a Kedro project."""

__version__ = "0.2.0"
