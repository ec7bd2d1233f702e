"""What holds on sweeps that the fit has not seen, what is left and where, and what could be seen at all."""
