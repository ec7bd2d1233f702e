"""Units, channel names and axis systems of files, and the one convention that recordings are converted to."""
