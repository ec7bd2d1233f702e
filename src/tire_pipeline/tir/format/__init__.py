"""The ``.tir`` format: sections and keys, units, numbers, versions."""
