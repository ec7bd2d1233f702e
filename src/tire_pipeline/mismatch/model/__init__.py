"""The simulation of a recording: channels, states along the time line, forces, what an effect would add."""
