"""What a tire is: its coefficients, their order and neutral values, axes, and checked operating points."""
