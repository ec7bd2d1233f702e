"""Effects in the sensors and in how their channels are written."""
