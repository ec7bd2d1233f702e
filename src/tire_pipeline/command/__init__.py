"""The command ``tire``: what an engineer asks of one file and one recording, without a project."""
