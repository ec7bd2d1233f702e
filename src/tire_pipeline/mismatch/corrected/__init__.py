"""The model with the missing physics put in."""
