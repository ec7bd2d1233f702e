"""Numerical methods that several folders use, each in one place."""
