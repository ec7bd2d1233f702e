"""Tables: for a spreadsheet, in parts, and of all files read so far."""
