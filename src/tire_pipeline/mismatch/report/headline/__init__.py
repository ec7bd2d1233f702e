"""What a report says first: the verdict and its names, where and how much, what to do next."""
