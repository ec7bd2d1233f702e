"""Files that this project reads and writes: in one step, in a folder or an object store, packed."""
