"""Translators that predict the target's scores otherwise than the mixed model as it was fitted."""
