"""What a recording shows beside any effect: noise, changed coefficients, misfit, unnamed forms."""
