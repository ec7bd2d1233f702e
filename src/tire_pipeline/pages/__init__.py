"""Tools for figures, pages and tables that people read: safe HTML and CSV, notebook cards."""
