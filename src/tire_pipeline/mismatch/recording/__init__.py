"""From a table to clean arrays: checked, repaired and cleaned, or a question to the user."""
