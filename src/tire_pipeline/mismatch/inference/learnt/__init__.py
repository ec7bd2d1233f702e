"""What the posterior has learnt, and where from."""
