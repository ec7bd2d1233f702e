"""Files that are translated: models from files, chosen files, a folder block by block."""
