"""Dagster: a run when files arrive, one every night, and jobs that a cluster divides (extra ``schedule``)."""
