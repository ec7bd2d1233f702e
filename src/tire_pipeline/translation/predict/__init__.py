"""What the target would measure of a file, in scores: by the mixed model, a policy or networks."""
