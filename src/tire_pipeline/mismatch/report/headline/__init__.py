"""The first sentences of a report: verdict and names, where and how much, what to do next."""
