"""Files by their names, in a folder or an object store: one writer at a time, in versions."""
