"""One bounded least squares problem, and the search for its least from several starts."""
