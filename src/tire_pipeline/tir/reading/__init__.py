"""From the text of a ``.tir`` file to a model in SI, its date, and warnings."""
