"""The command ``tire``: questions about one file or one recording, without a project."""
