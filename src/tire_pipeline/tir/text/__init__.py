"""The text of a ``.tir`` file, line by line, without its meaning."""
