"""Translators without a model of the bias: what the others are measured against."""
