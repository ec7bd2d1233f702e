"""What a ``.tir`` file means: a model in SI, its date, and what is odd about it."""
