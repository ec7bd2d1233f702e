"""What the ``.tir`` format says: sections and keys, units, numbers, versions."""
