"""Learning the posterior's sizes from cases whose answer is known, and judging each source without itself."""
