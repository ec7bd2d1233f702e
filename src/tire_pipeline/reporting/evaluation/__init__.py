"""Translators, classifiers and agents that were judged: figures, sentences, the page."""
