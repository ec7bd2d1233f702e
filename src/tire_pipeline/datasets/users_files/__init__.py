"""Folders that the user filled: tire property files and recordings."""
