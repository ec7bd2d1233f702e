"""Derivatives of forces with respect to coefficients: written from the equations, kept, evaluated."""
