"""Effects in the tire."""
