"""What may be wrong although nothing is left out: coefficients, the formula's misfit, fast changes."""
