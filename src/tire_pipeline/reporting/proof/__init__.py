"""What was proved on concealed cases: tables and the page."""
