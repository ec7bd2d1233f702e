"""What may be claimed of a prediction: its reach, its gain, the bias it rests on, and that in words."""
