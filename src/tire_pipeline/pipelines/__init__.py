"""Kedro pipelines: they wire the domain, nothing else."""
