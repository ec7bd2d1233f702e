"""The model with the missing physics added."""
