"""What a recording shows beside any effect: noise, coefficients that moved, misfit, forms without a name."""
