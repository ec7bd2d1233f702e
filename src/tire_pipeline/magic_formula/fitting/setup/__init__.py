"""What a fit knows before it begins: stages, what is given, typical values, where to start."""
