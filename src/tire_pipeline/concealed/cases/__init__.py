"""Sealed cases from the first simulator: which effects, how large, where they act, and the answer."""
