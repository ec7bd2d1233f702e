"""New files read into the stored table, part by part."""
