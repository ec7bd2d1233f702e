"""The report for the user: values, words, figures and the page."""
