"""One reader a format: from a file to its channels, as it names and measures them."""
