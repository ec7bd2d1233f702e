"""Trained models, and which of them is released."""
