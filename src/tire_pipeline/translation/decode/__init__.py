"""From the curves asked for back to coefficients, within what any tire obeys."""
