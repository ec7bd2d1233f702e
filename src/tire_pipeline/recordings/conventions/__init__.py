"""Units, channel names and axis systems of files, and the one convention that a recording is given in."""
