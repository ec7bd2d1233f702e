"""Effects of the state that the tire is in: its pressure, temperature, speed and wear."""
