"""A tire as numbers: its coefficients, their order and neutral values, axes, and checked operating points."""
