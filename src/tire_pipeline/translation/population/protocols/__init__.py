"""Categories that changed how they measure, and the search for the day."""
