"""Writing a model as a ``.tir`` file, new or edited."""
