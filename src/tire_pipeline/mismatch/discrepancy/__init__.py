"""Differences that come from no effect: noise, changed coefficients, misfit, unnamed forms."""
