"""What the user gets: values, words, figures and the page."""
