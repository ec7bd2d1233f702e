"""Classes of tires that no metadata names, and the search for them."""
