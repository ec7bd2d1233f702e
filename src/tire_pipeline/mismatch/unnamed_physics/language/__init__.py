"""The text of an equation: its grammar, and the symbols that it may use."""
