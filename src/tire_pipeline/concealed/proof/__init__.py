"""The proof: cases are made, explained and scored, simulated ones and real recordings."""
