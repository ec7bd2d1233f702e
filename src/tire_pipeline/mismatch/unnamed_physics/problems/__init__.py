"""What the search for an equation is given: residuals of forces and of the aligning moment."""
