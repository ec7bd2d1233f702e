"""The methods themselves: networks, forests, naive Bayes, and the oversampling before them."""
