"""Dagster: a run when files arrive, one every night, and partitions (extra ``schedule``)."""
