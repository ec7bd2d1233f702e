"""``python -m tire_pipeline.command`` is the command ``tire``."""

from tire_pipeline.command.cli import main

main()
