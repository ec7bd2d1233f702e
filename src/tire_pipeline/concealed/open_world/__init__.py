"""Mechanisms that are in no catalogue: twelve to tune a search on, twelve sealed."""
