"""The simulation of a recording: channels, states along the time line, forces, and what an effect would add."""
