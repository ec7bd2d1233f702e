"""Errors that remain when no effect is missing: coefficients, the formula's misfit, fast changes."""
