"""Tires as their force curves: pure-slip forces, features, scores, and bands."""
