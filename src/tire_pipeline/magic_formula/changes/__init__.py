"""Changes of a model that keep its forces: another version, another nominal load."""
