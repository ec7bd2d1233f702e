"""What pictures, pages and tables for people are made with: figures, safe pages and CSVs, notebook cards."""
