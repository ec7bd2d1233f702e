"""What a prediction is worth: distance to the training data, expected gain, bias, verdict."""
