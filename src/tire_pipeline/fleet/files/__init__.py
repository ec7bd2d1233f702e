"""What a manufacturer writes into a file, and how."""
