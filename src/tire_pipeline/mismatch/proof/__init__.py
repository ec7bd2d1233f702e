"""What holds on unseen sweeps, the size and place of the residual, and what could have been seen."""
