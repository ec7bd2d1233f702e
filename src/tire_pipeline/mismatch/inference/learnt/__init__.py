"""The learnt sizes and odds of the posterior, and their provenance."""
