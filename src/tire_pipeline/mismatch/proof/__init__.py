"""Errors on unseen sweeps, size and place of the residual, and which effects could have been seen."""
