"""From raw sweeps to coefficients, by each manufacturer's own fit."""
