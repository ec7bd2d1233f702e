"""Explained recordings: the work of each, its files and page, all of them on one page."""
