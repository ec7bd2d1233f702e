"""Explanations against sealed answers, and what the scores are called on a page."""
